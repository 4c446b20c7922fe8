//! A map compared with the truth of its site.

use axum::body::Body;
use axum::http::Method;
use serde_json::{Value, json};

use crate::client::{Answer, Api, request};

/// A rectangle of the hall, in metres of the map frame.
fn rectangle(label: &str, [left, low, right, high]: [f64; 4]) -> Value {
    let ring = [[left, low], [right, low], [right, high], [left, high], [left, low]];
    json!({"type": "Feature", "properties": {"label": label}, "geometry": {"type": "Polygon", "coordinates": [ring]}})
}

/// The truth of the hall: ten places in each of two rows, three aisles, and the floor at either end.
fn truth() -> Value {
    let mut features = Vec::new();
    for row in [0.25, 2.25] {
        features.extend((0..10).map(|bay| {
            let left = f64::from(bay) * 1.25 - 0.75;
            rectangle("pallet", [left, row, left + 0.75, row + 1.0])
        }));
    }
    let aisles = [[-0.75, -0.75, 11.25, 0.25], [-0.75, 1.25, 11.25, 2.25], [-0.75, 3.25, 11.25, 4.25]];
    features.extend(aisles.map(|aisle| rectangle("corridor", aisle)));
    features.push(rectangle("junction", [11.25, -0.75, 13.25, 4.25]));
    features.push(rectangle("junction", [-1.75, -0.75, -0.75, 4.25]));
    let mut region = rectangle("region", [-1.75, -0.75, 13.25, 4.25]);
    region["properties"]["angle_deg"] = json!(0.0);
    features.push(region);
    json!({"type": "FeatureCollection", "features": features})
}

async fn evaluate(api: &Api, map: &str, truth: &Value) -> Answer {
    api.send_json(Method::POST, &format!("{map}/evaluations"), &[("content-type", "application/geo+json")], truth).await
}

#[tokio::test]
async fn a_map_is_compared_with_its_truth() {
    let api = Api::new().await;
    let map = api.hall().await;
    let answer = evaluate(&api, &map, &truth()).await;
    assert_eq!(answer.status, 200, "{}", answer.text());
    let report = answer.json();
    let faces = api.get(&format!("{map}/collections/faces/items?limit=1")).await.json();
    assert_eq!(report["geometry"]["faces"], faces["numberMatched"]);
    assert_eq!(report["geometry"]["places"], 20);
    assert!(report["geometry"]["orientationErrorDeg"].as_f64() < Some(0.5), "{report}");
    for scores in [&report["automatic"], &report["decided"]] {
        assert_eq!((&scores["places"]["places"], &scores["regions"]["A"]["places"]), (&json!(20), &json!(20)));
        for share in ["/places/strict", "/places/lax", "/places/area", "/precision", "/f1", "/iou/co", "/cogency"] {
            let value = scores.pointer(share).and_then(Value::as_f64);
            assert!(value.is_some_and(|value| (0.0..=1.0).contains(&value)), "{share}: {scores}");
        }
    }
    // Whoever knows the truth decides no worse than nobody does.
    let area = |scores: &str| report[scores]["iou"]["drivable"].as_f64();
    assert!(area("decided") >= area("automatic"), "{report}");
    assert_eq!(report.get("assigned"), None);
    assert_eq!(api.get("/v1/jobs").await.json()["jobs"].as_array().map(Vec::len), Some(1), "no job was needed");

    // The decision is an assignment; once it is in force, it is compared as well.
    let tag = api.get(&format!("{map}/semantics")).await.header("etag").to_owned();
    let body = json!({"assignment": report["decision"]});
    let put = api.send_json(Method::PUT, &format!("{map}/semantics"), &[("if-match", &tag)], &body).await;
    assert_eq!(put.status, 200, "{}", put.text());
    let report = evaluate(&api, &map, &truth()).await.json();
    assert_eq!(report["assigned"], report["decided"]);
}

#[tokio::test]
async fn a_truth_that_makes_no_sense_is_refused_with_a_pointer() {
    let api = Api::new().await;
    let map = api.hall().await;
    let with = |change: &dyn Fn(&mut Value)| {
        let mut truth = truth();
        change(&mut truth);
        truth
    };
    let cases = [
        (json!({}), "/type"),
        (json!({"type": "FeatureCollection"}), "/features"),
        (json!({"type": "FeatureCollection", "features": []}), "/features"),
        (with(&|truth| truth["features"][3]["properties"] = json!({})), "/features/3/properties/label"),
        (with(&|truth| truth["features"][3]["properties"]["observed"] = json!(2)), "/features/3/properties/observed"),
        (with(&|truth| truth["features"][21]["geometry"] = json!(null)), "/features/21/geometry/type"),
        (
            with(&|truth| truth["features"][0]["geometry"]["coordinates"][0][2] = json!(["1", 2])),
            "/features/0/geometry/coordinates/0/2",
        ),
    ];
    for (truth, pointer) in cases {
        let problem = evaluate(&api, &map, &truth).await.problem(422, "invalid");
        assert_eq!(problem["errors"][0]["pointer"], pointer, "{problem}");
    }
    let path = format!("{map}/evaluations");
    let json = [("content-type", "application/json")];
    api.send(request(Method::POST, &path, &json, Body::from("{"))).await.problem(400, "bad-request");
    api.send(request(Method::POST, &path, &[], Body::from("{}"))).await.problem(415, "unsupported-media-type");
    let nowhere = "/v1/maps/00000000-0000-7000-8000-000000000000";
    evaluate(&api, nowhere, &truth()).await.problem(404, "not-found");
}

#[tokio::test]
async fn labels_that_a_truth_does_not_speak_of_are_a_conflict() {
    let api = Api::new().await;
    let map = api.hall().await;
    let tag = api.get(&format!("{map}/semantics")).await.header("etag").to_owned();
    let body = json!({"ruleSet": "office", "assignment": {}});
    let put = api.send_json(Method::PUT, &format!("{map}/semantics"), &[("if-match", &tag)], &body).await;
    assert_eq!(put.status, 200, "{}", put.text());
    let problem = evaluate(&api, &map, &truth()).await.problem(409, "conflict");
    assert!(problem["detail"].as_str().is_some_and(|detail| detail.contains("no label pc")), "{problem}");
}
