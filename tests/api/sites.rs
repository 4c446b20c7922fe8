//! Maps of one site: alignment, codes that stay, what changed.

use axum::body::Body;
use axum::http::{Method, Request};
use serde_json::{Value, json};

use crate::client::{Api, HALL, METADATA, form, pgm};

/// Another building.
const OFFICE: &str = "
    ########################
    #......#.......#.......#
    #......#.......#.......#
    #......#...............#
    #..........#####.......#
    #......#.......#.......#
    ########################
";

/// The rows of a picture.
fn rows(picture: &str) -> Vec<Vec<u8>> {
    picture.lines().map(|line| line.trim().as_bytes().to_vec()).filter(|line| !line.is_empty()).collect()
}

/// The hall with a stub of a wall, so that its ends differ.
fn site() -> Vec<Vec<u8>> {
    let mut rows = rows(HALL);
    for row in &mut rows[1..12] {
        row[58] = b'#';
    }
    rows
}

fn first_scan() -> Vec<u8> {
    pgm(&site().iter().map(|row| format!("{}\n", String::from_utf8_lossy(row))).collect::<String>())
}

/// The site without the pallet in the lower left corner, turned upside down, with unexplored ground around.
fn second_scan() -> Vec<u8> {
    let mut rows = site();
    for row in &mut rows[12..16] {
        row[5..8].fill(b'.');
    }
    turned(&rows)
}

/// The site but for its left end, turned likewise.
fn partial_scan() -> Vec<u8> {
    let mut rows = site();
    for row in &mut rows {
        row[..13].fill(b'?');
    }
    turned(&rows)
}

/// A scan turned upside down, three columns further to the right and a row higher, with unexplored ground around.
fn turned(rows: &[Vec<u8>]) -> Vec<u8> {
    let turned = rows.iter().rev().map(|row| row.iter().rev().copied().collect::<Vec<u8>>());
    let framed = turned.map(|row| format!("???{}", String::from_utf8_lossy(&row)));
    let blank = "?".repeat(65);
    pgm(&std::iter::once(blank.clone()).chain(framed).chain([blank]).collect::<Vec<_>>().join("\n"))
}

fn upload_after(image: &[u8], previous: &str) -> Request<Body> {
    let previous = previous.trim_start_matches("/v1/maps/");
    form(&[
        ("image", Some("hall.pgm"), image),
        ("metadata", Some("hall.yaml"), METADATA.as_bytes()),
        ("previous", None, previous.as_bytes()),
    ])
}

/// Uploads another scan of the site of a map and analyses it; its path.
async fn scanned_again(api: &Api, image: &[u8], previous: &str) -> String {
    let answer = api.send(upload_after(image, previous)).await;
    assert_eq!(answer.status, 202, "{}", answer.text());
    api.app.run_until_empty().await.expect("the queue can be worked on");
    format!("/v1/maps/{}", answer.json()["mapId"].as_str().expect("an id"))
}

fn entries(registry: &Value, state: &str) -> Vec<String> {
    let entries = registry["entries"].as_array().expect("a list").iter().filter(|entry| entry["state"] == state);
    entries.map(|entry| entry["code"].as_str().expect("a code").to_owned()).collect()
}

async fn codes(api: &Api, map: &str) -> Vec<String> {
    let items = api.get(&format!("{map}/collections/locations/items?limit=1000")).await.json();
    let features = items["features"].as_array().expect("features").iter();
    features.map(|feature| feature["id"].as_str().expect("a code").to_owned()).collect()
}

#[tokio::test]
async fn codes_stay_with_their_places_through_a_new_scan() {
    let api = Api::new().await;
    let first = api.analysed(&first_scan()).await;
    let before = codes(&api, &first).await;
    assert!(before.len() >= 20, "{before:?}");
    let second = scanned_again(&api, &second_scan(), &first).await;

    let map = api.get(&second).await.json();
    assert_eq!(map["site"], api.get(&first).await.json()["site"]);
    let alignment = &map["alignment"];
    assert!((alignment["turnDeg"].as_f64().expect("degrees").abs() - 180.0).abs() < 0.5, "{alignment}");
    assert!(alignment["agreement"].as_f64() > Some(0.8) && alignment["ambiguous"] == false, "{alignment}");

    let registry = api.get(&format!("{second}/registry")).await.json();
    assert_eq!((&registry["stale"], &registry["lost"]), (&json!(0), &json!(1)), "{registry}");
    let lost = entries(&registry, "lost");
    let kept: Vec<String> = before.iter().filter(|code| !lost.contains(code)).cloned().collect();
    assert_eq!(codes(&api, &second).await, kept);
    assert_eq!(codes(&api, &first).await, before, "the first map has its codes still");

    let compared = api.get(&format!("{first}/compare/{}", second.trim_start_matches("/v1/maps/"))).await.json();
    assert_eq!(compared["locations"]["removed"][0]["code"], json!(lost[0]), "{compared}");
    assert_eq!(compared["locations"]["added"], json!([]));
    let changed = compared["locations"]["changed"].as_array().expect("a list");
    assert!(changed.iter().all(|change| change["code"] == change["codeBefore"]), "{compared}");
}

/// The face at a point of the first scan, metres of its map frame: id and label.
async fn face_at(api: &Api, map: &str, [x, y]: [f64; 2]) -> (u64, String) {
    let path = format!("{map}/collections/faces/items?bbox={x},{y},{x},{y}&bbox-crs=EPSG:3857&crs=EPSG:3857");
    let found = api.get(&path).await.json();
    let [face] = found["features"].as_array().expect("features").as_slice() else { panic!("not one face: {found}") };
    (face["id"].as_u64().expect("a number"), face["properties"]["label"].as_str().expect("a label").to_owned())
}

#[tokio::test]
async fn labels_stay_with_their_ground_through_a_new_scan() {
    let api = Api::new().await;
    let first = api.analysed(&first_scan()).await;
    // A pallet that the second scan does not show, another one, and an aisle.
    let (gone, other, aisle) = ([-0.375, 0.75], [3.375, 2.75], [5.0, 1.75]);
    let (pallet, _) = face_at(&api, &first, gone).await;
    let (kept, _) = face_at(&api, &first, other).await;
    let of_aisle = api.get(&format!("{first}/collections/faces/items/{}", face_at(&api, &first, aisle).await.0)).await;
    let category = of_aisle.json()["properties"]["category"].to_string();
    let decision =
        json!({"overrides": {pallet.to_string(): "ro", kept.to_string(): "ro"}, "assignment": {category: "ju"}});
    let decided = api.send_json(Method::PATCH, &format!("{first}/semantics"), &[("if-match", "*")], &decision).await;
    assert_eq!(decided.status, 200, "{}", decided.text());

    let second = scanned_again(&api, &partial_scan(), &first).await;
    let semantics = api.get(&format!("{second}/semantics")).await.json();
    let carried = &semantics["carried"];
    assert_eq!(
        (&semantics["origin"], &semantics["version"], &carried["map"]),
        (&json!("carried"), &json!(1), &json!(first.trim_start_matches("/v1/maps/")))
    );
    assert_eq!((&carried["from"], &carried["kept"]), (&json!(1), &json!(2)), "{carried}");
    assert_eq!(carried["lost"].as_array().map(Vec::len), Some(1), "{carried}");
    assert_eq!((&carried["lost"][0]["face"], &carried["lost"][0]["label"]), (&json!(pallet), &json!("ro")));
    let turned = |[x, y]: [f64; 2]| [-2.0 + 65.0 * 0.25 - (x + 2.0), -1.0 + 23.0 * 0.25 - (y + 1.0)];
    let told = carried["lost"][0]["at"].as_array().expect("a point");
    let wished = turned(gone);
    assert!(
        (0..2).all(|axis| (told[axis].as_f64().expect("metres") - wished[axis]).abs() < 0.5),
        "{told:?} {wished:?}"
    );
    assert_eq!(face_at(&api, &second, turned(other)).await.1, "ro");
    assert_eq!(face_at(&api, &second, turned(aisle)).await.1, "ju");
    let again = api.get(&format!("{second}/semantics/versions")).await.json();
    assert_eq!(again["versions"].as_array().map(Vec::len), Some(1), "it is carried once");
}

#[tokio::test]
async fn another_building_is_refused_and_nothing_is_stored() {
    let api = Api::new().await;
    let hall = api.hall().await;
    let problem = api.send(upload_after(&pgm(OFFICE), &hall)).await.problem(409, "not-same-site");
    assert!(problem["detail"].as_str().expect("a text").contains("without previous"), "{problem}");
    assert_eq!(api.get("/v1/maps").await.json()["maps"].as_array().map(Vec::len), Some(1));
    let office = api.analysed(&pgm(OFFICE)).await;
    let path = format!("{hall}/compare/{}", office.trim_start_matches("/v1/maps/"));
    api.get(&path).await.problem(409, "not-same-site");
}

#[tokio::test]
async fn a_previous_map_that_does_not_exist_is_told() {
    let api = Api::new().await;
    for previous in ["hall", "00000000-0000-7000-8000-000000000000"] {
        let problem = api.send(upload_after(&pgm(HALL), previous)).await.problem(422, "invalid");
        assert_eq!(problem["errors"][0]["pointer"], "/previous");
    }
}

#[tokio::test]
async fn relabelling_takes_no_code_away() {
    let api = Api::new().await;
    let map = api.hall().await;
    let before = codes(&api, &map).await;
    let items = api.get(&format!("{map}/collections/locations/items?limit=1000")).await.json();
    let (code, face) = (&items["features"][0]["id"], &items["features"][0]["properties"]["face"]);
    let semantics = api.get(&format!("{map}/semantics")).await;
    let mut body = semantics.json();
    body["overrides"] = json!([{"face": face, "label": "un"}]);
    let put = async |body: &Value| {
        let tag = api.get(&format!("{map}/semantics")).await.header("etag").to_owned();
        api.send_json(Method::PUT, &format!("{map}/semantics"), &[("if-match", &tag)], body).await
    };
    assert_eq!(put(&body).await.status, 200);

    let changes = api.get(&format!("{map}/changes?since=0")).await.json();
    assert_eq!(changes["faces"], json!([{"face": face, "before": "pc", "now": "un"}]));
    assert_eq!(changes["locations"]["removed"][0]["code"], *code, "{changes}");
    let left = codes(&api, &map).await;
    assert_eq!(left, before[1..]);
    assert_eq!(entries(&api.get(&format!("{map}/registry")).await.json(), "lost"), [code.as_str().expect("a code")]);

    body["overrides"] = json!([]);
    assert_eq!(put(&body).await.status, 200);
    assert_eq!(codes(&api, &map).await, before);
    let changes = api.get(&format!("{map}/changes?since=1")).await.json();
    assert_eq!((&changes["version"], &changes["locations"]["added"][0]["code"]), (&json!(2), code));
    api.get(&format!("{map}/changes?since=9")).await.problem(404, "not-found");
}

#[tokio::test]
async fn codes_are_confirmed_and_unknown_ones_are_told() {
    let api = Api::new().await;
    let map = api.hall().await;
    let confirm = async |body: Value| api.send_json(Method::POST, &format!("{map}/registry/confirm"), &[], &body).await;
    let problem = confirm(json!({"codes": ["99-999"]})).await.problem(422, "invalid");
    assert_eq!(problem["errors"][0]["pointer"], "/codes/0");
    let registry = confirm(json!({})).await;
    assert_eq!((registry.status.as_u16(), &registry.json()["stale"]), (200, &json!(0)));
}

#[tokio::test]
async fn a_newer_scan_is_confirmed_not_an_older_one() {
    let api = Api::new().await;
    let first = api.analysed(&first_scan()).await;
    scanned_again(&api, &second_scan(), &first).await;
    let answer = api.send_json(Method::POST, &format!("{first}/registry/confirm"), &[], &json!({})).await;
    answer.problem(409, "conflict");
}
