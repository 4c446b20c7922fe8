//! Executions: OGC API Processes part 1.

use axum::http::Method;
use serde_json::{Value, json};

use crate::client::{Answer, Api};

const EXECUTION: &str = "/v1/processes/semantic-map/execution";

async fn execute(api: &Api, headers: &[(&str, &str)], inputs: &Value) -> Answer {
    api.send_json(Method::POST, EXECUTION, headers, &json!({"inputs": inputs})).await
}

/// An empty room of 4 by 3 m.
fn room() -> Value {
    let (width, height) = (40_usize, 30_usize);
    let cell = |index: usize| {
        let (x, y) = (index % width, index / width);
        if x == 0 || y == 0 || x == width - 1 || y == height - 1 { 100 } else { 0 }
    };
    json!({"info": {"resolution": 0.1, "width": width, "height": height, "origin": {
        "position": {"x": 0, "y": 0, "z": 0}, "orientation": {"x": 0, "y": 0, "z": 0, "w": 1}}},
        "data": (0..width * height).map(cell).collect::<Vec<_>>()})
}

#[tokio::test]
async fn a_process_is_described() {
    let api = Api::new().await;
    let list = api.get("/v1/processes").await.json();
    assert_eq!(
        (&list["processes"][0]["id"], list["processes"].as_array().map(Vec::len)),
        (&json!("semantic-map"), Some(1))
    );
    let process = api.get("/v1/processes/semantic-map").await.json();
    let names = |member: &str| process[member].as_object().map(|members| members.keys().cloned().collect::<Vec<_>>());
    assert_eq!(
        names("outputs").map(|mut names| {
            names.sort();
            names
        }),
        Some(["analysis", "faces", "locations", "map"].map(str::to_owned).into())
    );
    for (name, input) in process["inputs"].as_object().expect("inputs") {
        assert!(input["title"].is_string() && input["schema"].is_object(), "{name}");
    }
    api.get("/v1/processes/none").await.problem(404, "not-found");
}

#[tokio::test]
async fn a_map_that_is_sent_is_analysed_by_a_job() {
    let api = Api::new().await;
    let inputs = json!({"occupancyGrid": room(), "name": "Room"});
    let asked = execute(&api, &[("prefer", "respond-async")], &inputs).await;
    assert_eq!(asked.status, 201, "{}", asked.text());
    assert_eq!(asked.header("preference-applied"), "respond-async");
    let (job, info) = (asked.header("location").to_owned(), asked.json());
    assert_eq!((&info["status"], &info["processID"]), (&json!("accepted"), &json!("semantic-map")));
    api.get(&format!("{job}/results")).await.problem(404, "not-found");
    api.app.run_until_empty().await.expect("the queue can be worked on");
    let results = api.get(&format!("{job}/results")).await.json();
    let faces = results["faces"]["href"].as_str().expect("an address").trim_start_matches("http://stillage.test");
    assert!(api.get(faces).await.json()["numberMatched"].as_u64() > Some(0));
    let status = api.get(&job).await.json();
    assert!(status["links"].as_array().is_some_and(|links| {
        links.iter().any(|link| link["href"].as_str().is_some_and(|href| href.ends_with("/results")))
    }));
}

#[tokio::test]
async fn results_are_waited_for() {
    let api = Api::new().await;
    let inputs = json!({"occupancyGrid": room()});
    let (answer, worked) = tokio::join!(execute(&api, &[("prefer", "respond-sync")], &inputs), async {
        // The job is queued while this waits: the queue is worked on until its results are there.
        while api.get("/v1/jobs").await.json()["jobs"][0]["status"] != "successful" {
            api.app.run_until_empty().await?;
            tokio::task::yield_now().await;
        }
        Ok::<_, stillage::app::AppError>(())
    });
    worked.expect("the queue can be worked on");
    assert_eq!(answer.status, 200, "{}", answer.text());
    let map = answer.json()["map"]["href"].as_str().expect("an address").rsplit('/').next().expect("an id").to_owned();
    // The same analysis again is answered at once, with the outputs that are named.
    let body = json!({"inputs": {"mapId": map}, "outputs": {"faces": {}}, "response": "document"});
    let again = api.send_json(Method::POST, EXECUTION, &[("prefer", "respond-async")], &body).await;
    let names: Vec<String> = again.json().as_object().expect("results").keys().cloned().collect();
    assert_eq!((again.status.as_u16(), names), (200, vec!["faces".to_owned()]));
    let body = json!({"inputs": {"mapId": map}, "outputs": {"map": {}}, "response": "raw"});
    let raw = api.send_json(Method::POST, EXECUTION, &[], &body).await.json();
    assert!(raw["href"].as_str().is_some_and(|href| href.ends_with(&map)), "{raw}");
    let body = json!({"inputs": {"mapId": map}, "outputs": {"map": {}}});
    assert_eq!(
        api.send_json(Method::POST, EXECUTION, &[], &body).await.json(),
        raw,
        "one output is answered by itself"
    );
    let other = execute(&api, &[("prefer", "wait=0")], &json!({"mapId": map, "options": {"seed": 5}})).await;
    assert_eq!((other.status.as_u16(), &other.json()["status"]), (201, &json!("accepted")));
}

#[tokio::test]
async fn what_cannot_be_executed_is_refused_by_its_input() {
    let api = Api::new().await;
    let mut wide = room();
    wide["info"]["width"] = 41.into();
    for (inputs, pointer) in [
        (json!({}), "/inputs"),
        (json!({"mapId": "00000000-0000-7000-8000-000000000000"}), "/inputs/mapId"),
        (json!({"occupancyGrid": room(), "options": {"categorization": {"k": 0}}}), "/inputs/options/categorization/k"),
    ] {
        let problem = execute(&api, &[], &inputs).await.problem(422, "invalid");
        assert_eq!(problem["errors"][0]["pointer"], pointer, "{problem}");
    }
    let problem = execute(&api, &[], &json!({"occupancyGrid": wide})).await.problem(422, "invalid");
    assert!(
        problem["errors"][0]["pointer"].as_str().is_some_and(|at| at.starts_with("/inputs/occupancyGrid")),
        "{problem}"
    );
    let body = json!({"inputs": {"occupancyGrid": room()}, "outputs": {"none": {}}});
    let problem = api.send_json(Method::POST, EXECUTION, &[], &body).await.problem(422, "invalid");
    assert_eq!(problem["errors"][0]["pointer"], "/outputs/none");
    let body = json!({"inputs": {"occupancyGrid": room()}, "response": "raw"});
    let problem = api.send_json(Method::POST, EXECUTION, &[], &body).await.problem(422, "invalid");
    assert_eq!(problem["errors"][0]["pointer"], "/response");
    assert_eq!(api.get("/v1/jobs?processID=semantic-map").await.json()["jobs"], json!([]));
}

#[tokio::test]
async fn jobs_are_listed_by_process_time_and_duration() {
    let api = Api::new().await;
    execute(&api, &[("prefer", "respond-async")], &json!({"occupancyGrid": room()})).await;
    api.app.run_until_empty().await.expect("the queue can be worked on");
    execute(&api, &[("prefer", "respond-async")], &json!({"occupancyGrid": room(), "name": "waits"})).await;
    let count = async |query: &str| api.get(&format!("/v1/jobs?{query}")).await.json()["jobs"].as_array().map(Vec::len);
    for (query, expected) in [
        ("processID=semantic-map,other", 2),
        ("processID=other", 0),
        ("type=process", 2),
        ("datetime=2026-01-01/..", 2),
        ("datetime=../2026-01-01", 0),
        // A job that waits has no duration.
        ("minDuration=0", 1),
        ("maxDuration=600", 1),
        ("minDuration=600", 0),
        ("status=accepted&maxDuration=600", 0),
    ] {
        assert_eq!(count(query).await, Some(expected), "{query}");
    }
    let page = api.get("/v1/jobs?datetime=2026-01-01/..&limit=1").await;
    let next = page.json()["links"][1]["href"].as_str().expect("a second page").to_owned();
    assert!(next.contains("?datetime=2026-01-01/..&limit=1&after="), "{next}");
    assert_eq!(
        api.get(next.trim_start_matches("http://stillage.test")).await.json()["jobs"][0]["status"],
        "successful"
    );
}

#[tokio::test]
async fn the_root_of_processes_leads_to_them() {
    let api = Api::new().await;
    let root = api.get("/v1").await.json();
    for rel in ["processes", "job-list", "conformance"] {
        let rel = format!("http://www.opengis.net/def/rel/ogc/1.0/{rel}");
        let links = root["links"].as_array().expect("links");
        let href = links.iter().find(|link| link["rel"] == rel).expect("a link")["href"].as_str().expect("an address");
        assert_eq!(api.get(href.trim_start_matches("http://stillage.test")).await.status, 200, "{href}");
    }
    let classes = api.get("/v1/conformance").await.json()["conformsTo"].clone();
    let class = json!("http://www.opengis.net/spec/ogcapi-common-1/1.0/conf/core");
    assert!(classes.as_array().is_some_and(|classes| classes.contains(&class)), "{classes}");
}
