//! Keys from when they are made until they end, how often they may ask, and what they changed.

use std::time::Duration;

use axum::http::{Method, StatusCode};
use jiff::SignedDuration;
use serde_json::{Value, json};
use stillage::access::{ApiKey, Scope, Scopes};
use stillage::config::KeyRule;
use stillage::records::KeyRecord;
use stillage::store::{self, now};

use crate::client::{Api, HALL, METADATA, pgm, upload};
use crate::document::Sent;
use crate::key_client::{guarded, key, new_key, store_key, with_key};

#[tokio::test]
async fn a_key_opens_from_when_it_is_made_until_it_ends_or_is_revoked() {
    let api = guarded().await;
    let maps = Sent::new(Method::GET, "/v1/maps");
    let refusal = maps.to(&api).await;
    assert!(refusal.problem(401, "key-required")["detail"].as_str().expect("a text").contains("stillage key create"));
    assert_eq!(refusal.header("www-authenticate"), "Bearer realm=\"stillage\"");

    let (made, record) = new_key("ours", Scopes::all());
    store_key(&api, &made, &record).await;
    assert_eq!(with_key(&maps, &made.reveal()).to(&api).await.status, StatusCode::OK, "it is known at once");
    let basic = maps.clone().with("authorization", "Basic c3RpbGxhZ2U6").to(&api).await;
    assert!(basic.header("www-authenticate").contains("error=\"invalid_token\""));
    basic.problem(401, "invalid-key");
    let mut forged = made.reveal();
    forged.replace_range(forged.len() - 1.., if forged.ends_with('0') { "1" } else { "0" });
    for wrong in [forged.as_str(), "stillage_", "x"] {
        with_key(&maps, wrong).to(&api).await.problem(401, "invalid-key");
    }

    let keys = store::open_keys(&api.app.config().database).await.expect("beside the service");
    keys.revoke_key(made.id(), now()).await.expect("it answers").expect("it is there");
    tokio::time::sleep(Duration::from_millis(1_100)).await;
    let revoked = with_key(&maps, &made.reveal()).to(&api).await.problem(401, "invalid-key");
    assert_eq!(revoked["detail"], format!("key {} was revoked", made.id()));

    let (old, record) = new_key("ours", Scopes::all());
    store_key(&api, &old, &KeyRecord { expires: Some(now()), ..record }).await;
    let ended = with_key(&maps, &old.reveal()).to(&api).await.problem(401, "invalid-key");
    assert!(ended["detail"].as_str().expect("a text").contains("ended at"), "{ended}");
}

#[tokio::test]
async fn a_key_that_asks_too_often_is_told_when_to_ask_again() {
    let api = Api::with(|config| (config.keys, config.requests_per_minute) = (KeyRule::Required, 2)).await;
    let (busy, other) = (key(&api, "ours", Scope::ALL).await, key(&api, "ours", Scope::ALL).await);
    let maps = Sent::new(Method::GET, "/v1/maps");
    let first = with_key(&maps, &busy).to(&api).await;
    assert_eq!(first.status, StatusCode::OK);
    assert_eq!(first.header("ratelimit-policy"), "\"key\";q=2;w=60");
    assert_eq!(first.header("ratelimit"), "\"key\";r=1;t=30");
    assert_eq!(with_key(&maps, &busy).to(&api).await.status, StatusCode::OK);
    let refused = with_key(&maps, &busy).to(&api).await;
    refused.problem(429, "too-many-requests");
    assert!((1..=30).contains(&refused.header("retry-after").parse::<u32>().expect("seconds")));
    assert_eq!(with_key(&maps, &other).to(&api).await.status, StatusCode::OK, "another key has its own");
    let health = Sent::new(Method::GET, "/health/live");
    assert_eq!(with_key(&health, &busy).to(&api).await.status, StatusCode::OK, "health is always answered");
}

#[tokio::test]
async fn a_stream_of_events_ends_with_the_right_to_see_it() {
    let mut api = guarded().await;
    let good = key(&api, "ours", [Scope::Read, Scope::Write]).await;
    api.key = Some(good.clone());
    let job = api.send(upload(&pgm(HALL), METADATA)).await.header("location").to_owned();
    let events = Sent::new(Method::GET, format!("{job}/events"));
    let revoked = key(&api, "ours", [Scope::Read]).await;
    let (ending, record) = new_key("ours", [Scope::Read].into_iter().collect());
    store_key(&api, &ending, &KeyRecord { expires: Some(now() + SignedDuration::from_secs(2)), ..record }).await;
    // Nothing happens to the job, which waits, so that nothing else ends a stream.
    let patience = Duration::from_secs(20);
    let stream = async |key: &str| tokio::time::timeout(patience, with_key(&events, key).to(&api)).await.ok();
    let revocation = async {
        let keys = store::open_keys(&api.app.config().database).await.expect("beside the service");
        let id = ApiKey::read(&revoked).expect("a key").id().to_owned();
        keys.revoke_key(&id, now()).await.expect("it answers").expect("it is there");
    };
    let ending = ending.reveal();
    let (of_revoked, of_ending, of_good, ()) =
        tokio::join!(stream(&revoked), stream(&ending), stream(&good), revocation);
    for ended in [of_revoked, of_ending] {
        let ended = ended.expect("it ends by itself");
        assert!(ended.text().contains("\"accepted\""), "it was seen: {}", ended.text());
    }
    assert!(of_good.is_none(), "the stream of a key that counts goes on");
}

#[tokio::test]
async fn many_wrong_keys_from_one_address_are_told_to_wait_and_right_ones_are_not() {
    let api = guarded().await;
    let good = key(&api, "ours", [Scope::Read]).await;
    let maps = Sent::new(Method::GET, "/v1/maps");
    let wrong = async || with_key(&maps, "stillage_of_another_service").to(&api).await;
    for _ in 0..30 {
        wrong().await.problem(401, "invalid-key");
    }
    let refused = wrong().await;
    refused.problem(429, "too-many-requests");
    assert!((1..=2).contains(&refused.header("retry-after").parse::<u32>().expect("seconds")));
    assert_eq!(with_key(&maps, &good).to(&api).await.status, StatusCode::OK);
    maps.to(&api).await.problem(401, "key-required");
    let ended = maps.clone().with("cookie", "stillage_session=1.2.3").to(&api).await;
    ended.problem(401, "invalid-key");
}

#[tokio::test]
async fn who_changed_what_is_told_to_the_admin_of_the_tenant() {
    let mut api = guarded().await;
    let (admin, theirs) = (key(&api, "ours", [Scope::Admin]).await, key(&api, "theirs", Scope::ALL).await);
    let writer = key(&api, "ours", [Scope::Read, Scope::Write]).await;
    api.key = Some(writer.clone());
    let map = api.hall().await;
    let rename = Sent::new(Method::PATCH, &map).json(&json!({"name": "Hall"})).with("x-request-id", "robot-7.42");
    assert_eq!(rename.to(&api).await.status, StatusCode::OK);
    with_key(&rename, &admin).to(&api).await.problem(403, "missing-scope");
    let log = Sent::new(Method::GET, "/v1/audit-log");
    log.to(&api).await.problem(403, "missing-scope");
    let entries = with_key(&log, &admin).to(&api).await.json()["entries"].clone();
    let entries = entries.as_array().expect("a list");
    let id = |key: &str| ApiKey::read(key).expect("a key").id().to_owned();
    let told: Vec<Value> =
        entries[..3].iter().map(|entry| json!([entry["operation"], entry["caller"], entry["status"]])).collect();
    let expected = [
        json!(["updateMap", id(&admin), 403]),
        json!(["updateMap", id(&writer), 200]),
        json!(["createMap", id(&writer), 202]),
    ];
    assert_eq!(told, expected);
    assert_eq!((&entries[1]["resource"], &entries[1]["request"]), (&json!(map), &json!("robot-7.42")));
    assert!(entries[2]["resource"].as_str().expect("a path").starts_with("/v1/jobs/"), "what was made");
    assert!(entries[3..].iter().all(|entry| entry["operation"] == "createKey"), "{entries:?}");
    let foreign = with_key(&log, &theirs).to(&api).await.json();
    assert_eq!(foreign["entries"].as_array().expect("a list").len(), 1, "the making of their own key");
    let page = with_key(&log.at("/v1/audit-log?limit=2"), &admin).to(&api).await;
    assert!(page.header("link").contains("after="), "{}", page.text());
}

#[tokio::test]
async fn a_service_without_keys_asks_for_none_and_minds_none() {
    let api = Api::new().await;
    let maps = Sent::new(Method::GET, "/v1/maps");
    assert_eq!(maps.to(&api).await.status, StatusCode::OK);
    assert_eq!(with_key(&maps, "of another service").to(&api).await.status, StatusCode::OK);
}
