//! The report on the navigation graph of a map.

use axum::http::Method;
use serde_json::{Value, json};

use crate::client::Api;

async fn labelled(api: &Api, label: &str) -> String {
    let map = api.hall().await;
    let body = json!({"ruleSet": "warehouse", "assignment": api.all_labelled(&map, label).await});
    let answer = api.send_json(Method::PUT, &format!("{map}/semantics"), &[("if-match", "*")], &body).await;
    assert_eq!(answer.status, 200, "{}", answer.text());
    map
}

#[tokio::test]
async fn a_report_has_nineteen_figures_and_a_picture() {
    let api = Api::new().await;
    let map = labelled(&api, "co").await;
    let report = api.get(&format!("{map}/graph-report?footprintRadiusM=0.2&minPassageWidthM=0.6&samples=50")).await;
    assert_eq!(report.status, 200, "{}", report.text());
    let document = report.json();
    assert_eq!(document["figures"].as_object().expect("figures").len(), 19);
    assert_eq!((&document["footprintRadiusM"], &document["minPassageWidthM"]), (&json!(0.2), &json!(0.6)));
    assert!(!document["faceComponents"].as_array().expect("a list").is_empty(), "{document}");
    let picture = api.get(&format!("{map}/graph-report.png?footprintRadiusM=0.2")).await;
    assert_eq!((picture.status.as_u16(), picture.header("content-type")), (200, "image/png"));
    assert!(picture.body.starts_with(b"\x89PNG"));
}

#[tokio::test]
async fn the_tag_of_a_report_follows_its_map_and_its_options() {
    let api = Api::new().await;
    let map = labelled(&api, "co").await;
    let path = format!("{map}/graph-report");
    let first = api.get(&path).await;
    let tag = first.header("etag").to_owned();
    assert_eq!(api.get_with(&path, &[("if-none-match", &tag)]).await.status, 304);
    assert_eq!(api.get(&path).await.body, first.body, "the same question has the same answer");
    let seeded = api.get_with(&format!("{path}?seed=7"), &[("if-none-match", &tag)]).await;
    assert_eq!(seeded.status, 200);
    let body = json!({"ruleSet": "warehouse", "assignment": {}});
    api.send_json(Method::PUT, &format!("{map}/semantics"), &[("if-match", "*")], &body).await;
    assert_eq!(api.get_with(&path, &[("if-none-match", &tag)]).await.status, 200);
}

#[tokio::test]
async fn a_map_without_drivable_ground_has_an_empty_report() {
    let api = Api::new().await;
    let map = labelled(&api, "pc").await;
    let report = api.get(&format!("{map}/graph-report")).await.json();
    for list in ["faceComponents", "graphComponents", "deadEnds", "narrowPassages", "disagreements"] {
        assert_eq!(report[list], json!([]), "{list}");
    }
    let missed = report["unreachableLocations"].as_array().expect("a list");
    assert!(!missed.is_empty() && missed.iter().all(|one| one["reason"] == "no-access"), "{report}");
    assert_eq!((&report["figures"]["numNodes"], &report["figures"]["connectivity"]), (&json!(0), &Value::Null));
    assert_eq!(api.get(&format!("{map}/graph-report.png")).await.status, 200);
}

#[tokio::test]
async fn bad_options_of_a_report_are_named() {
    let api = Api::new().await;
    let map = api.hall().await;
    for (query, parameter) in [
        ("footprintRadiusM=-1", "footprintRadiusM"),
        ("footprintRadiusM=wide", "footprintRadiusM"),
        ("minPassageWidthM=-0.1", "minPassageWidthM"),
        ("minPassageWidthM=NaN", "minPassageWidthM"),
        ("samples=0", "samples"),
        ("samples=10001", "samples"),
        ("seed=-1", "seed"),
        ("width=1", "width"),
    ] {
        for path in ["graph-report", "graph-report.png"] {
            let problem = api.get(&format!("{map}/{path}?{query}")).await;
            assert_eq!(problem.status, 400, "{query}: {}", problem.text());
            assert!(problem.text().contains(parameter), "{query}: {}", problem.text());
        }
    }
    let nobody = "/v1/maps/00000000-0000-7000-8000-000000000000/graph-report";
    api.get(nobody).await.problem(404, "not-found");
}
