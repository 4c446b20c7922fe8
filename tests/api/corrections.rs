//! What a person says about a map holds: drawn, cut, merged, erased, named, undone, and still there after another analysis.

use axum::body::Body;
use axum::http::Method;
use serde_json::{Value, json};

use crate::client::{Answer, Api, HALL, METADATA, form, pgm, request};

/// A rack in the free strip along the lower wall of the hall, in metres of the map frame.
const RACK: [[f64; 2]; 4] = [[2.0, -0.5], [6.0, -0.5], [6.0, 0.0], [2.0, 0.0]];

/// Corrects the map, whatever its version is.
async fn correct(api: &Api, map: &str, body: &Value) -> Answer {
    api.send_json(Method::POST, &format!("{map}/corrections"), &[("if-match", "*")], body).await
}

async fn step(api: &Api, map: &str, direction: &str) -> Answer {
    let path = format!("{map}/semantics/{direction}");
    api.send(request(Method::POST, &path, &[("if-match", "*")], Body::empty())).await
}

async fn corrections(api: &Api, map: &str) -> Value {
    api.get(&format!("{map}/corrections")).await.json()
}

/// The faces, with their shapes in metres of the map frame.
async fn faces(api: &Api, map: &str) -> Vec<Value> {
    let path = format!("{map}/collections/faces/items?limit=10000&crs=EPSG:3857");
    api.get(&path).await.json()["features"].as_array().expect("features").clone()
}

/// The label of the face at a point, and its name.
async fn face_at(api: &Api, map: &str, [x, y]: [f64; 2]) -> (String, Option<String>) {
    let path = format!("{map}/collections/faces/items?bbox={x},{y},{x},{y}&bbox-crs=EPSG:3857&crs=EPSG:3857");
    let found = api.get(&path).await.json();
    let [face] = found["features"].as_array().expect("features").as_slice() else { panic!("not one face: {found}") };
    let text = |name: &str| face["properties"][name].as_str().map(str::to_owned);
    (text("label").expect("a label"), text("name"))
}

fn draw(ring: &[[f64; 2]], label: &str, name: &str) -> Value {
    json!({"kind": "draw", "ring": ring, "label": label, "name": name})
}

#[tokio::test]
async fn a_rack_is_drawn_and_cut_and_named() {
    let api = Api::new().await;
    let map = api.hall().await;
    let none = corrections(&api, &map).await;
    assert_eq!((&none["version"], &none["corrections"]), (&json!(0), &json!([])));
    let before = faces(&api, &map).await.len();

    let drawn = correct(&api, &map, &draw(&RACK, "pc", "Rack 12")).await;
    assert_eq!(drawn.status, 201, "{}", drawn.text());
    assert!(drawn.header("location").ends_with(&format!("{map}/corrections/c1")), "{}", drawn.header("location"));
    let list = drawn.json();
    assert_eq!((&list["version"], &list["corrections"][0]["id"]), (&json!(1), &json!("c1")));
    assert_eq!(list["corrections"][0]["isApplied"], true);
    assert_eq!(list["corrections"][0]["ring"], json!(RACK));
    let rack = &list["corrections"][0]["faces"];
    assert_eq!(rack.as_array().expect("faces").len(), 1);
    let feature = api.get(&format!("{map}/collections/faces/items/{}", rack[0])).await.json();
    assert_eq!((&feature["properties"]["label"], &feature["properties"]["name"]), (&json!("pc"), &json!("Rack 12")));
    assert_eq!(feature["properties"]["areaM2"], 4.0, "its long sides join the wall and the goods, a cell away");
    assert_eq!(face_at(&api, &map, [4.0, -0.2]).await, ("pc".into(), Some("Rack 12".into())));
    assert!(faces(&api, &map).await.len() > before);
    let tags = (drawn.header("etag"), api.get(&format!("{map}/semantics")).await);
    assert_eq!(tags.0, tags.1.header("etag"), "one version, one tag");
    assert_eq!(tags.1.json()["correctionCount"], 1);

    let cut = correct(&api, &map, &json!({"kind": "split", "line": [[4.0, -0.6], [4.0, 0.1]]})).await;
    assert_eq!(cut.status, 201, "{}", cut.text());
    let cold = json!({"corrections": [{"kind": "name", "at": [5.0, -0.2], "name": "Cold store"},
        {"kind": "label", "at": [3.0, -0.2], "label": "co"}]});
    let both = correct(&api, &map, &cold).await;
    assert_eq!(both.status, 201, "{}", both.text());
    let ids: Vec<Value> =
        both.json()["corrections"].as_array().expect("a list").iter().map(|one| one["id"].clone()).collect();
    assert_eq!(ids, ["c1", "c2", "c3", "c4"]);
    assert_eq!(face_at(&api, &map, [5.0, -0.2]).await, ("pc".into(), Some("Cold store".into())));
    assert_eq!(face_at(&api, &map, [3.0, -0.2]).await.0, "co");

    let one = api.get(&format!("{map}/corrections/c3")).await;
    assert_eq!((&one.json()["name"], &one.json()["isApplied"]), (&json!("Cold store"), &json!(true)));
    api.get(&format!("{map}/corrections/c9")).await.problem(404, "not-found");
    api.get(&format!("{map}/corrections/nine")).await.problem(404, "not-found");
}

#[tokio::test]
async fn a_row_has_as_many_places_as_a_person_says() {
    let api = Api::new().await;
    let map = api.hall().await;
    let locations = async || {
        let path = format!("{map}/collections/locations/items?limit=1000");
        api.get(&path).await.json()["numberMatched"].as_u64().expect("a number")
    };
    let before = locations().await;
    let row = json!({"kind": "row", "rectangle": RACK, "places": 5, "label": "pc"});
    let made = correct(&api, &map, &row).await;
    assert_eq!(made.status, 201, "{}", made.text());
    assert_eq!(made.json()["corrections"][0]["faces"].as_array().expect("faces").len(), 5);
    assert_eq!(locations().await, before + 5);
    let changed = api
        .send_json(Method::PATCH, &format!("{map}/corrections/c1"), &[("if-match", "*")], &json!({"places": 4}))
        .await;
    assert_eq!(changed.json()["corrections"][0]["faces"].as_array().expect("faces").len(), 4, "{}", changed.text());
    assert_eq!(locations().await, before + 4);
}

#[tokio::test]
async fn changes_are_undone_and_redone() {
    let api = Api::new().await;
    let map = api.hall().await;
    let at = [4.0, -0.2];
    step(&api, &map, "undo").await.problem(409, "conflict");
    let suggested = face_at(&api, &map, at).await;
    correct(&api, &map, &draw(&RACK, "pc", "first")).await;
    let patch = json!({"assignment": {"0": "ju"}});
    api.send_json(Method::PATCH, &format!("{map}/semantics"), &[("if-match", "*")], &patch).await;
    let renamed = api
        .send_json(Method::PATCH, &format!("{map}/corrections/c1"), &[("if-match", "*")], &json!({"name": "second"}))
        .await;
    assert_eq!(renamed.status, 200, "{}", renamed.text());
    let name = async || face_at(&api, &map, at).await.1;
    assert_eq!(name().await.as_deref(), Some("second"));

    let undone = step(&api, &map, "undo").await;
    assert_eq!((&undone.json()["version"], &undone.json()["restores"]), (&json!(4), &json!(2)), "{}", undone.text());
    assert_eq!(undone.header("etag"), api.get(&format!("{map}/semantics")).await.header("etag"));
    assert_eq!(name().await.as_deref(), Some("first"));
    assert_eq!(step(&api, &map, "undo").await.json()["restores"], 1);
    assert_eq!(step(&api, &map, "undo").await.json()["restores"], 0);
    assert_eq!(face_at(&api, &map, at).await, suggested);
    assert_eq!(corrections(&api, &map).await["corrections"], json!([]));
    step(&api, &map, "undo").await.problem(409, "conflict");
    for restores in [1, 2, 3] {
        assert_eq!(step(&api, &map, "redo").await.json()["restores"], restores);
    }
    assert_eq!(name().await.as_deref(), Some("second"));
    step(&api, &map, "redo").await.problem(409, "conflict");

    let deleted =
        api.send(request(Method::DELETE, &format!("{map}/corrections/c1"), &[("if-match", "*")], Body::empty())).await;
    assert_eq!((deleted.status.as_u16(), &deleted.json()["corrections"]), (200, &json!([])));
    assert_eq!(step(&api, &map, "undo").await.json()["restores"], 3);
    let another = correct(&api, &map, &json!({"kind": "name", "at": at, "name": "third"})).await.json();
    assert_eq!(another["corrections"][1]["id"], "c2", "{another}");
    let versions = api.get(&format!("{map}/semantics/versions")).await.json();
    assert_eq!(
        versions["versions"].as_array().expect("versions").len() as u64,
        another["version"].as_u64().expect("a number")
    );
}

#[tokio::test]
async fn what_makes_no_sense_is_refused_where_it_is_wrong() {
    let api = Api::with(|config| config.max_correction_faces = 100).await;
    let map = api.hall().await;
    let bowtie = [[2.0, -0.5], [6.0, 0.0], [6.0, -0.5], [2.0, 0.0]];
    let far = [[50.0, 50.0], [51.0, 50.0], [51.0, 51.0]];
    let cases = [
        (json!({"kind": "draw", "ring": bowtie, "label": "pc"}), "/ring"),
        (json!({"kind": "draw", "ring": far, "label": "pc"}), "/ring"),
        (json!({"kind": "draw", "ring": RACK, "label": "shelf"}), "/label"),
        (json!({"kind": "draw", "ring": RACK}), ""),
        (json!({"kind": "draw", "ring": [[0, 0], [1, "x"], [1, 1]], "label": "pc"}), "/ring/1"),
        (json!({"kind": "split", "line": [[50.0, 50.0], [51.0, 50.0]]}), "/line"),
        (json!({"kind": "merge", "at": [[4.0, -0.2], [50.0, 50.0]]}), "/at/1"),
        (json!({"kind": "label", "at": [50.0, 50.0], "label": "pc"}), "/at"),
        (json!({"kind": "row", "rectangle": RACK, "places": 1_000_000}), "/places"),
        (json!({"kind": "row", "rectangle": RACK, "pitchM": 1e-9}), "/pitchM"),
        (json!({"kind": "row", "rectangle": RACK}), ""),
        (json!({"kind": "name", "at": [4.0, -0.2], "name": ""}), "/name"),
        (json!({"kind": "paint", "at": [4.0, -0.2]}), ""),
        (json!({"kind": "name", "at": [4.0, -0.2], "name": "x", "colour": 1}), ""),
    ];
    for (correction, within) in cases {
        let problem = correct(&api, &map, &correction).await.problem(422, "invalid");
        let pointer = problem["errors"][0]["pointer"].as_str().expect("a pointer");
        assert!(pointer.starts_with(within), "{correction}: {problem}");
        let list = json!({"corrections": [{"kind": "name", "at": [4.0, -0.2], "name": "x"}, correction]});
        let problem = correct(&api, &map, &list).await.problem(422, "invalid");
        let pointer = problem["errors"][0]["pointer"].as_str().expect("a pointer");
        assert!(pointer.starts_with(&format!("/corrections/1{within}")), "{list}: {problem}");
    }
    for (body, status, kind) in [
        (json!([]), 422, "invalid"),
        (json!({}), 422, "invalid"),
        (json!({"corrections": []}), 422, "invalid"),
        (json!({"corrections": 7}), 422, "invalid"),
        (json!({"corrections": [7]}), 422, "invalid"),
    ] {
        correct(&api, &map, &body).await.problem(status, kind);
    }
    let infinite = r#"{"kind": "label", "at": [1e999, 0], "label": "pc"}"#;
    let headers = [("if-match", "*"), ("content-type", "application/json")];
    let path = format!("{map}/corrections");
    api.send(request(Method::POST, &path, &headers, Body::from(infinite))).await.problem(422, "invalid");
    let long = Body::from(vec![b' '; 50 << 20]);
    api.send(request(Method::POST, &path, &headers, long)).await.problem(413, "too-large");
    let csv = [("if-match", "*"), ("content-type", "text/csv")];
    api.send(request(Method::POST, &path, &csv, Body::from("x,y"))).await.problem(415, "unsupported-media-type");
    assert_eq!(corrections(&api, &map).await["version"], 0, "nothing was changed");
}

#[tokio::test]
async fn a_map_has_only_so_many_corrections() {
    let api = Api::with(|config| config.max_corrections = 2).await;
    let map = api.hall().await;
    let name = json!({"kind": "name", "at": [4.0, -0.2], "name": "x"});
    assert_eq!(correct(&api, &map, &json!({"corrections": [name, name]})).await.status, 201);
    let problem = correct(&api, &map, &name).await.problem(422, "invalid");
    assert!(problem["detail"].as_str().expect("a text").contains("at most 2 corrections"), "{problem}");
}

#[tokio::test]
async fn two_people_correct_one_after_the_other() {
    let api = Api::new().await;
    let map = api.hall().await;
    let path = format!("{map}/corrections");
    let read = api.get(&path).await;
    let seen = [("if-match", read.header("etag"))];
    let name = |name: &str| json!({"kind": "name", "at": [4.0, -0.2], "name": name});
    api.send_json(Method::POST, &path, &[], &name("nobody")).await.problem(428, "precondition-required");
    assert_eq!(api.send_json(Method::POST, &path, &seen, &name("Ann")).await.status, 201);
    let late = api.send_json(Method::POST, &path, &seen, &name("Ben")).await.problem(412, "precondition-failed");
    let detail = late["detail"].as_str().expect("a text");
    assert!(detail.contains("version 1"), "{detail}");
    let again = api.get(&path).await;
    assert_eq!(again.json()["corrections"][0]["name"], "Ann");
    assert_eq!(
        api.send_json(Method::POST, &path, &[("if-match", again.header("etag"))], &name("Ben")).await.status,
        201
    );
    let unchanged = api.get_with(&path, &[("if-none-match", again.header("etag"))]).await;
    assert_eq!(unchanged.status, 200, "there is something new");
}

#[tokio::test]
async fn the_racks_of_a_plan_are_imported_at_once() {
    let api = Api::new().await;
    let map = api.hall().await;
    let square = |x: f64| json!([[[x, -0.5], [x + 1.0, -0.5], [x + 1.0, 0.0], [x, 0.0], [x, -0.5]]]);
    let rack = |x: f64, properties: Value| {
        json!({"type": "Feature", "properties": properties,
        "geometry": {"type": "Polygon", "coordinates": square(x)}})
    };
    let plan = |features: Value| json!({"type": "FeatureCollection", "features": features});
    let send = async |crs: &str, body: &Value| {
        let headers = [("if-match", "*"), ("content-type", "application/geo+json")];
        let path = format!("{map}/corrections{crs}");
        api.send(request(Method::POST, &path, &headers, Body::from(body.to_string()))).await
    };
    let racks = plan(
        json!([rack(1.0, json!({"name": "R1", "layer": "0"})), rack(3.0, json!({"name": "R2", "label": "pc"})),
        {"type": "Feature", "properties": null, "geometry": {"type": "LineString", "coordinates": [[1.5, -0.6], [1.5, 0.1]]}}]),
    );
    let made = send("?crs=EPSG:3857", &racks).await;
    assert_eq!(made.status, 201, "{}", made.text());
    assert!(made.header("location").ends_with("/corrections"));
    let kinds: Vec<Value> =
        made.json()["corrections"].as_array().expect("a list").iter().map(|one| one["kind"].clone()).collect();
    assert_eq!(kinds, ["draw", "draw", "split"]);
    assert_eq!(face_at(&api, &map, [3.5, -0.2]).await, ("pc".into(), Some("R2".into())));

    let wrong = plan(json!([rack(5.0, json!({"label": "shelf"})), rack(500.0, json!({}))]));
    let problem = send("?crs=EPSG:3857", &wrong).await.problem(422, "invalid");
    assert_eq!(problem["errors"][0]["pointer"], "/features/0/properties/label", "{problem}");
    let outside = plan(json!([rack(5.0, json!({})), rack(500.0, json!({}))]));
    let problem = send("?crs=EPSG:3857", &outside).await.problem(422, "invalid");
    assert_eq!(problem["errors"][0]["pointer"], "/features/1/geometry", "{problem}");
    assert_eq!(corrections(&api, &map).await["version"], 1, "all or nothing");
}

#[tokio::test]
async fn a_label_that_a_person_gave_to_a_face_stays_with_its_ground() {
    let api = Api::new().await;
    let map = api.hall().await;
    let at = |point: [f64; 2]| format!("{map}/at?point={},{}&crs=EPSG:3857", point[0], point[1]);
    let face = async |point| api.get(&at(point)).await.json()["face"]["id"].as_u64().expect("a face");
    let goods = face([0.0, 1.0]).await;
    let overrides = json!({"overrides": {goods.to_string(): "ju"}});
    let labelled = api.send_json(Method::PATCH, &format!("{map}/semantics"), &[("if-match", "*")], &overrides).await;
    assert_eq!(labelled.status, 200, "{}", labelled.text());
    correct(&api, &map, &draw(&RACK, "pc", "Rack")).await;
    assert_eq!(face_at(&api, &map, [0.0, 1.0]).await.0, "ju");
    let in_force = api.get(&format!("{map}/semantics")).await.json();
    assert_eq!(in_force["overrides"], json!([{"face": face([0.0, 1.0]).await, "label": "ju"}]));

    // What is drawn over it has the label that it is drawn with.
    let over = correct(&api, &map, &draw(&[[-0.6, 0.2], [0.7, 0.2], [0.7, 1.3], [-0.6, 1.3]], "co", "Over")).await;
    assert_eq!(over.status, 201, "{}", over.text());
    assert_eq!(face_at(&api, &map, [0.0, 1.0]).await, ("co".into(), Some("Over".into())));
    // And a person may decide otherwise about that face, too.
    let drawn = face([0.0, 1.0]).await;
    let overrides = json!({"overrides": {drawn.to_string(): "un"}});
    api.send_json(Method::PATCH, &format!("{map}/semantics"), &[("if-match", "*")], &overrides).await;
    assert_eq!(face_at(&api, &map, [0.0, 1.0]).await.0, "un");
}

#[tokio::test]
async fn a_preview_tells_what_corrections_would_do() {
    let api = Api::new().await;
    let map = api.hall().await;
    correct(&api, &map, &draw(&RACK, "pc", "Rack")).await;
    let preview = async |corrections: Value| {
        let path = format!("{map}/semantics/preview?crs=EPSG:3857");
        let answer = api.send_json(Method::POST, &path, &[], &json!({"corrections": corrections})).await;
        assert_eq!(answer.status, 200, "{}", answer.text());
        answer.json()
    };
    let known = corrections(&api, &map).await["corrections"].clone();
    let same = preview(known.clone()).await;
    assert_eq!(same["faces"], json!({"added": 0, "removed": 0, "reshaped": 0, "relabelled": 0}));
    let mut tried = known.as_array().expect("a list").clone();
    tried.push(json!({"kind": "split", "line": [[3.0, -0.6], [3.0, 0.1]]}));
    tried.push(json!({"kind": "split", "line": [[50.0, 50.0], [51.0, 50.0]]}));
    let cut = preview(json!(tried)).await;
    assert_eq!(cut["faces"], json!({"added": 1, "removed": 0, "reshaped": 1, "relabelled": 0}), "a quarter is new");
    let fits: Vec<&Value> =
        cut["corrections"].as_array().expect("a list").iter().map(|one| &one["isApplied"]).collect();
    assert_eq!(fits, [&json!(true), &json!(true), &json!(false)]);
    assert!(cut["corrections"][2]["reason"].is_string() && cut["corrections"][2]["id"].is_null());
    let changes: Vec<&str> = cut["features"]
        .as_array()
        .expect("features")
        .iter()
        .filter_map(|one| one["properties"]["change"].as_str())
        .collect();
    assert_eq!(changes.iter().filter(|change| **change == "reshaped").count(), 2, "before and now: {changes:?}");
    assert_eq!(corrections(&api, &map).await["version"], 1, "nothing is stored");
}

#[tokio::test]
async fn what_changed_between_two_versions_is_told() {
    let api = Api::new().await;
    let map = api.hall().await;
    correct(&api, &map, &draw(&RACK, "pc", "Rack")).await;
    correct(&api, &map, &json!({"kind": "label", "at": [4.0, -0.2], "label": "co"})).await;
    let changes = async |version: u64, since: u64| {
        let path = format!("{map}/semantics/versions/{version}/changes?since={since}&crs=EPSG:3857");
        let answer = api.get(&path).await;
        assert_eq!(answer.status, 200, "{}", answer.text());
        answer.json()
    };
    let relabelled = changes(2, 1).await;
    assert_eq!(relabelled["counts"], json!({"added": 0, "removed": 0, "reshaped": 0, "relabelled": 1}));
    let face = &relabelled["features"][0]["properties"];
    assert_eq!((&face["previousLabel"], &face["label"]), (&json!("pc"), &json!("co")));
    let drawn = changes(1, 0).await;
    let is_rack = |one: &&Value| one["properties"]["change"] == "added" && one["properties"]["label"] == "pc";
    assert_eq!(drawn["features"].as_array().expect("features").iter().filter(is_rack).count(), 1, "{drawn}");
    let back = changes(0, 1).await;
    assert_eq!(
        (&back["counts"]["removed"], &back["counts"]["added"]),
        (&drawn["counts"]["added"], &drawn["counts"]["removed"])
    );
    let since = api.get(&format!("{map}/changes?since=0")).await.json();
    assert!(
        since["faces"].as_array().expect("faces").iter().any(|face| face["before"].is_null() && face["now"] == "co")
    );
    api.get(&format!("{map}/semantics/versions/9/changes")).await.problem(404, "not-found");
}

#[tokio::test]
async fn corrections_outlive_another_analysis() {
    let api = Api::new().await;
    let map = api.hall().await;
    let both =
        json!({"corrections": [draw(&RACK, "pc", "Rack"), {"kind": "split", "line": [[4.0, -0.6], [4.0, 0.1]]}]});
    assert_eq!(correct(&api, &map, &both).await.status, 201);
    let first = api.get(&format!("{map}/analyses")).await.json()["analyses"][0]["id"].clone();
    let other = json!({"seed": 7, "categorization": {"k": 3}});
    let job = api.send_json(Method::POST, &format!("{map}/analyses?activate=true"), &[], &other).await;
    assert_eq!(job.status, 202, "{}", job.text());
    api.app.run_until_empty().await.expect("the queue can be worked on");
    let list = corrections(&api, &map).await;
    assert_eq!(list["version"], 2, "{list}");
    for correction in list["corrections"].as_array().expect("a list") {
        assert_eq!(correction["isApplied"], true, "{correction}");
    }
    assert_eq!(face_at(&api, &map, [5.0, -0.2]).await, ("pc".into(), Some("Rack".into())));
    let semantics = api.get(&format!("{map}/semantics")).await.json();
    assert_eq!((&semantics["origin"], &semantics["carried"]["from"]), (&json!("carried"), &json!(1)), "{semantics}");
    step(&api, &map, "undo").await.problem(409, "conflict");

    // Back to the first analysis, with the corrections as they were there.
    let path = format!("{map}/analyses/{}/activate", first.as_str().expect("an id"));
    assert_eq!(api.send(request(Method::POST, &path, &[], Body::empty())).await.status, 200);
    assert_eq!(corrections(&api, &map).await["corrections"].as_array().expect("a list").len(), 2);
}

#[tokio::test]
async fn corrections_come_along_to_another_scan_of_the_site() {
    let api = Api::new().await;
    let map = api.hall().await;
    let far = json!({"kind": "name", "at": [0.0, 1.0], "name": "Bay"});
    let both = json!({"corrections": [draw(&RACK, "pc", "Rack"), far]});
    assert_eq!(correct(&api, &map, &both).await.status, 201);
    let id = map.trim_start_matches("/v1/maps/");
    let metadata = METADATA.replace("[-2.0, -1.0, 0.0]", "[10.0, 5.0, 0.0]");
    let scan = form(&[
        ("image", Some("map.pgm"), &pgm(HALL)),
        ("metadata", Some("map.yaml"), metadata.as_bytes()),
        ("previous", None, id.as_bytes()),
    ]);
    let accepted = api.send(scan).await;
    assert_eq!(accepted.status, 202, "{}", accepted.text());
    let next = format!("/v1/maps/{}", accepted.json()["mapId"].as_str().expect("an id"));
    // What is corrected after the upload says nothing of it.
    correct(&api, &map, &json!({"kind": "name", "at": [0.0, 1.0], "name": "Later"})).await;
    api.app.run_until_empty().await.expect("the queue can be worked on");
    let list = corrections(&api, &next).await;
    assert_eq!(list["corrections"].as_array().expect("a list").len(), 2, "{list}");
    let moved = list["corrections"][0]["ring"][0].as_array().expect("a point").clone();
    let near = |value: &Value, wished: f64| (value.as_f64().expect("a number") - wished).abs() < 0.1;
    assert!(near(&moved[0], 14.0) && near(&moved[1], 5.5), "{moved:?}");
    assert_eq!(face_at(&api, &next, [16.0, 5.8]).await, ("pc".into(), Some("Rack".into())));
    let semantics = api.get(&format!("{next}/semantics")).await.json();
    assert_eq!((&semantics["origin"], &semantics["carried"]["map"]), (&json!("carried"), &json!(id)), "{semantics}");
    let again = corrections(&api, &next).await;
    assert_eq!(again["version"], list["version"], "it is carried once");
}

#[tokio::test]
async fn a_rule_set_without_a_label_that_a_correction_gives_is_refused() {
    let api = Api::new().await;
    let map = api.hall().await;
    correct(&api, &map, &draw(&RACK, "pc", "Rack")).await;
    let labels = json!({"id": "bare", "labels": [{"id": "un", "name": "unidentified", "color": "#999999"}]});
    assert_eq!(api.send_json(Method::POST, "/v1/rule-sets", &[], &labels).await.status, 201);
    let patch = json!({"ruleSet": "bare"});
    let refused = api.send_json(Method::PATCH, &format!("{map}/semantics"), &[("if-match", "*")], &patch).await;
    let problem = refused.problem(422, "invalid");
    assert_eq!(problem["errors"][0]["pointer"], "/ruleSet", "{problem}");
    let both = json!({"ruleSet": "bare", "corrections": null});
    let both = api.send_json(Method::PATCH, &format!("{map}/semantics"), &[("if-match", "*")], &both).await;
    assert_eq!(both.status, 200, "{}", both.text());
}
