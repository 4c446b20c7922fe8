//! Who may ask what: every operation of the document under every kind of key, and nothing of another tenant.
//!
//! The requests are those of [`crate::document::valid`], so that an operation that is new fails until it has one.

use axum::http::{Method, StatusCode};
use serde_json::{Value, json};
use stillage::access::Scope;
use stillage::config::KeyRule;
use stillage::store::Quotas;

use crate::client::{self, Answer, Api};
use crate::document::{Sent, Site, operations, valid};
use crate::key_client::{guarded, key, with_key};

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
