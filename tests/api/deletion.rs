//! Maps are deleted, and restored for a while after that.

use std::time::Duration;

use axum::body::Body;
use axum::http::Method;
use serde_json::json;
use stillage::config::Config;

use crate::client::{Api, HALL, METADATA, pgm, request, upload};

#[tokio::test]
async fn a_deleted_map_is_gone() {
    let api = Api::new().await;
    let map = api.hall().await;
    assert_eq!(api.send(request(Method::DELETE, &map, &[], Body::empty())).await.status, 204);
    let hint = format!("POST {map}/restore brings it back until ");
    for path in ["", "/collections", "/semantics", "/image.png", "/analyses"] {
        let problem = api.get(&format!("{map}{path}")).await.problem(404, "not-found");
        assert!(problem["detail"].as_str().is_some_and(|detail| detail.contains(&hint)), "{problem}");
    }
    let again = api.send(request(Method::DELETE, &map, &[], Body::empty())).await.problem(404, "not-found");
    assert!(again["detail"].as_str().is_some_and(|detail| detail.contains(&hint)), "{again}");
    for list in ["/v1/maps", "/v1/jobs"] {
        let list = api.get(list).await.json();
        assert!([&list["maps"], &list["jobs"]].iter().any(|list| **list == json!([])), "{list}");
    }
}

#[tokio::test]
async fn a_map_that_changed_since_it_was_read_is_not_deleted() {
    let api = Api::new().await;
    let map = api.hall().await;
    let read = api.get(&map).await.header("etag").to_owned();
    api.send_json(Method::PATCH, &map, &[], &json!({"name": "Hall"})).await;
    let delete = async |tag: &str| api.send(request(Method::DELETE, &map, &[("if-match", tag)], Body::empty())).await;
    delete(&read).await.problem(412, "precondition-failed");
    let current = api.get(&map).await.header("etag").to_owned();
    assert_eq!(delete(&current).await.status, 204);
    api.get(&map).await.problem(404, "not-found");
}

#[tokio::test]
async fn a_deleted_map_can_be_restored() {
    let api = Api::new().await;
    let map = api.hall().await;
    let patch = json!({"overrides": {"3": "ju"}});
    api.send_json(Method::PATCH, &format!("{map}/semantics"), &[("if-match", "*")], &patch).await;
    let before = api.get(&format!("{map}/collections/faces/items")).await;
    let restore = async || api.send(request(Method::POST, &format!("{map}/restore"), &[], Body::empty())).await;
    for _ in 0..2 {
        assert_eq!(api.send(request(Method::DELETE, &map, &[], Body::empty())).await.status, 204);
        api.get(&format!("{map}/collections/faces/items")).await.problem(404, "not-found");
        let restored = restore().await;
        assert_eq!(restored.status, 200, "{}", restored.text());
        assert_eq!(
            (restored.json(), restored.header("etag")),
            (api.get(&map).await.json(), api.get(&map).await.header("etag"))
        );
        let after = api.get(&format!("{map}/collections/faces/items")).await;
        assert_eq!((after.header("etag"), after.body.len()), (before.header("etag"), before.body.len()));
    }
    assert_eq!(restore().await.status, 200, "it is there already");
    let nobody = "/v1/maps/00000000-0000-7000-8000-000000000000/restore";
    api.send(request(Method::POST, nobody, &[], Body::empty())).await.problem(404, "not-found");
}

#[tokio::test]
async fn deleted_maps_are_listed_until_they_are_restored() {
    let api = Api::new().await;
    let (first, second) = (api.hall().await, api.hall().await);
    let list = async |query: &str| api.get(&format!("/v1/deleted-maps{query}")).await.json();
    assert_eq!(list("").await["maps"], json!([]));
    for map in [&first, &second] {
        api.send(request(Method::DELETE, map, &[], Body::empty())).await;
    }
    let page = list("?limit=1").await;
    let id = |page: &serde_json::Value| format!("/v1/maps/{}", page["maps"][0]["id"].as_str().expect("an id"));
    assert_eq!((page["maps"].as_array().map(Vec::len), id(&page)), (Some(1), second.clone()));
    let until = page["maps"][0]["restorableUntil"].as_str().expect("a time");
    assert!(until > page["maps"][0]["deleted"].as_str().expect("a time"), "{page}");
    let next = page["links"][1]["href"].as_str().and_then(|href| href.split_once('?')).expect("a next page").1;
    assert_eq!(id(&list(&format!("?{next}")).await), first);
    let restore = page["maps"][0]["links"][0]["href"].as_str().expect("an address").replace("http://stillage.test", "");
    assert_eq!(api.send(request(Method::POST, &restore, &[], Body::empty())).await.status, 200);
    assert_eq!(list("").await["maps"].as_array().map(Vec::len), Some(1));
}

#[tokio::test]
async fn a_map_that_was_deleted_before_its_analysis_is_analysed_when_it_is_restored() {
    let api = Api::new().await;
    let job = api.send(upload(&pgm(HALL), METADATA)).await;
    let map = format!("/v1/maps/{}", job.json()["mapId"].as_str().expect("an id"));
    api.send(request(Method::DELETE, &map, &[], Body::empty())).await;
    api.get(job.header("location")).await.problem(404, "not-found");
    api.app.run_until_empty().await.expect("the queue can be worked on");
    api.send(request(Method::POST, &format!("{map}/restore"), &[], Body::empty())).await;
    assert_eq!(api.get(job.header("location")).await.json()["status"], "accepted");
    api.app.run_until_empty().await.expect("the queue can be worked on");
    assert_eq!(api.get(job.header("location")).await.json()["status"], "successful");
}

#[tokio::test]
async fn where_deleted_maps_are_not_kept_they_are_gone_at_once() {
    let disk_is_short = |config: &mut Config| config.min_free_bytes = u64::MAX;
    let api = Api::with(|config| config.keep_deleted = Duration::ZERO).await;
    let map = api.hall().await;
    api.send(request(Method::DELETE, &map, &[], Body::empty())).await;
    let problem = api.get(&map).await.problem(404, "not-found");
    assert!(!problem.to_string().contains("restore"), "{problem}");
    api.send(request(Method::POST, &format!("{map}/restore"), &[], Body::empty())).await.problem(404, "not-found");

    // On a disk that is short, deleting makes room.
    let folder = tempfile::tempdir().expect("a temporary folder");
    let in_folder = |config: &mut Config| {
        let Config { database, blobs, .. } = Config::new(folder.path());
        (config.database, config.blobs) = (database, blobs);
    };
    let roomy = Api::with(in_folder).await;
    let map = roomy.hall().await;
    roomy.app.shutdown().await;
    drop(roomy);
    let short = Api::with(|config| {
        in_folder(config);
        disk_is_short(config);
    })
    .await;
    assert_eq!(short.send(request(Method::DELETE, &map, &[], Body::empty())).await.status, 204);
    short.send(request(Method::POST, &format!("{map}/restore"), &[], Body::empty())).await.problem(404, "not-found");
}
