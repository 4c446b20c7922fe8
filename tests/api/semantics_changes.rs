//! What a person decided stays decided: changes name what changes, and versions can be had again.

use std::collections::BTreeMap;

use axum::body::Body;
use axum::http::Method;
use serde_json::{Value, json};

use crate::client::{Answer, Api, request};

/// Changes the labels of a map, whatever they are.
async fn change(api: &Api, map: &str, method: Method, body: &Value) -> Answer {
    api.send_json(method, &format!("{map}/semantics"), &[("if-match", "*")], body).await
}

async fn restore(api: &Api, map: &str, version: u64) -> Answer {
    let path = format!("{map}/semantics/versions/{version}/restore");
    api.send(request(Method::POST, &path, &[("if-match", "*")], Body::empty())).await
}

/// The members that people decide.
fn decided(semantics: &Value) -> [&Value; 4] {
    ["ruleSet", "assignment", "overrides", "layout"].map(|member| &semantics[member])
}

#[tokio::test]
async fn what_a_put_does_not_name_stays() {
    let api = Api::new().await;
    let map = api.hall().await;
    let suggested = api.get(&format!("{map}/semantics")).await.json();
    let overrides = json!([{"face": 1, "label": "ju"}]);
    let first = change(&api, &map, Method::PUT, &json!({"assignment": {"0": "ro"}, "overrides": overrides})).await;
    assert_eq!(first.status, 200, "{}", first.text());
    let mut expected = suggested["assignment"].clone();
    expected["0"] = "ro".into();
    assert_eq!(first.json()["assignment"], expected, "the others keep their labels");

    let second = change(&api, &map, Method::PUT, &json!({"assignment": {"1": "co"}})).await.json();
    expected["1"] = "co".into();
    assert_eq!((&second["assignment"], &second["overrides"]), (&expected, &overrides));
    let third = change(&api, &map, Method::PUT, &json!({"overrides": []})).await.json();
    assert_eq!((&third["assignment"], &third["overrides"]), (&expected, &json!([])), "a list is the whole list");
}

#[tokio::test]
async fn a_patch_changes_one_category_one_face_or_one_member_of_the_layout() {
    let api = Api::new().await;
    let map = api.hall().await;
    let path = format!("{map}/semantics");
    let suggested = api.get(&path).await.json();
    let patch = json!({"assignment": {"0": "ro"}, "overrides": {"1": "ju", "2": "co"},
        "layout": {"codeTemplate": "{aisle:03}-{bay:03}", "vehicleRadiusM": 0.4}});
    api.send_json(Method::PATCH, &path, &[], &patch).await.problem(428, "precondition-required");
    let first = change(&api, &map, Method::PATCH, &patch).await;
    assert_eq!(first.status, 200, "{}", first.text());
    assert_eq!(first.header("etag"), api.get(&path).await.header("etag"));

    let patch = json!({"overrides": {"1": null, "3": "co"}, "layout": {"vehicleRadiusM": null}});
    let second = change(&api, &map, Method::PATCH, &patch).await.json();
    assert_eq!(second["assignment"], first.json()["assignment"]);
    assert_eq!(second["overrides"], json!([{"face": 2, "label": "co"}, {"face": 3, "label": "co"}]));
    assert_eq!(second["layout"], json!({"codeTemplate": "{aisle:03}-{bay:03}"}));

    let one = change(&api, &map, Method::PATCH, &json!({"assignment": {"0": null}})).await.json();
    assert_eq!(one["assignment"], suggested["assignment"], "the category is as suggested again");
    let list = json!({"overrides": [{"face": 5, "label": "ju"}]});
    assert_eq!(change(&api, &map, Method::PATCH, &list).await.json()["overrides"], list["overrides"]);
    let none = json!({"assignment": null, "overrides": null, "layout": null});
    let none = change(&api, &map, Method::PATCH, &none).await.json();
    assert_eq!(decided(&none), decided(&suggested));
    assert_eq!(none["origin"], "assigned", "somebody said so");
}

#[tokio::test]
async fn a_patch_that_makes_no_sense_is_refused_piece_by_piece() {
    let api = Api::new().await;
    let map = api.hall().await;
    let cases = [
        (json!({"assignment": {"0": "xx"}}), "/assignment/0"),
        (json!({"assignment": {"99": null}}), "/assignment/99"),
        (json!({"assignment": {"0": 7}}), "/assignment/0"),
        (json!({"overrides": {"x": "co"}}), "/overrides/x"),
        (json!({"overrides": {"99999": "co"}}), "/overrides/99999"),
        (json!({"overrides": [{"face": 1, "label": "co"}, {"face": 99_999, "label": "co"}]}), "/overrides/1"),
        (json!({"overrides": "co"}), "/overrides"),
        (json!({"layout": {"vehicleRadiusM": -1}}), "/layout/vehicleRadiusM"),
        (json!({"layout": {"colour": 1}}), "/layout/colour"),
        (json!({"ruleset": "office"}), "/ruleset"),
    ];
    for (body, pointer) in cases {
        let problem = change(&api, &map, Method::PATCH, &body).await.problem(422, "invalid");
        assert_eq!(problem["errors"][0]["pointer"], pointer, "{body}: {problem}");
    }
    assert_eq!(api.get(&format!("{map}/semantics")).await.json()["version"], 0, "nothing was changed");
}

#[tokio::test]
async fn another_rule_set_keeps_the_labels_that_it_knows() {
    let api = Api::new().await;
    let map = api.hall().await;
    let office = change(&api, &map, Method::PATCH, &json!({"ruleSet": "office"})).await.json();
    let categories = api.get(&format!("{map}/categories")).await.json();
    for category in categories["categories"].as_array().expect("categories") {
        assert_eq!(category["label"], category["suggestion"]["label"], "nobody decided: as suggested under it");
    }
    assert_eq!(office["ruleSet"], "office");
    let decision = json!({"ruleSet": "warehouse", "assignment": {"0": "ju"}, "overrides": {"1": "pc"}});
    assert_eq!(change(&api, &map, Method::PATCH, &decision).await.json()["assignment"]["0"], "ju");
    let problem = change(&api, &map, Method::PATCH, &json!({"ruleSet": "office"})).await.problem(422, "invalid");
    assert_eq!(problem["errors"][0]["pointer"], "/ruleSet", "{problem}");
    let both = change(&api, &map, Method::PATCH, &json!({"ruleSet": "office", "overrides": null})).await;
    assert_eq!(both.status, 200, "{}", both.text());
}

#[tokio::test]
async fn an_earlier_version_is_restored_as_a_new_one() {
    let api = Api::new().await;
    let map = api.hall().await;
    let versions = format!("{map}/semantics/versions");
    let suggested = api.get(&format!("{map}/semantics")).await.json();
    let first = change(&api, &map, Method::PATCH, &json!({"assignment": {"0": "ro"}, "overrides": {"1": "ju"}})).await;
    change(&api, &map, Method::PATCH, &json!({"overrides": null})).await;

    let read = api.get(&format!("{versions}/1")).await;
    assert_eq!(read.json(), first.json());
    assert_eq!(api.get_with(&format!("{versions}/1"), &[("if-none-match", read.header("etag"))]).await.status, 304);
    let restored = restore(&api, &map, 1).await;
    assert_eq!(restored.status, 200, "{}", restored.text());
    assert_eq!((&restored.json()["version"], &restored.json()["origin"]), (&json!(3), &json!("assigned")));
    assert_eq!(decided(&restored.json()), decided(&first.json()));
    let faces = api.get(&format!("{map}/collections/faces/items/1")).await.json();
    assert_eq!(faces["properties"]["label"], "ju", "it is in force");

    let as_suggested = restore(&api, &map, 0).await.json();
    assert_eq!((&as_suggested["version"], &as_suggested["origin"]), (&json!(4), &json!("suggested")));
    assert_eq!(decided(&as_suggested), decided(&suggested));
    assert_eq!(api.get(&format!("{versions}/0")).await.json(), suggested);
    restore(&api, &map, 9).await.problem(404, "not-found");
    api.get(&format!("{versions}/9")).await.problem(404, "not-found");
    let path = format!("{versions}/1/restore");
    api.send(request(Method::POST, &path, &[], Body::empty())).await.problem(428, "precondition-required");
    let stale = [("if-match", restored.header("etag"))];
    api.send(request(Method::POST, &path, &stale, Body::empty())).await.problem(412, "precondition-failed");
}

/// Label by the shape of each face.
async fn labels_by_place(api: &Api, map: &str) -> BTreeMap<String, String> {
    let faces = api.get(&format!("{map}/collections/faces/items?limit=1000")).await.json();
    by_place(&faces)
}

fn by_place(faces: &Value) -> BTreeMap<String, String> {
    let faces = faces["features"].as_array().expect("faces").iter();
    let label = |face: &Value| (face["geometry"].to_string(), face["properties"]["label"].to_string());
    faces.map(label).collect()
}

/// Analyses again with other options; the path of the proposal.
async fn propose(api: &Api, map: &str, options: &Value) -> String {
    let asked = api.send_json(Method::POST, &format!("{map}/analyses"), &[], options).await;
    assert_eq!(asked.status, 202, "{}", asked.text());
    api.app.run_until_empty().await.expect("the queue can be worked on");
    let list = api.get(&format!("{map}/analyses")).await.json();
    format!("{map}/analyses/{}", list["analyses"][0]["id"].as_str().expect("an id"))
}

async fn activate(api: &Api, analysis: &str) -> Value {
    let answer = api.send(request(Method::POST, &format!("{analysis}/activate"), &[], Body::empty())).await;
    assert_eq!(answer.status, 200, "{}", answer.text());
    answer.json()
}

#[tokio::test]
async fn labels_are_carried_over_to_another_analysis() {
    let api = Api::new().await;
    let map = api.hall().await;
    let list = api.get(&format!("{map}/analyses")).await.json();
    let first = format!("{map}/analyses/{}", list["analyses"][0]["id"].as_str().expect("an id"));
    let same_faces = propose(&api, &map, &json!({"seed": 7})).await;
    let suggestion = activate(&api, &same_faces).await;
    assert_eq!(suggestion.get("carried"), None, "nobody decided");
    assert_eq!(api.get(&format!("{map}/semantics")).await.json()["version"], 0);

    activate(&api, &first).await;
    let decided =
        change(&api, &map, Method::PATCH, &json!({"assignment": {"0": "ro"}, "overrides": {"3": "ju"}})).await;
    assert_eq!(decided.status, 200, "{}", decided.text());
    let labels = labels_by_place(&api, &map).await;
    let proposal = api.get(&same_faces).await.json();
    assert_eq!(
        (&proposal["inForce"], &proposal["wouldCarry"]),
        (&json!(false), &json!({"from": 1, "kept": 2, "lost": []}))
    );
    let faces = api.get(&format!("{same_faces}/faces?properties=label")).await.json();
    assert_eq!(by_place(&faces), labels, "its faces can be looked at before");
    assert_eq!(
        api.get(&format!("{map}/semantics/versions")).await.json()["versions"].as_array().map(Vec::len),
        Some(1)
    );
    let analysis = activate(&api, &same_faces).await;
    assert_eq!(analysis["carried"], json!({"from": 1, "kept": 2, "lost": []}));
    let semantics = api.get(&format!("{map}/semantics")).await.json();
    assert_eq!((&semantics["version"], &semantics["origin"]), (&json!(2), &json!("carried")));
    assert_eq!(semantics["carried"], analysis["carried"]);
    assert_eq!(labels_by_place(&api, &map).await, labels, "every face has the label that it had");
    let list = api.get(&format!("{map}/analyses")).await.json();
    assert_eq!(list["analyses"][0]["carried"], analysis["carried"]);

    // What is read may be sent back, and a person's own decision is not replaced any more.
    let own = change(&api, &map, Method::PUT, &semantics).await;
    assert_eq!((&own.json()["version"], &own.json()["origin"]), (&json!(3), &json!("assigned")));
    activate(&api, &first).await;
    change(&api, &map, Method::PATCH, &json!({"overrides": {"3": "co"}})).await;
    activate(&api, &same_faces).await;
    assert_eq!(decided_overrides(&api, &map).await, own.json()["overrides"]);
}

async fn decided_overrides(api: &Api, map: &str) -> Value {
    api.get(&format!("{map}/semantics")).await.json()["overrides"].take()
}

#[tokio::test]
async fn what_other_faces_cannot_hold_is_told_as_lost() {
    let api = Api::new().await;
    let map = api.hall().await;
    let faces = api.get(&format!("{map}/collections/faces/items?limit=1000")).await.json();
    let faces = faces["features"].as_array().expect("faces");
    let smallest = faces.iter().min_by_key(|face| (face["properties"]["areaM2"].as_f64().unwrap_or(0.0) * 1e4) as u64);
    let smallest = smallest.expect("a face")["id"].to_string();
    let patch = json!({"overrides": {smallest.as_str(): "ju"}});
    assert_eq!(change(&api, &map, Method::PATCH, &patch).await.status, 200);
    // One face for the whole map.
    let whole = propose(&api, &map, &json!({"decomposition": {"method": "paper", "minPeak": 0.9}})).await;
    let would_carry = api.get(&whole).await.json()["wouldCarry"].take();
    let carried = activate(&api, &whole).await["carried"].take();
    assert_eq!(would_carry, carried, "it is told before");
    assert_eq!((&carried["kept"], carried["lost"].as_array().map(Vec::len)), (&json!(0), Some(1)), "{carried}");
    let lost = &carried["lost"][0];
    assert_eq!((lost["face"].to_string(), &lost["label"]), (smallest, &json!("ju")));
    let at = format!("point={},{}&crs=EPSG:3857", lost["at"][0], lost["at"][1]);
    assert_eq!(api.get(&format!("{map}/at?{at}")).await.status, 200, "it lies in the map");
}

#[tokio::test]
async fn a_decision_is_carried_anew_when_it_changed() {
    let api = Api::new().await;
    let map = api.hall().await;
    let list = api.get(&format!("{map}/analyses")).await.json();
    let first = format!("{map}/analyses/{}", list["analyses"][0]["id"].as_str().expect("an id"));
    change(&api, &map, Method::PATCH, &json!({"overrides": {"3": "ju"}})).await;
    let second = propose(&api, &map, &json!({"seed": 7})).await;
    activate(&api, &second).await;
    activate(&api, &first).await;
    assert_eq!(api.get(&format!("{map}/semantics")).await.json()["version"], 1, "the first one has its own decision");
    assert_eq!(activate(&api, &second).await["carried"]["from"], 1);
    assert_eq!(api.get(&format!("{map}/semantics")).await.json()["version"], 2, "it is not carried twice");
    activate(&api, &first).await;
    change(&api, &map, Method::PATCH, &json!({"overrides": {"3": "co"}})).await;
    assert_eq!(activate(&api, &second).await["carried"]["from"], 3);
    assert_eq!(decided_overrides(&api, &map).await, json!([{"face": 3, "label": "co"}]));
}

#[tokio::test]
async fn a_preview_tells_what_would_change_and_changes_nothing() {
    let api = Api::new().await;
    let map = api.hall().await;
    let path = format!("{map}/semantics");
    let preview = async |query: &str, body: &Value| {
        let answer = api.send_json(Method::POST, &format!("{path}/preview{query}"), &[], body).await;
        assert_eq!(answer.status, 200, "{}", answer.text());
        answer
    };
    let in_force = api.get(&path).await;
    let same = preview("", &in_force.json()).await.json();
    assert_eq!((&same["numberMatched"], &same["features"]), (&json!(0), &json!([])), "labels as they were read");

    let faces = api.get(&format!("{map}/collections/faces/items?limit=1000&crs=EPSG:3857")).await.json();
    let faces = faces["features"].as_array().expect("faces").clone();
    let body = json!({"assignment": api.all_labelled(&map, "co").await, "overrides": {"1": "ju"}});
    let answer = preview("?limit=2&crs=EPSG:3857", &body).await;
    assert_eq!(answer.header("content-type"), "application/geo+json");
    let made = answer.json();
    let label = |face: &Value| face["properties"]["label"].clone();
    let changed: Vec<&Value> = faces.iter().filter(|face| face["id"] == 1 || label(face) != "co").collect();
    assert_eq!((made["numberMatched"].as_u64(), &made["numberReturned"]), (Some(changed.len() as u64), &json!(2)));
    for (told, face) in made["features"].as_array().expect("features").iter().zip(&changed) {
        assert_eq!((&told["id"], &told["geometry"]), (&face["id"], &face["geometry"]));
        let now = if face["id"] == 1 { "ju" } else { "co" };
        let same = &face["id"];
        let relabelled = json!({"change": "relabelled", "isBefore": false, "face": same, "previousFace": same,
            "label": now, "previousLabel": label(face)});
        assert_eq!(told["properties"], relabelled);
    }
    let counts = &made["counts"];
    let corridor = counts["labels"].as_array().expect("labels").iter().find(|counts| counts["label"] == "co");
    let corridor = corridor.expect("there are corridors");
    let before = faces.iter().filter(|face| label(face) == "co").count();
    assert_eq!(corridor["faces"], json!({"before": before, "after": faces.len() - 1}));
    let locations = api.get(&format!("{map}/collections/locations/items")).await.json()["numberMatched"].take();
    let of_labels = counts["labels"].as_array().expect("labels").iter();
    let sum: u64 = of_labels.filter_map(|counts| counts["locations"]["before"].as_u64()).sum();
    assert_eq!(Some(sum), locations.as_u64());
    let edges = api.get(&format!("{map}/collections/edges/items?cogency=invalid")).await.json();
    assert_eq!(counts["edges"]["invalid"]["before"], edges["numberMatched"]);

    assert_eq!(api.get(&path).await.header("etag"), in_force.header("etag"), "nothing is stored");
    let made = change(&api, &map, Method::PATCH, &body).await;
    assert_eq!(made.status, 200, "{}", made.text());
    let after = api.get(&format!("{map}/collections/links/items?connectivity=connected")).await.json();
    assert_eq!(counts["links"]["connected"]["after"], after["numberMatched"]);
    let wrong = json!({"overrides": [{"face": 1, "label": "co"}, {"face": 99_999, "label": "co"}]});
    let problem = api.send_json(Method::POST, &format!("{path}/preview"), &[], &wrong).await.problem(422, "invalid");
    assert_eq!(problem["errors"][0]["pointer"], "/overrides/1");
}

#[tokio::test]
async fn a_rule_set_is_tried_before_it_is_stored() {
    let api = Api::new().await;
    let map = api.hall().await;
    let (path, preview) = (format!("{map}/semantics"), format!("{map}/semantics/preview"));
    let mut rule_set = api.get("/v1/rule-sets/site").await.json();
    rule_set["cogency"] = json!([{"when": ["*", "*"], "then": "cogent"}]);
    let answer = api.send_json(Method::POST, &preview, &[], &json!({"ruleSet": rule_set})).await;
    assert_eq!(answer.status, 200, "{}", answer.text());
    let counts = answer.json()["counts"].take();
    let edges = api.get(&format!("{map}/collections/edges/items")).await.json()["numberMatched"].take();
    assert_eq!((&counts["edges"]["cogent"]["after"], &answer.json()["numberMatched"]), (&edges, &json!(0)));
    assert_ne!(counts["edges"]["cogent"]["before"], edges);

    let stored = change(&api, &map, Method::PATCH, &json!({"ruleSet": rule_set})).await.problem(422, "invalid");
    assert_eq!(stored["errors"][0]["pointer"], "/ruleSet");
    assert_eq!(api.get(&path).await.json()["version"], 0);
    rule_set["labels"][0]["color"] = json!("green");
    let wrong = json!({"ruleSet": rule_set});
    let problem = api.send_json(Method::POST, &preview, &[], &wrong).await.problem(422, "invalid");
    assert_eq!(problem["errors"][0]["pointer"], "/ruleSet/labels/0/color");
}
