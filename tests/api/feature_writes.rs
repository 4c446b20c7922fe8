//! Features that people write from a script or from a GIS: OGC API Features part 4.

use axum::body::Body;
use axum::http::Method;
use serde_json::{Value, json};

use crate::client::{Answer, Api, request};

async fn write(api: &Api, method: Method, path: &str, headers: &[(&str, &str)], body: &Value) -> Answer {
    api.send_json(method, path, headers, body).await
}

async fn semantics(api: &Api, map: &str) -> Value {
    api.get(&format!("{map}/semantics")).await.json()
}

#[tokio::test]
async fn the_label_of_a_face_is_an_override() {
    let api = Api::new().await;
    let map = api.hall().await;
    let path = format!("{map}/collections/faces/items/1");
    let read = api.get(&path).await;
    let suggested = read.json()["properties"]["label"].clone();
    let other = if suggested == "un" { "ju" } else { "un" };
    let patch = async |headers: &[(&str, &str)], body: Value| write(&api, Method::PATCH, &path, headers, &body).await;
    patch(&[], json!({"label": other})).await.problem(428, "precondition-required");

    let tag = read.header("etag").to_owned();
    let labelled = patch(&[("if-match", &tag)], json!({"label": other})).await;
    assert_eq!((labelled.status.as_u16(), &labelled.json()["properties"]["label"]), (200, &json!(other)));
    assert_eq!(api.get(&path).await.header("etag"), labelled.header("etag"));
    let now = semantics(&api, &map).await;
    assert_eq!((&now["version"], &now["overrides"]), (&json!(1), &json!([{"face": 1, "label": other}])));
    patch(&[("if-match", &tag)], json!({"label": "co"})).await.problem(412, "precondition-failed");

    let tag = labelled.header("etag").to_owned();
    let same = patch(&[("if-match", &tag)], json!({})).await;
    assert_eq!((same.status.as_u16(), same.header("etag")), (200, tag.as_str()), "nothing was written");
    let bare = patch(&[("if-match", &tag)], json!({"label": null})).await;
    assert_eq!((bare.status.as_u16(), &bare.json()["properties"]["label"]), (200, &suggested));
    let now = semantics(&api, &map).await;
    assert_eq!((&now["version"], &now["overrides"]), (&json!(2), &json!([])));
    assert_eq!(api.get("/v1/jobs").await.json()["jobs"].as_array().map(Vec::len), Some(1), "no job was needed");
}

#[tokio::test]
async fn what_cannot_be_written_of_a_face_is_refused() {
    let api = Api::new().await;
    let map = api.hall().await;
    let path = format!("{map}/collections/faces/items/1");
    let cases = [
        (json!({"label": "xx"}), "/label", "has no label \"xx\": it has co, ju, pc, ro, un"),
        (json!({"name": "Face"}), "/name", "of faces, label may be written"),
        (json!({"properties": {"label": "xx"}}), "/properties/label", "it has co"),
        (json!({"properties": {"areaM2": 1}}), "/properties/areaM2", "label may be written"),
        (json!({"geometry": {"type": "Point", "coordinates": [0, 0]}}), "/geometry", "follows from the analysis"),
    ];
    for (body, pointer, hint) in cases {
        let answer = write(&api, Method::PATCH, &path, &[("if-match", "*")], &body).await;
        let problem = answer.problem(422, "invalid");
        assert_eq!(problem["errors"][0]["pointer"], pointer, "{problem}");
        assert!(problem["errors"][0]["detail"].as_str().is_some_and(|detail| detail.contains(hint)), "{problem}");
    }
    let members = write(&api, Method::PUT, &path, &[], &json!({"label": "co"})).await;
    members.problem(422, "invalid");
    let absent = format!("{map}/collections/faces/items/99999");
    write(&api, Method::PATCH, &absent, &[("if-match", "*")], &json!({"label": "co"})).await.problem(404, "not-found");
    assert_eq!(semantics(&api, &map).await["version"], 0, "nothing was changed");
}

/// QGIS asks with `OPTIONS` of the items whether it may edit at all (`POST`), and of one whether it may change attributes
/// (`PUT`) and send single ones (`PATCH`), then sends those in `properties`, without `If-Match` (`qgsoapifprovider.cpp` and `qgsoapifpatchfeaturerequest.cpp` of QGIS).
#[tokio::test]
async fn an_attribute_is_edited_as_qgis_does() {
    let api = Api::new().await;
    let map = api.hall().await;
    let items = format!("{map}/collections/faces/items");
    let allowed = api.send(request(Method::OPTIONS, &items, &[], Body::empty())).await;
    assert_eq!((allowed.status.as_u16(), allowed.header("allow")), (204, "GET,HEAD,POST"));
    api.send(request(Method::POST, &items, &[], Body::empty())).await.problem(403, "read-only");
    let others = format!("{map}/collections/edges/items");
    let allowed = api.send(request(Method::OPTIONS, &others, &[], Body::empty())).await;
    assert_eq!((allowed.status.as_u16(), allowed.header("allow")), (204, "GET,HEAD"));
    let path = format!("{items}/1");
    let allowed = api.send(request(Method::OPTIONS, &path, &[], Body::empty())).await;
    assert_eq!((allowed.status.as_u16(), allowed.header("allow")), (204, "GET,HEAD,PUT,PATCH"));
    let headers = [("content-type", "application/merge-patch+json")];
    let edit = json!({"properties": {"label": "ju"}});
    let edited = write(&api, Method::PATCH, &path, &headers, &edit).await;
    assert_eq!((edited.status.as_u16(), &edited.json()["properties"]["label"]), (200, &json!("ju")));
    let place = format!("{map}/collections/places/items/0");
    let named = write(&api, Method::PATCH, &place, &headers, &json!({"properties": {"name": "Hall"}})).await;
    assert_eq!((named.status.as_u16(), &named.json()["properties"]["name"]), (200, &json!("Hall")));
}

#[tokio::test]
async fn a_feature_as_it_was_read_is_sent_back_with_a_change() {
    let api = Api::new().await;
    let map = api.hall().await;
    let headers = [("content-type", "application/geo+json")];
    for system in ["", "?crs=EPSG:3857"] {
        let path = format!("{map}/collections/faces/items/1{system}");
        let before = semantics(&api, &map).await["version"].clone();
        let mut feature = api.get(&path).await.json();
        let same = write(&api, Method::PUT, &path, &headers, &feature).await;
        assert_eq!((same.status.as_u16(), &semantics(&api, &map).await["version"]), (200, &before));
        feature["properties"]["label"] = if feature["properties"]["label"] == "ju" { "un" } else { "ju" }.into();
        let changed = write(&api, Method::PUT, &path, &headers, &feature).await;
        assert_eq!(changed.status, 200, "{}", changed.text());
        assert_eq!(changed.json()["properties"]["label"], feature["properties"]["label"]);
        assert_eq!(changed.json()["geometry"], feature["geometry"]);
    }
}
