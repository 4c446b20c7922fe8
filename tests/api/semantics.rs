//! Rule sets, categories and the labels of a map.

use axum::body::Body;
use axum::http::Method;
use serde_json::{Value, json};

use crate::client::{Answer, Api, request};

async fn put(api: &Api, path: &str, tag: &str, body: &Value) -> Answer {
    api.send_json(Method::PUT, path, &[("if-match", tag)], body).await
}

#[tokio::test]
async fn built_in_rule_sets_are_read_only() {
    let api = Api::new().await;
    let list = api.get("/v1/rule-sets").await.json();
    let ids: Vec<&str> =
        list["ruleSets"].as_array().into_iter().flatten().filter_map(|rule_set| rule_set["id"].as_str()).collect();
    assert_eq!(ids, ["site", "warehouse", "office"]);
    let warehouse = api.get("/v1/rule-sets/warehouse").await;
    assert_eq!(warehouse.json()["builtIn"], true);
    let tag = warehouse.header("etag").to_owned();
    put(&api, "/v1/rule-sets/warehouse", &tag, &warehouse.json()).await.problem(403, "read-only");
    let delete = request(Method::DELETE, "/v1/rule-sets/warehouse", &[("if-match", &tag)], Body::empty());
    api.send(delete).await.problem(403, "read-only");
    let mut same = warehouse.json();
    same["id"] = "warehouse".into();
    api.send_json(Method::POST, "/v1/rule-sets", &[], &same).await.problem(409, "conflict");
}

#[tokio::test]
async fn a_rule_set_is_made_read_replaced_and_deleted() {
    let api = Api::new().await;
    let mut rules = api.get("/v1/rule-sets/warehouse").await.json();
    rules["id"] = "cold-store".into();
    let made = api.send_json(Method::POST, "/v1/rule-sets", &[], &rules).await;
    assert_eq!(made.status, 201, "{}", made.text());
    assert_eq!(made.header("location"), "/v1/rule-sets/cold-store");
    let read = api.get("/v1/rule-sets/cold-store").await;
    assert_eq!(
        (read.json()["builtIn"].clone(), read.json()["labels"].clone()),
        (json!(false), rules["labels"].clone())
    );
    let tag = read.header("etag").to_owned();
    assert_eq!(made.header("etag"), tag);
    // What was read can be sent back, with a change.
    let mut changed = read.json();
    changed["labels"][0]["name"] = "frozen corridor".into();
    api.send_json(Method::PUT, "/v1/rule-sets/cold-store", &[], &changed).await.problem(428, "precondition-required");
    let replaced = put(&api, "/v1/rule-sets/cold-store", &tag, &changed).await;
    assert_eq!(replaced.status, 200, "{}", replaced.text());
    assert_eq!(replaced.json()["version"], 2);
    put(&api, "/v1/rule-sets/cold-store", &tag, &changed).await.problem(412, "precondition-failed");
    changed["id"] = "other".into();
    put(&api, "/v1/rule-sets/cold-store", "*", &changed).await.problem(422, "invalid");
    let delete = |headers: &[(&str, &str)]| {
        api.send(request(Method::DELETE, "/v1/rule-sets/cold-store", headers, Body::empty()))
    };
    delete(&[]).await.problem(428, "precondition-required");
    assert_eq!(delete(&[("if-match", replaced.header("etag"))]).await.status, 204);
    api.get("/v1/rule-sets/cold-store").await.problem(404, "not-found");
}

#[tokio::test]
async fn a_rule_set_that_makes_no_sense_is_refused_piece_by_piece() {
    let api = Api::new().await;
    let label = |id: &str, connects: &[&str]| json!({"id": id, "name": id, "color": "#808080", "functionality": [], "connectsTo": connects});
    let cases = [
        (json!({"labels": [label("a", &[])]}), "/id"),
        (json!({"id": "Not plain", "labels": [label("a", &[])]}), "/id"),
        (json!({"id": "x", "labels": []}), "/labels"),
        (json!({"id": "x", "labels": [label("a", &["b"])]}), "/labels/0/connectsTo/0"),
        (
            json!({"id": "x", "labels": [label("a", &[])], "cogency": [{"when": ["a", "b"], "then": "cogent"}]}),
            "/cogency/0/when/1",
        ),
        (
            json!({"id": "x", "labels": [label("a", &[])], "cogency": [{"when": ["a", "a"], "then": "maybe"}]}),
            "/cogency/0/then",
        ),
        (
            json!({"id": "x", "labels": [label("a", &[])], "cogency": [
                {"when": ["*", "a"], "then": "cogent"}, {"when": ["a", "a"], "then": "invalid"}]}),
            "/cogency/1",
        ),
        (json!({"id": "x", "labels": [label("a", &[])], "colour": 1}), "/colour"),
    ];
    for (body, pointer) in cases {
        let problem = api.send_json(Method::POST, "/v1/rule-sets", &[], &body).await.problem(422, "invalid");
        assert_eq!(problem["errors"][0]["pointer"], pointer, "{problem}");
    }
}

#[tokio::test]
async fn the_cogency_of_every_pair_of_labels_is_a_table() {
    let api = Api::new().await;
    let matrix = api.get("/v1/rule-sets/warehouse/matrix").await.json();
    let ids: Vec<&Value> = matrix["labels"].as_array().into_iter().flatten().map(|label| &label["id"]).collect();
    assert_eq!(ids, ["co", "ju", "pc", "un"]);
    assert_eq!(matrix["cogency"][0], json!(["invalid", "invalid", "storage-access", "cogent"]));
    let table = api.get("/v1/rule-sets/warehouse/matrix?f=csv").await.text();
    assert!(table.starts_with("label,co,ju,pc,un\r\nco,invalid,invalid,storage-access,cogent\r\n"), "{table}");
    let page = api.get("/v1/rule-sets/warehouse/matrix?f=html").await;
    assert!(page.header("content-type").starts_with("text/html"));
    assert!(page.text().contains(">pallet cell</th><td>storage-access</td>"), "{}", page.text());
}

#[tokio::test]
async fn categories_come_with_a_suggestion() {
    let api = Api::new().await;
    let map = api.hall().await;
    let list = api.get(&format!("{map}/categories")).await.json();
    assert_eq!(list["ruleSet"], "site");
    let categories = list["categories"].as_array().expect("categories");
    let kinds: Vec<&str> = categories.iter().filter_map(|category| category["kind"].as_str()).collect();
    let (clusters, others) = kinds.split_at(kinds.len() - 3);
    assert!(clusters.len() >= 2 && clusters.iter().all(|&kind| kind == "cluster"), "{kinds:?}");
    assert_eq!(others, ["occupied", "unknown", "outside"]);
    for category in &categories[..clusters.len()] {
        assert!(category["faces"].as_u64() > Some(0), "{category}");
        assert_eq!(category["label"], category["suggestion"]["label"], "the suggestion is in force");
        let confidence = category["suggestion"]["confidence"].as_f64().expect("a number");
        assert!((0.0..=1.0).contains(&confidence));
        assert!(!category["suggestion"]["reason"].as_str().unwrap_or_default().is_empty());
    }
}

#[tokio::test]
async fn in_the_papers_way_categories_are_those_of_cells() {
    let api = Api::new().await;
    let map = api.hall().await;
    let options = json!({"orientation": {"method": "paper"}, "annotation": {"method": "vote"}});
    let asked = api.send_json(Method::POST, &format!("{map}/analyses?activate=true"), &[], &options).await;
    assert_eq!(asked.status, 202, "{}", asked.text());
    api.app.run_until_empty().await.expect("the queue can be worked on");
    let list = api.get(&format!("{map}/categories")).await.json();
    let categories = list["categories"].as_array().expect("categories");
    let kinds: Vec<&str> = categories.iter().filter_map(|category| category["kind"].as_str()).collect();
    assert_eq!(kinds, [["cluster"; 5].as_slice(), &["occupied", "unknown", "outside"]].concat());
    for category in &categories[..5] {
        assert!(category["cells"].as_u64() > Some(0), "{category}");
        assert_eq!(category["meanFeatures"].as_object().map(serde_json::Map::len), Some(13), "{category}");
    }
    let orientations = api.get(&format!("{map}/diagnostics")).await.json()["orientations"].take();
    let bins = |signal: &str| orientations[signal].as_array().map(Vec::len);
    assert_eq!(bins("histogram"), bins("mixture"));
    assert!(bins("mixture") > Some(0), "{orientations}");
}

#[tokio::test]
async fn labels_are_assigned_in_versions_without_a_job() {
    let api = Api::new().await;
    let map = api.hall().await;
    let path = format!("{map}/semantics");
    let suggested = api.get(&path).await;
    assert_eq!((&suggested.json()["version"], &suggested.json()["origin"]), (&json!(0), &json!("suggested")));
    let tag = suggested.header("etag").to_owned();
    let faces_before = api.get(&format!("{map}/collections/faces/items")).await;

    let all_corridor = api.all_labelled(&map, "co").await;
    let body = json!({"ruleSet": "warehouse", "assignment": all_corridor, "overrides": [{"face": 1, "label": "ju"}]});
    api.send_json(Method::PUT, &path, &[], &body).await.problem(428, "precondition-required");
    let assigned = put(&api, &path, &tag, &body).await;
    assert_eq!(assigned.status, 200, "{}", assigned.text());
    assert_eq!((&assigned.json()["version"], &assigned.json()["origin"]), (&json!(1), &json!("assigned")));
    assert_eq!(api.get(&path).await.header("etag"), assigned.header("etag"));
    put(&api, &path, &tag, &body).await.problem(412, "precondition-failed");

    let faces = api
        .get_with(&format!("{map}/collections/faces/items"), &[("if-none-match", faces_before.header("etag"))])
        .await;
    assert_eq!(faces.status, 200, "the labels changed, so the faces did");
    for face in faces.json()["features"].as_array().expect("faces") {
        let expected = if face["id"] == 1 { "ju" } else { "co" };
        assert_eq!(face["properties"]["label"], expected, "{face}");
    }
    assert_eq!(api.get("/v1/jobs").await.json()["jobs"].as_array().map(Vec::len), Some(1), "no job was needed");

    // What was read can be sent back.
    let again = put(&api, &path, assigned.header("etag"), &assigned.json()).await;
    assert_eq!(again.json()["version"], 2);
    let versions = api.get(&format!("{path}/versions")).await.json();
    let versions: Vec<&Value> =
        versions["versions"].as_array().into_iter().flatten().map(|record| &record["version"]).collect();
    assert_eq!(versions, [&json!(2), &json!(1)]);
}

#[tokio::test]
async fn an_assignment_that_makes_no_sense_is_refused_piece_by_piece() {
    let api = Api::new().await;
    let map = api.hall().await;
    let path = format!("{map}/semantics");
    let cases = [
        (json!({"assignment": {"0": "xx"}}), "/assignment/0"),
        (json!({"assignment": {"99": "co"}}), "/assignment/99"),
        (json!({"assignment": {"x/y": "co"}}), "/assignment/x~1y"),
        (json!({"assignment": {"300": "co"}}), "/assignment/300"),
        (json!({"overrides": [{"face": 1, "label": "co"}, {"face": 99_999, "label": "co"}]}), "/overrides/1"),
        (json!({"overrides": [{"face": 1, "label": "xx"}]}), "/overrides/0"),
        (json!({"ruleSet": "nonsense"}), "/ruleSet"),
        (json!({"ruleset": "office"}), "/ruleset"),
    ];
    for (body, pointer) in cases {
        let problem = put(&api, &path, "*", &body).await.problem(422, "invalid");
        assert_eq!(problem["errors"][0]["pointer"], pointer, "{body}: {problem}");
    }
    assert_eq!(api.get(&path).await.json()["version"], 0, "nothing was changed");
}
