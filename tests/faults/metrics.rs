//! What operators read in figures: a real scrape, the list in the documentation, the queries of the dashboard file.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::Value;
use stillage::measures::METRICS;

use crate::server::{Server, body, hall, status};

/// A service with something to tell: a map was analysed and looked at twice.
fn a_service_with_a_past() -> Server {
    let server = Server::start(&["--max-queued-jobs", "1"]);
    assert_eq!(status(&server.upload(&hall(0))), 202);
    server.wait_until_idle();
    let map = server.maps().pop().expect("one map");
    for _ in 0..2 {
        assert_eq!(status(&server.get(&format!("/v1/maps/{map}/collections/faces/items"))), 200);
    }
    server
}

/// The series of a scrape and their values.
fn scrape(server: &Server) -> BTreeMap<String, f64> {
    let answer = server.get("/metrics");
    let lines = body(&answer).lines().filter(|line| !line.is_empty() && !line.starts_with('#'));
    let series = lines.map(|line| line.rsplit_once(' ').expect("a name and a value"));
    series.map(|(name, value)| (name.to_owned(), value.parse().expect("a number"))).collect()
}

/// The names of series without their labels.
fn names(series: &BTreeMap<String, f64>) -> BTreeSet<&str> {
    series.keys().map(|series| series.split('{').next().expect("there is one")).collect()
}

#[test]
fn every_metric_is_scraped_and_documented() {
    let server = a_service_with_a_past();
    let series = scrape(&server);
    let names = names(&series);
    let documentation = include_str!("../../docs/operations.md");
    for metric in METRICS {
        let is_there = names.contains(metric.name) || names.contains(format!("{}_bucket", metric.name).as_str());
        assert!(is_there, "{} is not in the scrape", metric.name);
        assert!(
            documentation.contains(&format!("| `{}`", metric.name)),
            "{} is not in docs/operations.md",
            metric.name
        );
    }
    let value = |name: &str| series.get(name).copied();
    let expected = [
        (r#"jobs{state="successful"}"#, 1.0),
        (r#"jobs{state="accepted"}"#, 0.0),
        ("jobs_oldest_waiting_seconds", 0.0),
        ("job_attempts_total", 1.0),
        (r#"job_ends_total{end="successful"}"#, 1.0),
        (r#"job_ends_total{end="lost"}"#, 0.0),
        ("job_duration_seconds_count", 1.0),
        (r#"job_stage_duration_seconds_count{stage="site-plan"}"#, 1.0),
        (r#"answer_cache_requests_total{found="hit"}"#, 1.0),
        ("http_bodies_held_bytes", 0.0),
        ("http_connections", 1.0),
        ("database_up", 1.0),
        ("database_busy_total", 0.0),
    ];
    for (name, expected) in expected {
        assert_eq!(value(name), Some(expected), "{name}");
    }
    for name in ["disk_free_bytes", "process_resident_memory_bytes", "process_open_fds", "answer_cache_bytes"] {
        assert!(value(name).is_some_and(|value| value > 0.0), "{name}: {:?}", value(name));
    }
}

#[test]
fn what_waits_and_what_is_refused_is_told() {
    let server = Server::start(&["--job-slots", "0", "--max-queued-jobs", "1"]);
    assert_eq!(status(&server.upload(&hall(0))), 202);
    std::thread::sleep(std::time::Duration::from_millis(50));
    assert_eq!(status(&server.upload(&hall(1))), 503);
    let series = scrape(&server);
    assert_eq!(series.get(r#"jobs{state="accepted"}"#), Some(&1.0));
    assert!(series["jobs_oldest_waiting_seconds"] >= 0.05);
    assert_eq!(series.get(r#"http_requests_shed_total{reason="queue"}"#), Some(&1.0));
}

#[test]
fn every_query_of_the_dashboard_names_a_metric_that_exists() {
    let dashboard: Value = serde_json::from_str(include_str!("../../docs/grafana.json")).expect("is JSON");
    let mut queries = Vec::new();
    queries_of(&dashboard["panels"], &mut queries);
    assert!(queries.len() > 25, "{}", queries.len());
    let server = a_service_with_a_past();
    let series = scrape(&server);
    let names = names(&series);
    for query in queries {
        let used = metrics_of(&query);
        assert!(!used.is_empty(), "{query}");
        for metric in used {
            assert!(names.contains(metric.as_str()), "{metric} of {query} is not in the scrape");
        }
    }
}

fn queries_of(panels: &Value, queries: &mut Vec<String>) {
    for panel in panels.as_array().into_iter().flatten() {
        let targets = panel["targets"].as_array().into_iter().flatten();
        queries.extend(targets.map(|target| target["expr"].as_str().expect("a query").to_owned()));
        queries_of(&panel["panels"], queries);
    }
}

/// The metrics that a query names: its words outside of braces, brackets and lists of labels that are no functions.
fn metrics_of(query: &str) -> Vec<String> {
    let mut plain = query.to_owned();
    for (open, close) in [("{", '}'), ("[", ']'), (" by (", ')')] {
        while let Some(begin) = plain.find(open) {
            let end = begin + plain[begin..].find(close).expect("it is closed");
            plain.replace_range(begin..=end, " ");
        }
    }
    let is_word = |character: char| character.is_ascii_alphanumeric() || character == '_';
    let mut words = Vec::new();
    let mut rest = plain.as_str();
    while let Some(begin) = rest.find(|character: char| character.is_ascii_alphabetic()) {
        let word = rest[begin..].split(|character| !is_word(character)).next().expect("there is one");
        rest = &rest[begin + word.len()..];
        if !rest.trim_start().starts_with('(') {
            words.push(word.to_owned());
        }
    }
    words
}

#[test]
fn the_metrics_of_a_query_are_found() {
    let query = r#"topk(8, sum by (le, route) (rate(a_bucket{job=~"x"}[5m])) / min(b_total) + 2)"#;
    assert_eq!(metrics_of(query), ["a_bucket", "b_total"]);
}
