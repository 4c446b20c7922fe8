//! The OpenAPI document is true: every operation answers as it says, and says all that it answers.
//!
//! [`valid`] has one good request for each operation of the document. [`wrongs`] spoils it in every way that fits the shape of
//! the operation. Each answer must be documented, and each documented refusal must be among the answers.

use std::collections::{BTreeMap, BTreeSet};

use axum::body::Body;
use axum::http::{HeaderName, Method, Request};
use serde_json::{Value, json};

use crate::client::{Answer, Api, HALL, METADATA, pgm, upload};

/// No resource has this id.
const NOBODY: &str = "00000000-0000-7000-8000-000000000000";
/// Longer than every body may be.
const TOO_LONG_BYTES: u64 = 1 << 40;
/// Longer than the body of any operation but an upload may be.
const LONG_BYTES: usize = 9 << 20;
/// Faults of the network, of the service and of its disk: a request by itself cannot provoke them.
const FAULTS: [&str; 4] = ["408", "500", "503", "507"];
/// What a service answers only where keys are required: `access` provokes it.
const WITH_KEYS: [&str; 2] = ["401", "429"];

/// A request that can be sent more than once, and spoilt.
#[derive(Debug, Clone, PartialEq)]
pub struct Sent {
    pub method: Method,
    pub path: String,
    pub headers: BTreeMap<&'static str, String>,
    pub body: Vec<u8>,
}

impl Sent {
    pub fn new(method: Method, path: impl Into<String>) -> Self {
        Self { method, path: path.into(), headers: BTreeMap::new(), body: Vec::new() }
    }

    pub fn with(mut self, name: &'static str, value: impl Into<String>) -> Self {
        self.headers.insert(name, value.into());
        self
    }

    fn without(mut self, name: &str) -> Self {
        self.headers.remove(name);
        self
    }

    pub fn json(self, body: &Value) -> Self {
        Self { body: body.to_string().into_bytes(), ..self }.with("content-type", "application/json")
    }

    pub fn at(self, path: impl Into<String>) -> Self {
        Self { path: path.into(), ..self }
    }

    pub async fn to(&self, api: &Api) -> Answer {
        let mut request = Request::new(Body::from(self.body.clone()));
        *request.method_mut() = self.method.clone();
        *request.uri_mut() = self.path.parse().expect("is an address");
        for (name, value) in &self.headers {
            request.headers_mut().insert(HeaderName::from_static(name), value.parse().expect("is a header"));
        }
        api.send(request).await
    }
}

/// What the requests are about.
pub struct Site {
    pub api: Api,
    /// Path of a map that is analysed.
    pub map: String,
    /// Path of a map that waits for its analysis.
    waiting: String,
    /// Job of the first one, which is over.
    pub over: String,
}

impl Site {
    pub async fn new() -> Self {
        Self::on(Api::new().await).await
    }

    /// The maps are uploaded with the key of the client.
    pub async fn on(api: Api) -> Self {
        let map = api.hall().await;
        let over = api.get("/v1/jobs").await.json()["jobs"][0]["jobID"].as_str().expect("an id").to_owned();
        let waiting = waiting_map(&api).await;
        Self { api, map, waiting, over }
    }

    /// Works on the queue until it is empty, and puts another map in it.
    pub async fn work(&mut self) {
        self.api.app.run_until_empty().await.expect("the queue can be worked on");
        self.waiting = waiting_map(&self.api).await;
    }

    /// A job that waits.
    async fn job(&self) -> String {
        let answer = self.api.send(upload(&pgm(HALL), METADATA)).await;
        answer.json()["jobID"].as_str().expect("an id").to_owned()
    }

    /// A rule set that may be written; its path and tag.
    pub async fn rule_set(&self, id: &str) -> (String, String) {
        let made = Sent::new(Method::POST, "/v1/rule-sets").json(&rule_set(id)).to(&self.api).await;
        assert_eq!(made.status, 201, "{}", made.text());
        (format!("/v1/rule-sets/{id}"), made.header("etag").to_owned())
    }
}

/// Uploads the hall; the path of the map.
async fn waiting_map(api: &Api) -> String {
    let answer = api.send(upload(&pgm(HALL), METADATA)).await.json();
    format!("/v1/maps/{}", answer["mapId"].as_str().expect("an id"))
}

/// Gives the hall a name.
fn name_hall(map: &str) -> Sent {
    let corrections = json!({"corrections": [{"kind": "name", "at": [4.0, -0.2], "name": "Hall"}]});
    Sent::new(Method::POST, format!("{map}/corrections")).json(&corrections).with("if-match", "*")
}

/// The path of an analysis of the first map.
async fn proposal(site: &Site) -> String {
    let list = site.api.get(&format!("{}/analyses", site.map)).await.json();
    let id = list["analyses"][0]["id"].as_str().expect("an id").to_owned();
    format!("{}/analyses/{id}", site.map)
}

fn rule_set(id: &str) -> Value {
    json!({"id": id, "labels": [
        {"id": "co", "name": "corridor", "color": "#1f77b4", "functionality": ["drivable"], "connectsTo": ["co"]},
        {"id": "un", "name": "unidentified", "color": "#999999"}]})
}

/// A good request for each operation, and the statuses that answer it. An operation without one fails the test.
#[allow(clippy::too_many_lines, reason = "a list: a line or two for each operation")]
pub async fn valid(site: &Site, operation: &str) -> (Sent, &'static [u16]) {
    let map = &site.map;
    let get = |path: String| (Sent::new(Method::GET, path), [200].as_slice());
    match operation {
        "getLandingPage" => get("/".into()),
        "getLiveness" => get("/health/live".into()),
        "getReadiness" => get("/health/ready".into()),
        "getMetrics" => get("/metrics".into()),
        "getOpenApi" => get("/openapi.json".into()),
        "getOpenApi30" => get("/openapi-3.0.json".into()),
        "getMapApi" => get(format!("{map}/api")),
        "getProblemType" => get("/problems/busy".into()),
        "signIn" => (Sent::new(Method::POST, "/v1/session"), &[204]),
        "signOut" => (Sent::new(Method::DELETE, "/v1/session"), &[204]),
        "listAuditEntries" => get("/v1/audit-log".into()),
        "listJobs" => get("/v1/jobs".into()),
        "getJob" => get(format!("/v1/jobs/{}", site.over)),
        "watchJob" => get(format!("/v1/jobs/{}/events", site.over)),
        "getJobResults" => get(format!("/v1/jobs/{}/results", site.over)),
        "getApiRoot" => get("/v1".into()),
        "getApiConformance" => get("/v1/conformance".into()),
        "listProcesses" => get("/v1/processes".into()),
        "getProcess" => get("/v1/processes/semantic-map".into()),
        "execute" => {
            let body = json!({"inputs": {"mapId": map.trim_start_matches("/v1/maps/")}});
            (Sent::new(Method::POST, "/v1/processes/semantic-map/execution").json(&body), &[200])
        }
        "retryJob" => {
            let job = site.job().await;
            assert_eq!(Sent::new(Method::DELETE, format!("/v1/jobs/{job}")).to(&site.api).await.status, 200);
            (Sent::new(Method::POST, format!("/v1/jobs/{job}/retry")), &[202])
        }
        "dismissJob" => (Sent::new(Method::DELETE, format!("/v1/jobs/{}", site.job().await)), &[200]),
        "listMaps" => get("/v1/maps".into()),
        "createMap" => {
            let message = json!({"info": {"resolution": 0.05, "width": 2, "height": 1, "origin": {
                "position": {"x": 0, "y": 0, "z": 0}, "orientation": {"x": 0, "y": 0, "z": 0, "w": 1}}}, "data": [0, 100]});
            (Sent::new(Method::POST, "/v1/maps").json(&message), &[202])
        }
        "getMap" => get(map.clone()),
        "updateMap" => (Sent::new(Method::PATCH, map).json(&json!({"name": "Hall"})).with("if-match", "*"), &[200]),
        "deleteMap" => (Sent::new(Method::DELETE, waiting_map(&site.api).await).with("if-match", "*"), &[204]),
        "listDeletedMaps" => get("/v1/deleted-maps".into()),
        "restoreMap" => {
            let deleted = waiting_map(&site.api).await;
            assert_eq!(Sent::new(Method::DELETE, &deleted).to(&site.api).await.status, 204);
            (Sent::new(Method::POST, format!("{deleted}/restore")), &[200])
        }
        "listAnalyses" => get(format!("{map}/analyses")),
        "createAnalysis" => (Sent::new(Method::POST, format!("{map}/analyses")).json(&json!({"seed": 7})), &[202, 200]),
        "getAnalysis" => get(proposal(site).await),
        "getAnalysisFaces" => get(format!("{}/faces", proposal(site).await)),
        "listAnalysisChanges" => get(format!("{}/changes", proposal(site).await)),
        "activateAnalysis" => {
            let list = site.api.get(&format!("{map}/analyses")).await.json();
            let id = list["analyses"].as_array().expect("a list").last().expect("the first one")["id"].clone();
            let path = format!("{map}/analyses/{}/activate", id.as_str().expect("an id"));
            (Sent::new(Method::POST, path), &[200])
        }
        "getDiagnostics" => get(format!("{map}/diagnostics")),
        "evaluate" => {
            let truth = json!({"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {"label": "corridor"},
                "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [2, 0], [2, 1], [0, 1], [0, 0]]]}}]});
            let sent = Sent::new(Method::POST, format!("{map}/evaluations")).json(&truth);
            (sent.with("content-type", "application/geo+json"), &[200])
        }
        "compareMaps" => get(format!("{map}/compare/{}", map.trim_start_matches("/v1/maps/"))),
        "listChanges" => get(format!("{map}/changes?since=0")),
        "getRegistry" => get(format!("{map}/registry")),
        "confirmCodes" => (Sent::new(Method::POST, format!("{map}/registry/confirm")).json(&json!({})), &[200]),
        "importNames" => {
            let names = json!({"type": "FeatureCollection", "features": [{"type": "Feature",
                "properties": {"name": "Hall", "collection": "places"}, "geometry": {"type": "Polygon",
                    "coordinates": [[[-2, -1], [20, -1], [20, 9], [-2, 9], [-2, -1]]]}}]});
            let sent = Sent::new(Method::POST, format!("{map}/names?crs=EPSG:3857")).json(&names);
            (sent.with("content-type", "application/geo+json"), &[200])
        }
        "locatePose" => get(format!("{map}/at?point=1,1&crs=EPSG:3857&heading=90")),
        "getNearest" => get(format!("{map}/nearest?point=1,1&crs=EPSG:3857&collection=faces&k=3")),
        "getImage" => get(format!("{map}/image.png")),
        "getCategoriesImage" => get(format!("{map}/categories.png")),
        "getRegionsImage" => get(format!("{map}/regions.png")),
        "getSemanticImage" => get(format!("{map}/semantic.png")),
        "getGraphReport" => get(format!("{map}/graph-report")),
        "getGraphReportImage" => get(format!("{map}/graph-report.png")),
        "getSemanticDrawing" => get(format!("{map}/semantic.svg")),
        "listCategories" => get(format!("{map}/categories")),
        "getSemantics" => get(format!("{map}/semantics")),
        "assignSemantics" => {
            let assignment = json!({"assignment": {"0": "co"}});
            (Sent::new(Method::PUT, format!("{map}/semantics")).json(&assignment).with("if-match", "*"), &[200])
        }
        "changeSemantics" => {
            let patch = json!({"assignment": {"0": "co"}});
            (Sent::new(Method::PATCH, format!("{map}/semantics")).json(&patch).with("if-match", "*"), &[200])
        }
        "previewSemantics" => {
            let patch = json!({"assignment": {"0": "co"}});
            (Sent::new(Method::POST, format!("{map}/semantics/preview")).json(&patch), &[200])
        }
        "getSemanticsVersion" => get(format!("{map}/semantics/versions/0")),
        "restoreSemantics" => {
            let path = format!("{map}/semantics/versions/0/restore");
            (Sent::new(Method::POST, path).with("if-match", "*"), &[200])
        }
        "listVersionChanges" => get(format!("{map}/semantics/versions/0/changes?since=0")),
        "undoSemantics" | "redoSemantics" => {
            // Something to undo, and for the one who redoes something undone.
            let patch = json!({"assignment": {"0": "co"}});
            let changed = Sent::new(Method::PATCH, format!("{map}/semantics")).json(&patch).with("if-match", "*");
            assert_eq!(changed.to(&site.api).await.status, 200);
            let step = |way: &str| Sent::new(Method::POST, format!("{map}/semantics/{way}")).with("if-match", "*");
            if operation == "redoSemantics" {
                assert_eq!(step("undo").to(&site.api).await.status, 200);
            }
            (step(operation.trim_end_matches("Semantics")), &[200])
        }
        "listCorrections" => get(format!("{map}/corrections")),
        "correctMap" => (name_hall(map), &[201]),
        "getCorrection" | "changeCorrection" | "deleteCorrection" => {
            let made = name_hall(map).to(&site.api).await;
            assert_eq!(made.status, 201, "{}", made.text());
            let list = made.json()["corrections"].clone();
            let id = list.as_array().and_then(|list| list.last()?["id"].as_str()).expect("an id").to_owned();
            let path = format!("{map}/corrections/{id}");
            match operation {
                "getCorrection" => get(path),
                "changeCorrection" => {
                    let patch = json!({"name": "Long hall"});
                    (Sent::new(Method::PATCH, path).json(&patch).with("if-match", "*"), &[200])
                }
                _ => (Sent::new(Method::DELETE, path).with("if-match", "*"), &[200]),
            }
        }
        "listSemanticsVersions" => get(format!("{map}/semantics/versions")),
        "getConformance" => get(format!("{map}/conformance")),
        "listCollections" => get(format!("{map}/collections")),
        "getCollection" => get(format!("{map}/collections/doors")),
        "getQueryables" | "getSchema" => get(format!("{map}/collections/faces/{}", operation[3..].to_lowercase())),
        "getFeatures" => get(format!("{map}/collections/faces/items")),
        "getFeature" => get(format!("{map}/collections/vertices/items/0")),
        "addFeature" => (Sent::new(Method::POST, format!("{map}/collections/faces/items")), &[403]),
        "replaceFeature" => {
            let path = format!("{map}/collections/faces/items/1");
            let feature = Sent::new(Method::GET, path.clone()).to(&site.api).await.json();
            let sent = Sent::new(Method::PUT, path).json(&feature).with("if-match", "*");
            (sent.with("content-type", "application/geo+json"), &[200])
        }
        "updateFeature" => {
            let sent =
                Sent::new(Method::PATCH, format!("{map}/collections/places/items/0")).json(&json!({"name": "Hall"}));
            (sent.with("if-match", "*"), &[200])
        }
        "getRoute" => {
            // Robots may drive wherever cells are free.
            let every = json!({"assignment": site.api.all_labelled(map, "co").await});
            let labelled = Sent::new(Method::PUT, format!("{map}/semantics")).json(&every).with("if-match", "*");
            assert_eq!(labelled.to(&site.api).await.status, 200);
            get(format!("{map}/routes?from=-1,3.5&to=12,0&crs=EPSG:3857&footprintRadiusM=0.2"))
        }
        "getDistanceMatrix" => {
            let every = json!({"assignment": site.api.all_labelled(map, "co").await});
            let labelled = Sent::new(Method::PUT, format!("{map}/semantics")).json(&every).with("if-match", "*");
            assert_eq!(labelled.to(&site.api).await.status, 200);
            let ends = json!({"from": ["-1,3.5", "face:1"], "to": ["12,0"], "crs": "EPSG:3857"});
            (Sent::new(Method::POST, format!("{map}/distance-matrix")).json(&ends), &[200])
        }
        "listExports" => get(format!("{map}/exports")),
        "getExport" => get(format!("{map}/exports/locations.csv?profile=odoo")),
        "listRuleSets" => get("/v1/rule-sets".into()),
        "createRuleSet" => (Sent::new(Method::POST, "/v1/rule-sets").json(&rule_set("new")), &[201]),
        "getRuleSet" => get("/v1/rule-sets/office".into()),
        "getCogencyMatrix" => get("/v1/rule-sets/office/matrix".into()),
        "replaceRuleSet" => {
            let (path, tag) = site.rule_set("replaced").await;
            (Sent::new(Method::PUT, path).json(&rule_set("replaced")).with("if-match", tag), &[200])
        }
        "deleteRuleSet" => {
            let (path, tag) = site.rule_set("deleted").await;
            (Sent::new(Method::DELETE, path).with("if-match", tag), &[204])
        }
        new => panic!("{new} has no example: add a good request for it here"),
    }
}

/// The good request, spoilt in every way that fits its shape, before it is sent itself.
fn wrongs(site: &Site, operation: &str, good: &Sent) -> Vec<Sent> {
    let sent = || good.clone();
    let parameter = if good.path.contains('?') { "&stranger=1" } else { "?stranger=1" };
    let mut wrongs = vec![
        sent().at(format!("{}{parameter}", good.path)),
        sent().with("origin", "https://elsewhere.example"),
        sent().with("host", "elsewhere.example"),
        sent().at(good.path.replace(&site.map, &site.waiting)),
    ];
    if good.method == Method::GET {
        wrongs.push(sent().with("accept", "image/x-nothing"));
    }
    if good.headers.contains_key("if-match") {
        wrongs.push(sent().with("if-match", "\"of yesterday\""));
        // A map is deleted without a condition, too, and then is not there for the good request.
        wrongs.extend((operation != "deleteMap").then(|| sent().without("if-match")));
    }
    if let Some(id) = good.path.split('/').find(|part| part.len() == NOBODY.len()) {
        wrongs.push(sent().at(good.path.replace(id, NOBODY)));
    }
    if !good.body.is_empty() {
        let misfit = Sent { body: br#"{"stranger": 1}"#.to_vec(), ..sent() };
        let broken = Sent { body: b"{".to_vec(), ..sent() };
        let long = Sent { body: vec![b' '; LONG_BYTES], ..sent() };
        wrongs.extend([misfit, broken, long, sent().with("content-type", "text/plain")]);
    }
    let own = |path: &str| sent().at(path.to_owned());
    wrongs.extend(match operation {
        "getProblemType" => vec![own("/problems/none")],
        "getProcess" => vec![own("/v1/processes/none")],
        "getCogencyMatrix" => vec![own("/v1/rule-sets/none/matrix")],
        "execute" => {
            let new = json!({"inputs": {"mapId": site.map.trim_start_matches("/v1/maps/"), "options": {"seed": 11}}});
            vec![
                own("/v1/processes/none/execution"),
                sent().json(&new).with("prefer", "respond-async"),
                sent().with("content-length", TOO_LONG_BYTES.to_string()),
            ]
        }
        "getRuleSet" | "replaceRuleSet" | "deleteRuleSet" => {
            vec![own("/v1/rule-sets/none"), own("/v1/rule-sets/office")]
        }
        "getCollection" | "getQueryables" | "getSchema" => {
            vec![own(&good.path.replace("/doors", "/none").replace("/faces", "/none"))]
        }
        "getFeature" => vec![own(&format!("{}/collections/vertices/items/999999", site.map))],
        "getExport" => vec![own(&format!("{}/exports/none.json", site.map))],
        "locatePose" => vec![own(&format!("{}/at?point=1000,0&crs=EPSG:3857", site.map))],
        "getNearest" => vec![own(&format!("{}/nearest?point=1000,0&crs=EPSG:3857", site.map))],
        "addFeature" => vec![own(&format!("{}/collections/edges/items", site.map))],
        "updateFeature" | "replaceFeature" => {
            let path = format!("{}/collections/locations/items", site.map);
            let members = |code: &str| json!({"properties": {"code": code}});
            let code = |id: &str, code: &str| own(&format!("{path}/{id}")).json(&members(code));
            vec![own(&format!("{}/collections/edges/items/1", site.map)), code("01-001", "01-003")]
        }
        "getRoute" => vec![own(&format!("{}/routes?from=face:1&to=face:9999", site.map))],
        "retryJob" => vec![own(&format!("/v1/jobs/{}/retry", site.over))],
        "dismissJob" => vec![own(&format!("/v1/jobs/{}", site.over))],
        "createRuleSet" => vec![sent().json(&rule_set("office"))],
        "createMap" => vec![
            own(&format!("/v1/maps?previous={}", site.map.trim_start_matches("/v1/maps/"))),
            sent().with("content-length", TOO_LONG_BYTES.to_string()),
            sent().with("idempotency-key", "k"),
            Sent { body: b"[]".to_vec(), ..sent().with("idempotency-key", "k") },
        ],
        "watchJob" => vec![sent().with("last-event-id", i64::MAX.to_string())],
        _ => Vec::new(),
    });
    // Another map changes nothing where the request is not about the first one.
    wrongs.retain(|wrong| wrong != good);
    wrongs
}

/// The operations of a document: id and description.
pub fn operations(document: &Value) -> Vec<(String, Value)> {
    let items = document["paths"].as_object().into_iter().flatten();
    let of_item =
        |(_, item): (&String, &Value)| item.as_object().expect("operations").values().cloned().collect::<Vec<_>>();
    let operations = items.flat_map(of_item);
    operations.map(|operation| (operation["operationId"].as_str().expect("an id").to_owned(), operation)).collect()
}

/// What the document says of an answer, its component looked up.
fn documented<'a>(document: &'a Value, operation: &'a Value, status: &str) -> Option<&'a Value> {
    let answer = operation["responses"].get(status)?;
    match answer.get("$ref").and_then(Value::as_str) {
        Some(reference) => document.pointer(reference.trim_start_matches('#')),
        None => Some(answer),
    }
}

/// An answer is documented, with its media type and its headers.
fn check(document: &Value, (id, operation): (&str, &Value), sent: &Sent, answer: &Answer) {
    let Sent { method, path, headers, .. } = sent;
    let told = || format!("{id}: {method} {path} {headers:?} -> {}: {}", answer.status, answer.text());
    let described = documented(document, operation, answer.status.as_str());
    let described = described.unwrap_or_else(|| panic!("not documented: {}", told()));
    let media_type = answer.header("content-type");
    match described.get("content").and_then(Value::as_object) {
        Some(content) => assert!(content.contains_key(media_type), "{media_type} is not documented: {}", told()),
        None => assert!(answer.body.is_empty(), "content is not documented: {}", told()),
    }
    for (name, header) in described["headers"].as_object().into_iter().flatten() {
        // A header whose type allows null may be missing.
        let may_be_missing = header["schema"]["type"].as_array().is_some_and(|types| types.contains(&json!("null")));
        assert!(may_be_missing || !answer.header(name).is_empty(), "{name} is missing: {}", told());
    }
}

#[tokio::test]
async fn every_operation_answers_as_documented_and_every_refusal_occurs() {
    let mut site = Site::new().await;
    let document = site.api.get("/openapi.json").await.json();
    let mut never: Vec<String> = Vec::new();
    for (id, operation) in operations(&document) {
        let (good, statuses) = valid(&site, &id).await;
        let mut seen = BTreeSet::new();
        for wrong in wrongs(&site, &id, &good) {
            let answer = wrong.to(&site.api).await;
            check(&document, (&id, &operation), &wrong, &answer);
            seen.insert(answer.status.as_str().to_owned());
        }
        for &status in statuses {
            let answer = good.to(&site.api).await;
            assert_eq!(answer.status, status, "{id}: {}", answer.text());
            check(&document, (&id, &operation), &good, &answer);
            seen.insert(answer.status.as_str().to_owned());
            if status == 202 {
                site.work().await;
            }
            let tag = answer.header("etag").to_owned();
            if good.method == Method::GET && !tag.is_empty() {
                let again = good.clone().with("if-none-match", tag);
                let answer = again.to(&site.api).await;
                check(&document, (&id, &operation), &again, &answer);
                seen.insert(answer.status.as_str().to_owned());
            }
        }
        let documented = operation["responses"].as_object().expect("responses").keys().map(String::as_str);
        let is_read = good.method == Method::GET;
        let is_elsewhere =
            |status: &str| FAULTS.contains(&status) || WITH_KEYS.contains(&status) || (is_read && status == "403");
        let provoked = documented.filter(|status| !is_elsewhere(status));
        never.extend(provoked.filter(|status| !seen.contains(*status)).map(|status| format!("{id}: {status}")));
    }
    assert!(never.is_empty(), "documented and never answered: {never:?}");
}

#[tokio::test]
async fn a_short_disk_and_a_full_queue_are_documented() {
    let document = Api::new().await.get("/openapi.json").await.json();
    let operations = operations(&document);
    let (id, operation) = operations.iter().find(|(id, _)| id == "createMap").expect("maps can be uploaded");
    let short = Api::with(|config| config.min_free_bytes = u64::MAX).await;
    let full = Api::with(|config| config.max_queued_jobs = 0).await;
    for (api, status) in [(&short, 507), (&full, 503)] {
        let request = upload(&pgm(HALL), METADATA);
        let answer = api.send(request).await;
        assert_eq!(answer.status, status, "{}", answer.text());
        check(&document, (id, operation), &Sent::new(Method::POST, "/v1/maps"), &answer);
    }
}

/// Every `$ref` of a document.
fn references(value: &Value, found: &mut Vec<String>) {
    match value {
        Value::Object(members) => {
            found.extend(members.get("$ref").and_then(Value::as_str).map(str::to_owned));
            members.values().for_each(|member| references(member, found));
        }
        Value::Array(entries) => entries.iter().for_each(|entry| references(entry, found)),
        _ => {}
    }
}

#[tokio::test]
async fn the_document_needs_nothing_from_elsewhere() {
    let api = Api::new().await;
    let of_map = format!("{}/api", waiting_map(&api).await);
    for path in ["/openapi.json", "/openapi-3.0.json", &of_map] {
        let document = api.get(path).await.json();
        let mut found = Vec::new();
        references(&document, &mut found);
        for reference in found {
            let pointer = reference.strip_prefix('#').unwrap_or_else(|| panic!("{path}: {reference} leads away"));
            assert!(document.pointer(pointer).is_some(), "{path}: {reference} leads nowhere");
        }
        let mut ids = BTreeSet::new();
        for (id, operation) in operations(&document) {
            assert!(ids.insert(id.clone()), "{path}: {id} is there twice");
            assert!(operation["tags"][0].is_string() && operation["summary"].is_string(), "{path}: {id}");
        }
    }
    let document = api.get("/openapi.json").await.json();
    assert_eq!(document["info"]["license"]["identifier"], "MIT OR Apache-2.0");
}

#[tokio::test]
async fn the_list_of_collections_is_that_of_the_service() {
    let api = Api::new().await;
    let map = api.hall().await;
    let document = api.get("/openapi.json").await.json();
    let listed = api.get(&format!("{map}/collections")).await.json();
    let listed: Vec<&Value> = listed["collections"].as_array().expect("a list").iter().map(|one| &one["id"]).collect();
    let documented = document["components"]["schemas"]["CollectionId"]["enum"].as_array().expect("an enum");
    assert_eq!(documented.iter().collect::<Vec<_>>(), listed);
}
