//! Two services on one database, and a deployment that moves to another one.

use axum::http::{Method, StatusCode};
use serde_json::json;
use stillage::access::{KeySecret, Scope};
use stillage::app::App;
use stillage::config::{BlobAddress, Config, DatabaseAddress, KeyRule, Role};
use stillage::store;

use crate::client::Api;
use crate::key_client;
use crate::postgres;

const FACES: &str = "collections/faces/items?crs=EPSG:3857";

/// A service that has its rows and blobs there.
async fn service_on(database: &DatabaseAddress, blobs: &BlobAddress) -> Api {
    Api::with(|config| (config.database, config.blobs) = (database.clone(), blobs.clone())).await
}

#[tokio::test]
async fn what_one_service_changes_the_other_answers_at_once_under_equal_tags() {
    let Some(address) = postgres::new_database() else { return };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let (database, blobs) = (DatabaseAddress::Postgres(address), BlobAddress::Folder(folder.path().join("blobs")));
    let (first, second) = (service_on(&database, &blobs).await, service_on(&database, &blobs).await);
    let map = first.hall().await;
    let faces = format!("{map}/{FACES}");

    let (here, there) = (first.get(&faces).await, second.get(&faces).await);
    assert_eq!((here.status, here.header("etag"), &here.body), (StatusCode::OK, there.header("etag"), &there.body));
    let known = [("if-none-match", here.header("etag"))];
    assert_eq!(second.get_with(&faces, &known).await.status, StatusCode::NOT_MODIFIED);

    let tag = second.get(&format!("{map}/semantics")).await.header("etag").to_owned();
    let decided = json!({"assignment": second.all_labelled(&map, "co").await});
    let path = format!("{map}/semantics");
    let answer = second.send_json(Method::PUT, &path, &[("if-match", &tag)], &decided).await;
    assert_eq!(answer.status, StatusCode::OK, "{}", answer.text());
    let after = first.get_with(&faces, &known).await;
    assert_eq!(after.status, StatusCode::OK, "the other one's tag is old");
    let there = second.get(&faces).await;
    assert_eq!((after.header("etag"), &after.body), (there.header("etag"), &there.body));
    let refused = first.send_json(Method::PUT, &path, &[("if-match", &tag)], &decided).await;
    refused.problem(412, "precondition-failed");

    assert_eq!(second.send_json(Method::DELETE, &map, &[], &json!(null)).await.status, StatusCode::NO_CONTENT);
    first.get(&faces).await.problem(404, "not-found");
}

#[tokio::test]
async fn a_worker_takes_the_jobs_of_the_others_and_answers_for_its_health_alone() {
    let Some(address) = postgres::new_database() else { return };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let (database, blobs) = (DatabaseAddress::Postgres(address), BlobAddress::Folder(folder.path().join("blobs")));
    let asked = service_on(&database, &blobs).await;
    let worker = Api::with(|config| {
        (config.database, config.blobs) = (database.clone(), blobs.clone());
        (config.role, config.job_slots) = (Role::Worker, 1);
    })
    .await;
    assert_eq!(worker.get("/v1/maps").await.status, StatusCode::NOT_FOUND);
    assert_eq!(worker.get("/health/ready").await.status, StatusCode::OK);
    assert_eq!(worker.get("/metrics").await.status, StatusCode::OK);

    let answer =
        asked.send(crate::client::upload(&crate::client::pgm(crate::client::HALL), crate::client::METADATA)).await;
    let job = answer.header("location").to_owned();
    let mut changes = asked.app.job_changes();
    let done = async {
        while asked.get(&job).await.json()["status"] != "successful" {
            changes.changed().await.expect("the service lives");
        }
    };
    tokio::time::timeout(std::time::Duration::from_mins(1), done).await.expect("it is done, and that is told");
}

#[tokio::test]
async fn a_deployment_moves_to_another_database_and_back_and_answers_the_same() {
    let Some(address) = postgres::new_database() else { return };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let embedded = |name: &str| Config { min_free_bytes: 0, ..Config::new(folder.path().join(name)) };
    let blobs = BlobAddress::Folder(folder.path().join("shared"));
    let shared = Config { database: DatabaseAddress::Postgres(address), blobs, ..embedded("none") };
    let (before, after) = (embedded("before"), embedded("after"));

    let api = service_on(&before.database, &before.blobs).await;
    let map = api.hall().await;
    let rules = json!({"id": "clinic", "labels": [{"id": "un", "name": "unidentified", "color": "#999999"}]});
    let made = api.send_json(Method::POST, "/v1/rule-sets", &[], &rules).await;
    assert_eq!(made.status, StatusCode::CREATED, "{}", made.text());
    let questions =
        [format!("{map}/{FACES}"), format!("{map}/registry"), map.clone(), "/v1/rule-sets/clinic".to_owned()];
    let answers = async |api: &Api| {
        let mut answers = Vec::new();
        for question in &questions {
            let answer = api.get(question).await;
            assert_eq!(answer.status, StatusCode::OK, "{question}: {}", answer.text());
            answers.push((answer.header("etag").to_owned(), answer.text()));
        }
        answers
    };
    let told = answers(&api).await;
    api.app.shutdown().await;
    drop(api);

    let moved = store::move_all(&before, &shared, |_| ()).await.expect("it moves");
    assert_eq!((moved.maps, moved.maps_there, moved.blobs), (1, 0, 2));
    assert!(moved.rows.values().all(|(before, after)| before == after), "{:?}", moved.rows);
    let again = store::move_all(&before, &shared, |_| ()).await.expect("it goes on");
    assert_eq!((again.maps, again.maps_there), (0, 1));
    let api = service_on(&shared.database, &shared.blobs).await;
    assert_eq!(answers(&api).await, told);
    api.app.shutdown().await;
    drop(api);

    let back = store::move_all(&shared, &after, |_| ()).await.expect("it moves back");
    assert_eq!(back.maps, 1);
    assert_eq!(answers(&service_on(&after.database, &after.blobs).await).await, told);
}

#[tokio::test]
async fn a_key_opens_every_service_of_a_deployment_and_its_secret_must_be_named() {
    let Some(address) = postgres::new_database() else { return };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let (database, blobs) = (DatabaseAddress::Postgres(address), BlobAddress::Folder(folder.path().join("blobs")));
    let file = folder.path().join("key-secret");
    let config = Config { database, blobs, keys: KeyRule::Required, job_slots: 0, ..Config::new(folder.path()) };
    let refusal = App::open(config.clone()).await.expect_err("nobody said where the secret is");
    assert!(format!("{refusal:?}").contains("NotNamed"), "{refusal:?}");

    KeySecret::read_or_make(&file).expect("it is made");
    let guarded = async || {
        Api::with(|service| {
            *service = Config { key_secret_file: Some(file.clone()), min_free_bytes: 0, ..config.clone() }
        })
        .await
    };
    let (first, second) = (guarded().await, guarded().await);
    let key = key_client::key(&first, "north", Scope::ALL).await;
    for api in [&first, &second] {
        let headers = [("host", "localhost"), ("authorization", &format!("Bearer {key}"))];
        assert_eq!(api.get_with("/v1/maps", &headers).await.status, StatusCode::OK);
        assert_eq!(api.get_with("/v1/maps", &headers[..1]).await.status, StatusCode::UNAUTHORIZED);
    }
}
