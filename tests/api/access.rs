//! Who may ask what: every operation of the document under every kind of key.
//!
//! The requests are those of [`crate::document::valid`], so that an operation that is new fails until it has one.

use axum::http::{Method, StatusCode};
use serde_json::{Value, json};
use stillage::access::{ApiKey, KeySecret, Scope, Scopes};
use stillage::config::KeyRule;
use stillage::records::{KeyRecord, Tenant};
use stillage::store::{self, now};

use crate::client::Api;
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
            foreign.problem(404, "not-found");
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
    with_key(&execute, &theirs).to(&api).await.problem(404, "not-found");
    let message = json!({"info": {"resolution": 0.05, "width": 2, "height": 1, "origin": {
        "position": {"x": 0, "y": 0, "z": 0}, "orientation": {"x": 0, "y": 0, "z": 0, "w": 1}}}, "data": [0, 100]});
    let upload = Sent::new(Method::POST, format!("/v1/maps?previous={id}")).json(&message);
    with_key(&upload, &theirs).to(&api).await.problem(404, "not-found");

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
async fn a_service_without_keys_asks_for_none_and_minds_none() {
    let api = Api::new().await;
    let maps = Sent::new(Method::GET, "/v1/maps");
    assert_eq!(maps.to(&api).await.status, StatusCode::OK);
    assert_eq!(with_key(&maps, "of another service").to(&api).await.status, StatusCode::OK);
}
