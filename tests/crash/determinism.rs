//! The same upload gives the same answers, whatever computes and keeps it.

use serde_json::{Value, json};

use crate::deployment::Deployment;
use crate::server::{Server, hall_message};
use crate::settings::PATIENCE;

/// What is compared, below a map.
const LAYERS: [&str; 5] = ["faces", "edges", "links", "locations", "aisles"];

/// A hall of 24 m x 16 m with rows of pallets, each 0.8 m wide.
fn warehouse() -> Value {
    let [columns, rows] = [240, 160];
    let is_wall = |column: u64, row: u64| column == 0 || row == 0 || column + 1 == columns || row + 1 == rows;
    let is_pallet = |column: u64, row: u64| (30..210).contains(&column) && column % 10 < 8 && row % 40 > 27;
    let cell = |column, row| if is_wall(column, row) || is_pallet(column, row) { 100 } else { 0 };
    let data: Vec<u8> = (0..rows).flat_map(|row| (0..columns).map(move |column| cell(column, row))).collect();
    let mut message = hall_message(columns, rows);
    (message["info"]["resolution"], message["data"]) = (json!(0.1), json!(data));
    message
}

/// The features of the only map of a deployment, layer by layer, as they are written.
fn features(server: &Server) -> Vec<String> {
    let map = server.maps().pop().expect("one map");
    let layer = |name: &str| {
        let answer = server.ask(&format!("/v1/maps/{map}/collections/{name}/items?limit=10000")).expect("it answers");
        let (_, features) = answer.text.split_once("\"features\":").expect("it is GeoJSON");
        features.to_owned()
    };
    LAYERS.map(layer).to_vec()
}

#[test]
fn engines_threads_and_crashes_make_no_difference() {
    let mut first: Option<Vec<String>> = None;
    for threads in ["1", "2", "8"] {
        for deployment in [Some(Deployment::embedded()), Deployment::shared()].into_iter().flatten() {
            let arguments = ["--compute-threads", threads];
            let mut dying = Server::start(&deployment, Some("during-compute"), &arguments).expect("it starts");
            dying.upload(&warehouse(), "warehouse").expect("accepted");
            assert_eq!(dying.wait_for_death(PATIENCE), Some(9));
            let server = Server::start(&deployment, None, &arguments).expect("the next process starts");
            server.wait_until_idle(PATIENCE);
            let features = features(&server);
            server.stop();
            let first = first.get_or_insert_with(|| features.clone());
            let is_places = features[3].matches("\"Feature\"").count() > 20;
            assert!(is_places, "the rows are read as locations: {}", features[3]);
            for (name, (one, other)) in LAYERS.iter().zip(first.iter().zip(&features)) {
                assert!(one == other, "{name} of {threads} threads, database {:?}", deployment.database());
            }
        }
    }
}
