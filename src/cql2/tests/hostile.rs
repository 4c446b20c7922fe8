//! Filters that ask for too much are refused.

use super::DEGREES;
use super::places::QUERYABLES;
use crate::cql2::{Filter, read_json, read_text};

fn refusal(read: impl FnOnce() -> Result<Filter, crate::cql2::FilterError>) -> String {
    let error = read().expect_err("is refused").to_string();
    assert!(error.len() < 200, "{} bytes", error.len());
    error
}

fn text(text: &str) -> String {
    refusal(|| read_text(text).and_then(|expression| Filter::new(&expression, &QUERYABLES, DEGREES)))
}

fn json(text: &str) -> String {
    refusal(|| read_json(text).and_then(|expression| Filter::new(&expression, &QUERYABLES, DEGREES)))
}

#[test]
fn depth_is_limited() {
    for filter in [
        "(".repeat(60_000),
        "NOT ".repeat(15_000) + "TRUE",
        format!("{}TRUE{}", "(".repeat(30_000), ")".repeat(30_000)),
        "area = 1".to_owned() + &"+1".repeat(30_000),
        "CASEI(".repeat(10_000),
        "a(".repeat(30_000),
        format!("A_EQUALS({}", "(".repeat(60_000)),
        // Deep on the left: each pair of parentheses has a sum of its own.
        format!("{}1{} > 2", "(".repeat(60), ("+1".repeat(60) + ")").repeat(60)),
    ] {
        assert!(text(&filter).ends_with("there are more than 64 levels within one another"), "{}", text(&filter));
    }
    for filter in ["[".repeat(60_000), r#"{"op":"not","args":["#.repeat(3_000), r#"{"a":"#.repeat(10_000)] {
        assert_eq!(json(&filter), "there are more than 64 levels within one another");
    }
    let levels = format!("{}true{}", r#"{"op":"not","args":["#.repeat(63), "]}".repeat(63));
    assert!(read_json(&levels).is_ok(), "64 levels are read");
    assert!(read_text(&("NOT ".repeat(63) + "TRUE")).is_ok(), "64 levels are read");
    assert!(read_text(&("(".repeat(64) + "TRUE" + &")".repeat(64))).is_ok(), "64 parentheses are read");
}

#[test]
fn length_is_limited() {
    let megabyte = "area = 1 OR ".repeat(90_000) + "area = 1";
    assert_eq!(text(&megabyte), "is longer than 65536 bytes");
    assert_eq!(json(&format!("[{}1]", "1,".repeat(500_000))), "is longer than 65536 bytes");
    assert!(read_text(&("area = 1 OR ".repeat(5_000) + "area = 1")).is_ok(), "a long list is read");
}

#[test]
fn geometry_is_limited() {
    let path: Vec<String> = (0..6_000).map(|x| format!("{x} 0")).collect();
    let line = format!("S_INTERSECTS(geometry, LINESTRING({}))", path.join(","));
    assert_eq!(text(&line), "the geometries have more than 2048 positions: simplify them");
    let many = "S_INTERSECTS(geometry, POINT(1 1)) OR ".repeat(1_000) + "TRUE";
    assert_eq!(text(&many), "there are more than 100 spatial functions");
}

#[test]
fn an_error_repeats_little_of_a_long_filter() {
    let name = "x".repeat(60_000);
    for filter in
        [format!("{name} = 5"), format!("label = 5 '{name}'"), format!("area = '{name}'"), format!("{name}()")]
    {
        assert!(!text(&filter).contains(&name[..41]));
    }
}
