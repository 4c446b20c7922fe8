//! From a new assignment of labels to an answer with it.

use std::time::Instant;

use serde_json::Value;

use crate::client;
use crate::serving::Serving;

/// Assignments, one after the other.
const ASSIGNMENTS: usize = 40;

/// Milliseconds from an assignment until a page of 100 faces has come with it, ascending.
pub fn times(service: &Serving, map: &str) -> Vec<f64> {
    let semantics = format!("http://{}/v1/maps/{map}/semantics", service.address);
    let page = format!("/v1/maps/{map}/collections/faces/items?limit=100");
    let assign = |label: &str| {
        let current = ureq::get(&semantics).call().expect("there are labels");
        let tag = current.headers()["etag"].clone();
        let body = serde_json::json!({"assignment": {"0": label}});
        let began = Instant::now();
        let assigned = ureq::put(&semantics).header("if-match", tag).send_json(&body);
        let assigned: Value = assigned.expect("is assigned").body_mut().read_json().expect("JSON");
        client::get(service.address, &page, "");
        assert_eq!(assigned["assignment"]["0"], label);
        began.elapsed().as_secs_f64() * 1e3
    };
    let mut times: Vec<f64> = (0..ASSIGNMENTS).map(|number| assign(["pc", "co"][number % 2])).collect();
    times.sort_by(f64::total_cmp);
    times
}
