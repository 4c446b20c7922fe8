//! Maps, their analyses and their pictures.

use axum::body::Body;
use axum::http::Method;
use serde_json::{Value, json};

use crate::client::{Api, HALL, METADATA, pgm, request, upload};

#[tokio::test]
async fn the_landing_page_of_a_map_leads_to_all_below() {
    let api = Api::new().await;
    let map = api.hall().await;
    let page = api.get(&map).await.json();
    assert!(page["analysisId"].is_string());
    for link in page["links"].as_array().expect("links") {
        let path = link["href"].as_str().expect("an address").trim_start_matches("http://stillage.test");
        let answer = api.get(path).await;
        // A route needs its two ends.
        let expected = if path.ends_with("/routes") { 400 } else { 200 };
        assert_eq!(answer.status.as_u16(), expected, "{path}: {}", answer.text());
    }
    assert_eq!(api.get(&format!("{map}/")).await.json()["id"], page["id"], "with a slash too");
    api.get(&format!("{map}/?bogus=1")).await.problem(400, "bad-parameter");
}

#[tokio::test]
async fn maps_are_listed_page_by_page_newest_first() {
    let api = Api::new().await;
    let mut ids = Vec::new();
    for _ in 0..5 {
        let answer = api.send(upload(&pgm(HALL), METADATA)).await;
        ids.insert(0, answer.json()["mapId"].clone());
    }
    let mut seen = Vec::new();
    let mut path = "/v1/maps?limit=2".to_owned();
    loop {
        let answer = api.get(&path).await;
        let page = answer.json();
        seen.extend(page["maps"].as_array().expect("maps").iter().map(|map| map["id"].clone()));
        let next = page["links"].as_array().expect("links").iter().find(|link| link["rel"] == "next");
        let Some(next) = next else {
            assert_eq!(answer.header("link"), "");
            break;
        };
        let href = next["href"].as_str().expect("an address");
        assert!(answer.header("link").contains(href));
        path = href.trim_start_matches("http://stillage.test").to_owned();
    }
    assert_eq!(seen, ids);
}

#[tokio::test]
async fn a_map_is_renamed_and_georeferenced_in_turn() {
    let api = Api::new().await;
    let map = api.hall().await;
    let tag = api.get(&map).await.header("etag").to_owned();
    let patch = |tag: String, body| {
        let (api, map) = (&api, map.clone());
        async move { api.send_json(Method::PATCH, &map, &[("if-match", &tag)], &body).await }
    };
    let answer = patch(tag.clone(), json!({"name": "Hall 3"})).await;
    assert_eq!((answer.status.as_u16(), &answer.json()["name"]), (200, &json!("Hall 3")));
    let new = answer.header("etag").to_owned();
    assert_ne!(tag, new);
    patch(tag, json!({"name": "Hall 4"})).await.problem(412, "precondition-failed");
    let answer = patch(new, json!({"georeference": {"lon": 12.86, "lat": 56.66}})).await;
    assert_eq!(answer.json()["georeference"]["status"], "surveyed");
    assert_eq!(answer.json()["name"], "Hall 3", "what is absent stays");
    let bbox = api.get(&format!("{map}/collections/faces")).await.json()["extent"]["spatial"]["bbox"][0].clone();
    assert!((bbox[0].as_f64().expect("a number") - 12.86).abs() < 0.001, "{bbox}");
    let answer = patch("*".into(), json!({"georeference": null})).await;
    assert_eq!(answer.json()["georeference"]["status"], "nominal");
    // The plane of the nominal map is that of the equator: 111,319.49 m for a degree of longitude, 110,574.3 m of latitude.
    let pair = |x: f64, y: f64| json!({"map": [x, y], "lonLat": [x / 111_319.490_8, y / 110_574.275_8]});
    let pairs = json!([pair(0.0, 0.0), pair(50.0, 0.0), pair(0.0, 40.0)]);
    let answer = patch("*".into(), json!({"georeference": {"pairs": pairs}})).await;
    let fitted = answer.json()["georeference"].clone();
    assert!(fitted["residualM"].as_f64() < Some(1e-3) && fitted["scaleError"].as_f64() < Some(1e-6), "{fitted}");
    assert!(fitted["heading"].as_f64().is_some_and(|heading| heading.abs() < 1e-4), "{fitted}");
    assert_eq!(fitted["pairs"][1]["map"], json!([50.0, 0.0]), "the pairs are kept: {fitted}");
    let renamed = patch("*".into(), json!({"name": "Hall 3"})).await;
    assert_eq!(renamed.json()["georeference"], fitted);
    let again = patch("*".into(), json!({"georeference": fitted})).await;
    assert_eq!(again.json()["georeference"]["pairs"], fitted["pairs"], "what was read can be sent back");
    let few = patch("*".into(), json!({"georeference": {"pairs": [pair(0.0, 0.0)]}})).await.problem(422, "invalid");
    assert_eq!(few["errors"][0]["pointer"], "/georeference/pairs");
    let problem = patch("*".into(), json!({"georeference": {"lon": 0, "lat": 89}})).await.problem(422, "invalid");
    assert_eq!(problem["errors"][0]["pointer"], "/georeference/lat");
    patch("*".into(), json!({"nmae": "x"})).await.problem(422, "invalid");
    patch("*".into(), json!({"name": ""})).await.problem(422, "invalid");
}

#[tokio::test]
async fn a_map_that_is_not_analysed_says_where_to_look() {
    let api = Api::new().await;
    let answer = api.send(upload(&pgm(HALL), METADATA)).await;
    let job = answer.json();
    let map = format!("/v1/maps/{}", job["mapId"].as_str().expect("an id"));
    for path in
        ["/collections", "/collections/faces/items", "/semantics", "/categories", "/diagnostics", "/semantic.svg"]
    {
        let problem = api.get(&format!("{map}{path}")).await.problem(409, "not-analysed");
        let detail = problem["detail"].as_str().expect("a detail");
        assert!(detail.contains(job["jobID"].as_str().expect("an id")), "{detail}");
    }
    // The cells themselves need no analysis.
    let picture = api.get(&format!("{map}/image.png")).await;
    assert_eq!((picture.status.as_u16(), picture.header("content-type")), (200, "image/png"));
    let again = api.get_with(&format!("{map}/image.png"), &[("if-none-match", picture.header("etag"))]).await;
    assert_eq!((again.status.as_u16(), again.body.len()), (304, 0));
}

#[tokio::test]
async fn other_options_are_another_analysis_and_the_same_are_not() {
    let api = Api::new().await;
    let map = api.hall().await;
    let analyse = |options| {
        let (api, path) = (&api, format!("{map}/analyses"));
        async move { api.send_json(Method::POST, &path, &[], &options).await }
    };
    let same = analyse(json!({})).await;
    assert_eq!(same.status, 200, "{}", same.text());
    assert_eq!(same.json()["options"]["seed"], 1);
    let other = analyse(json!({"categorization": {"k": 3}})).await;
    assert_eq!(other.status, 202, "{}", other.text());
    api.app.run_until_empty().await.expect("the queue can be worked on");
    assert_eq!(api.get(&format!("{map}/analyses")).await.json()["analyses"].as_array().map(Vec::len), Some(2));
    let problem =
        analyse(json!({"categorization": {"k": 1}, "regions": {"minShare": 2}})).await.problem(422, "invalid");
    assert_eq!(problem["errors"][0]["pointer"], "/categorization/k");
    assert_eq!(problem["errors"][1]["pointer"], "/regions/minShare");
    let problem = analyse(json!({"categorization": {"k": "x"}})).await.problem(422, "invalid");
    assert_eq!(problem["errors"][0]["pointer"], "/categorization/k");
}

#[tokio::test]
async fn another_analysis_is_a_proposal_until_somebody_activates_it() {
    let api = Api::new().await;
    let map = api.hall().await;
    let path = format!("{map}/analyses");
    let analyse = async |query: &str, options| {
        let answer = api.send_json(Method::POST, &format!("{path}{query}"), &[], &options).await;
        api.app.run_until_empty().await.expect("the queue can be worked on");
        answer
    };
    // Seed and whether it is in force, newest first.
    let list = async || {
        let list = api.get(&path).await.json()["analyses"].take();
        let one = |analysis: &Value| (analysis["options"]["seed"].as_u64(), analysis["inForce"].as_bool());
        list.as_array().expect("a list").iter().map(one).collect::<Vec<_>>()
    };
    assert_eq!(list().await, [(Some(1), Some(true))], "the first one is in force at once");
    let labels = json!({"assignment": {"0": "ro"}});
    let labelled = api.send_json(Method::PATCH, &format!("{map}/semantics"), &[("if-match", "*")], &labels).await;
    assert_eq!(labelled.status, 200, "{}", labelled.text());
    let faces = api.get(&format!("{map}/collections/faces/items")).await;

    assert_eq!(analyse("", json!({"seed": 2})).await.status, 202);
    assert_eq!(list().await, [(Some(2), Some(false)), (Some(1), Some(true))]);
    let unchanged = api.get(&format!("{map}/collections/faces/items")).await;
    assert_eq!(unchanged.header("etag"), faces.header("etag"), "what clients see is what the person decided");
    let asked_again = analyse("", json!({"seed": 2})).await;
    assert_eq!((asked_again.status.as_u16(), &asked_again.json()["inForce"]), (200, &json!(false)));

    let activate =
        async |id: &str| api.send(request(Method::POST, &format!("{path}/{id}/activate"), &[], Body::empty())).await;
    let activated = activate(asked_again.json()["id"].as_str().expect("an id")).await;
    assert_eq!((activated.status.as_u16(), &activated.json()["inForce"]), (200, &json!(true)), "{}", activated.text());
    assert_eq!(list().await, [(Some(2), Some(true)), (Some(1), Some(false))]);
    activate("00000000-0000-7000-8000-000000000000").await.problem(404, "not-found");

    analyse("?activate=true", json!({"seed": 1})).await;
    assert_eq!(list().await, [(Some(2), Some(false)), (Some(1), Some(true))]);
    assert_eq!(api.get(&format!("{map}/semantics")).await.json()["assignment"]["0"], "ro", "with its labels");
    analyse("?activate=true", json!({"seed": 3})).await;
    assert_eq!(list().await, [(Some(3), Some(true)), (Some(2), Some(false)), (Some(1), Some(false))]);
    analyse("?activate=perhaps", json!({"seed": 3})).await.problem(400, "bad-parameter");
}

#[tokio::test]
async fn a_preset_is_written_out_in_the_answer() {
    let api = Api::new().await;
    let map = api.hall().await;
    let options = json!({"preset": "paper", "categorization": {"k": 3}});
    let asked = api.send_json(Method::POST, &format!("{map}/analyses"), &[], &options).await;
    assert_eq!(asked.status, 202, "{}", asked.text());
    api.app.run_until_empty().await.expect("the queue can be worked on");
    let analyses = api.get(&format!("{map}/analyses")).await.json();
    let found = analyses["analyses"].as_array().expect("a list").iter().map(|analysis| &analysis["options"]);
    let options = found.into_iter().find(|options| options["decomposition"]["method"] == "paper").expect("is there");
    assert_eq!(options.get("preset"), None);
    assert_eq!((&options["declutter"]["method"], &options["categorization"]["k"]), (&json!("none"), &json!(3)));
    // The options of an answer may be sent again: they are the same analysis.
    let again = api.send_json(Method::POST, &format!("{map}/analyses"), &[], options).await;
    assert_eq!(again.status, 200, "{}", again.text());
    let unknown = json!({"preset": "papr"});
    let problem = api.send_json(Method::POST, &format!("{map}/analyses"), &[], &unknown).await.problem(422, "invalid");
    assert_eq!(problem["errors"][0]["pointer"], "/preset");
    assert_eq!(problem["errors"][0]["detail"], "may not be papr: it is paper or halmstad2017");
}

#[tokio::test]
async fn diagnostics_hold_the_signals() {
    let api = Api::new().await;
    let map = api.hall().await;
    let diagnostics = api.get(&format!("{map}/diagnostics")).await.json();
    let length = |pointer: &str| diagnostics.pointer(pointer).and_then(|value| value.as_array()).map(Vec::len);
    assert!(length("/orientations/histogram") > Some(0), "{:?}", diagnostics["orientations"]["histogram"]);
    assert!(length("/orientations/anglesRad") >= Some(2), "{:?}", diagnostics["orientations"]["anglesRad"]);
    assert!(length("/radiograms") >= Some(2));
    assert_eq!(diagnostics["clutter"]["occupiedCells"], 0);
    assert_eq!(diagnostics["frame"], json!({"resolutionM": 0.25, "originM": [-2.0, -1.0], "yawRad": 0.0}));
    let stages: Vec<&str> =
        diagnostics["stages"].as_array().into_iter().flatten().filter_map(|stage| stage["name"].as_str()).collect();
    assert!(stages.contains(&"radiography"), "{stages:?}");
}

#[tokio::test]
async fn pictures_are_of_the_size_of_the_map_and_cached() {
    let api = Api::new().await;
    let map = api.hall().await;
    for picture in ["image.png", "categories.png", "regions.png", "semantic.png"] {
        let path = format!("{map}/{picture}");
        let answer = api.get_with(&path, &[("accept-encoding", "gzip")]).await;
        assert_eq!((answer.header("content-type"), answer.header("content-encoding")), ("image/png", ""), "{picture}");
        let reader = png::Decoder::new(std::io::Cursor::new(&answer.body)).read_info().expect("a PNG");
        if picture != "semantic.png" {
            assert_eq!((reader.info().width, reader.info().height), (62, 22), "{picture}");
        }
        let again = api.get_with(&path, &[("if-none-match", answer.header("etag"))]).await;
        assert_eq!((again.status.as_u16(), again.body.len()), (304, 0), "{picture}");
        api.get_with(&path, &[("accept", "application/json")]).await.problem(406, "not-acceptable");
    }
}

#[tokio::test]
async fn the_drawing_is_svg_that_a_browser_may_show() {
    let api = Api::new().await;
    let map = api.hall().await;
    let answer = api.get(&format!("{map}/semantic.svg")).await;
    assert_eq!((answer.status.as_u16(), answer.header("content-type")), (200, "image/svg+xml"));
    assert!(answer.text().starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\""), "{}", answer.text());
    let again = api.get_with(&format!("{map}/semantic.svg"), &[("if-none-match", answer.header("etag"))]).await;
    assert_eq!(again.status, 304);
}

#[tokio::test]
async fn health_and_metrics_tell_how_the_service_is() {
    let api = Api::new().await;
    assert_eq!(api.get("/health/live").await.json(), json!({"status": "live"}));
    assert_eq!(api.get("/health/ready").await.json(), json!({"status": "ready"}));
    api.hall().await;
    let metrics = api.get_with("/metrics", &[("accept", "text/plain")]).await;
    assert_eq!(metrics.status, 200);
    let text = metrics.text();
    assert!(text.contains(r#"jobs{state="successful"} 1"#), "{text}");
    assert!(text.contains(r#"http_requests_total{route="/v1/maps",method="POST",status="202"} 1"#), "{text}");
    assert!(text.contains("http_request_duration_seconds_bucket"), "{text}");
    api.app.announce_stop();
    let answer = api.get("/health/ready").await;
    answer.problem(503, "unavailable");
    assert!(!answer.header("retry-after").is_empty());
}
