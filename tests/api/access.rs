//! Who may ask what: every operation of the document under every kind of key.
//!
//! The requests are those of [`crate::document::valid`], so that an operation that is new fails until it has one.

use axum::http::{Method, StatusCode};
use serde_json::{Value, json};
use stillage::access::{ApiKey, KeySecret, Scope, Scopes};
use stillage::config::KeyRule;
use stillage::records::{KeyRecord, Tenant};
use stillage::store::{self, Quotas, now};

use crate::client::{self, Answer, Api};
use crate::document::{Sent, Site, operations, valid};

/// A service that needs keys.
async fn guarded() -> Api {
    Api::with(|config| config.keys = KeyRule::Required).await
}

/// Makes a key as `stillage key create` does, while the service runs.
async fn key(api: &Api, tenant: &str, scopes: impl IntoIterator<Item = Scope>) -> String {
    let (key, record) = new_key(tenant, scopes.into_iter().collect());
    store_key(api, &key, &record).await;
    key.reveal()
}

fn new_key(tenant: &str, scopes: Scopes) -> (ApiKey, KeyRecord) {
    let key = ApiKey::generate().expect("there are random bytes");
    let (id, tenant) = (key.id().to_owned(), Tenant::new(tenant));
    (key, KeyRecord { id, tenant, name: String::new(), scopes, created: now(), expires: None, revoked: None })
}

async fn store_key(api: &Api, key: &ApiKey, record: &KeyRecord) {
    let config = api.app.config();
    let secret = KeySecret::read_or_make(&config.key_secret_path().expect("it is known")).expect("it can be read");
    let keys = store::open_keys(&config.database).await.expect("beside the service");
    keys.create_key(record, &key.hash(&secret)).await.expect("it is stored");
}

fn with_key(sent: &Sent, key: &str) -> Sent {
    sent.clone().with("authorization", format!("Bearer {key}"))
}

/// The scope that the document asks for; `None` where everybody may ask.
fn scope(operation: &Value) -> Option<Scope> {
    let requirements = operation["security"].as_array().expect("every operation says who may ask");
    let scopes = requirements.iter().find_map(|requirement| requirement.get("key"))?;
    Some(scopes[0].as_str().expect("a scope").parse().expect("a scope"))
}

/// Whether a request names something by its id, in the address or in the body.
fn names_something(sent: &Sent, site: &Site) -> bool {
    let is_id = |part: &str| part.len() == site.over.len() && part.bytes().filter(|byte| *byte == b'-').count() == 4;
    let body = String::from_utf8_lossy(&sent.body);
    sent.path.split(['/', '?']).any(is_id) || body.contains(site.map.trim_start_matches("/v1/maps/"))
}

/// What was asked for is not there: in the address (404), or where the body names it (422).
#[track_caller]
fn is_absent(answer: &Answer) {
    if answer.status == StatusCode::UNPROCESSABLE_ENTITY {
        let problem = answer.problem(422, "invalid");
        assert!(problem["detail"].as_str().is_some_and(|detail| detail.starts_with("there is no ")), "{problem}");
    } else {
        answer.problem(404, "not-found");
    }
}

#[tokio::test]
async fn every_operation_asks_for_its_scope_and_shows_nothing_of_another_tenant() {
    let mut api = guarded().await;
    let document = api.get("/openapi.json").await.json();
    let ours = key(&api, "ours", Scope::ALL).await;
    let theirs = key(&api, "theirs", Scope::ALL).await;
    let mut single = Vec::new();
    for scope in Scope::ALL {
        single.push((scope, key(&api, "ours", [scope]).await));
    }
    api.key = Some(ours);
    let mut site = Site::on(api).await;
    for (id, operation) in operations(&document) {
        let (mut good, statuses) = valid(&site, &id).await;
        if matches!(id.as_str(), "getRuleSet" | "getCogencyMatrix") {
            // Those that are built in are everybody's.
            let (own, _) = site.rule_set(&format!("own-{}", id.to_lowercase())).await;
            good.path = good.path.replace("/v1/rule-sets/office", &own);
        }
        let anonymous = good.clone().with("authorization", "").to(&site.api).await;
        let Some(needed) = scope(&operation) else {
            assert_eq!(anonymous.status, statuses[0], "{id} is open: {}", anonymous.text());
            continue;
        };
        anonymous.problem(401, "invalid-key");
        for (scope, key) in &single {
            if *scope != needed {
                let answer = with_key(&good, key).to(&site.api).await;
                answer.problem(403, "missing-scope");
                let challenge = answer.header("www-authenticate").to_owned();
                assert!(challenge.contains(&format!("scope=\"{}\"", needed.name())), "{id}: {challenge}");
            }
        }
        // A read is answered to us first, so that it would be found among the answers that are given again.
        if good.method == Method::GET {
            assert_eq!(good.to(&site.api).await.status, statuses[0], "{id}");
        }
        let foreign = with_key(&good, &theirs).to(&site.api).await;
        if names_something(&good, &site) || good.path.contains("/rule-sets/") {
            is_absent(&foreign);
        } else {
            assert_eq!(foreign.status, statuses[0], "{id}: {}", foreign.text());
            for id_of_ours in [site.map.trim_start_matches("/v1/maps/"), &site.over] {
                assert!(!foreign.text().contains(id_of_ours), "{id} tells of another tenant: {}", foreign.text());
            }
        }
        let right = &single.iter().find(|(scope, _)| *scope == needed).expect("every scope has a key").1;
        for &status in statuses {
            let answer = with_key(&good, right).to(&site.api).await;
            assert_eq!(answer.status, status, "{id}: {}", answer.text());
            if status == 202 {
                site.work().await;
            }
        }
    }
}

#[tokio::test]
async fn what_is_named_beside_the_address_is_not_there_for_another_tenant() {
    let mut api = guarded().await;
    let (ours, theirs) = (key(&api, "ours", Scope::ALL).await, key(&api, "theirs", Scope::ALL).await);
    api.key = Some(theirs.clone());
    let of_theirs = api.hall().await;
    api.key = Some(ours);
    let of_ours = api.hall().await;
    let id = of_ours.trim_start_matches("/v1/maps/");
    let compare = Sent::new(Method::GET, format!("{of_theirs}/compare/{id}"));
    with_key(&compare, &theirs).to(&api).await.problem(404, "not-found");
    let execute = Sent::new(Method::POST, "/v1/processes/semantic-map/execution");
    let execute = execute.json(&json!({"inputs": {"mapId": id}}));
    is_absent(&with_key(&execute, &theirs).to(&api).await);
    let message = json!({"info": {"resolution": 0.05, "width": 2, "height": 1, "origin": {
        "position": {"x": 0, "y": 0, "z": 0}, "orientation": {"x": 0, "y": 0, "z": 0, "w": 1}}}, "data": [0, 100]});
    let upload = Sent::new(Method::POST, format!("/v1/maps?previous={id}")).json(&message);
    is_absent(&with_key(&upload, &theirs).to(&api).await);

    // What was deleted belongs to nobody, and tells nobody else that it was there.
    assert_eq!(Sent::new(Method::DELETE, &of_ours).to(&api).await.status, StatusCode::NO_CONTENT);
    let deleted = Sent::new(Method::GET, of_ours);
    let told = with_key(&deleted, &theirs).to(&api).await.problem(404, "not-found");
    assert!(!told["detail"].as_str().expect("a text").contains("restore"), "{told}");
    assert!(deleted.to(&api).await.problem(404, "not-found")["detail"].as_str().expect("a text").contains("restore"));
}

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
    tokio::time::sleep(std::time::Duration::from_millis(1_100)).await;
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
async fn a_tenant_at_its_quota_is_told_so_and_another_is_not() {
    let quotas = Quotas { maps: 1, queued_jobs: 1, ..Quotas::UNLIMITED };
    let mut api = Api::with(|config| (config.keys, config.quotas) = (KeyRule::Required, quotas)).await;
    let theirs = key(&api, "theirs", Scope::ALL).await;
    api.key = Some(key(&api, "ours", Scope::ALL).await);
    let upload = || client::upload(&client::pgm(client::HALL), client::METADATA);
    let accepted = api.send(upload()).await;
    assert_eq!(accepted.status, StatusCode::ACCEPTED);
    let waiting = api.send(upload()).await;
    assert!(!waiting.header("retry-after").is_empty());
    waiting.problem(429, "too-many-jobs");
    api.app.run_until_empty().await.expect("the queue can be worked on");
    let refused = api.send(upload()).await.problem(403, "over-quota");
    assert_eq!(refused["detail"], "a tenant may have 1 maps: delete some");
    api.key = Some(theirs);
    assert_eq!(api.send(upload()).await.status, StatusCode::ACCEPTED);
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
async fn a_browser_signs_in_with_a_key_and_then_has_a_cookie() {
    let api = guarded().await;
    let key = key(&api, "ours", [Scope::Read]).await;
    let session = Sent::new(Method::POST, "/v1/session");
    session.to(&api).await.problem(401, "key-required");
    let answer = with_key(&session, &key).to(&api).await;
    let cookie = answer.header("set-cookie").to_owned();
    assert!(cookie.ends_with("; Path=/; HttpOnly; SameSite=Strict") && !cookie.contains(&key), "{cookie}");
    let pair = cookie.split(';').next().expect("name and value").to_owned();
    let maps = Sent::new(Method::GET, "/v1/maps").with("cookie", format!("theme=dark; {pair}"));
    assert_eq!(maps.to(&api).await.status, StatusCode::OK);
    let upload = Sent::new(Method::POST, "/v1/maps").with("cookie", &pair);
    upload.to(&api).await.problem(403, "missing-scope");
    let forged = maps.clone().with("cookie", format!("{pair}0"));
    forged.to(&api).await.problem(401, "invalid-key");

    let keys = store::open_keys(&api.app.config().database).await.expect("beside the service");
    keys.revoke_key(ApiKey::read(&key).expect("a key").id(), now()).await.expect("it answers").expect("it is there");
    tokio::time::sleep(std::time::Duration::from_millis(1_100)).await;
    maps.to(&api).await.problem(401, "invalid-key");
    let out = Sent::new(Method::DELETE, "/v1/session").to(&api).await;
    assert!(
        out.header("set-cookie").starts_with("stillage_session=; ") && out.header("set-cookie").ends_with("Max-Age=0")
    );
}

#[tokio::test]
async fn a_service_without_keys_asks_for_none_and_minds_none() {
    let api = Api::new().await;
    let maps = Sent::new(Method::GET, "/v1/maps");
    assert_eq!(maps.to(&api).await.status, StatusCode::OK);
    assert_eq!(with_key(&maps, "of another service").to(&api).await.status, StatusCode::OK);
}
