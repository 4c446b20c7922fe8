//! What stands for a key: sessions of browsers, tokens of an identity provider.

use std::time::Duration;

use axum::http::{Method, StatusCode};
use base64::Engine as _;
use base64::prelude::BASE64_URL_SAFE_NO_PAD;
use ring::rand::SystemRandom;
use ring::signature::{Ed25519KeyPair, KeyPair as _};
use serde_json::{Value, json};
use stillage::access::{ApiKey, Scope, TokenRules};
use stillage::config::{KeyRule, TokenConfig};
use stillage::store::{self, now};

use crate::client::Api;
use crate::document::Sent;
use crate::key_client::{guarded, key, with_key};

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
    let listed = maps.to(&api).await;
    assert_eq!((listed.status, listed.header("cache-control")), (StatusCode::OK, "private, no-cache"));
    let upload = Sent::new(Method::POST, "/v1/maps").with("cookie", &pair);
    upload.to(&api).await.problem(403, "missing-scope");
    let forged = maps.clone().with("cookie", format!("{pair}0"));
    forged.to(&api).await.problem(401, "invalid-key");

    let keys = store::open_keys(&api.app.config().database).await.expect("beside the service");
    keys.revoke_key(ApiKey::read(&key).expect("a key").id(), now()).await.expect("it answers").expect("it is there");
    tokio::time::sleep(Duration::from_millis(1_100)).await;
    maps.to(&api).await.problem(401, "invalid-key");
    let out = Sent::new(Method::DELETE, "/v1/session").to(&api).await;
    assert!(
        out.header("set-cookie").starts_with("stillage_session=; ") && out.header("set-cookie").ends_with("Max-Age=0")
    );
}

/// A token with these claims, signed with an Ed25519 key under a header that may lie.
fn token(key: &Ed25519KeyPair, header: &Value, claims: &Value) -> String {
    let part = |value: &Value| BASE64_URL_SAFE_NO_PAD.encode(value.to_string());
    let signed = format!("{}.{}", part(header), part(claims));
    let signature = BASE64_URL_SAFE_NO_PAD.encode(key.sign(signed.as_bytes()));
    format!("{signed}.{signature}")
}

#[tokio::test]
async fn tokens_of_the_identity_provider_are_taken_and_no_others() {
    let pair = || {
        let document = Ed25519KeyPair::generate_pkcs8(&SystemRandom::new()).expect("a key");
        Ed25519KeyPair::from_pkcs8(document.as_ref()).expect("a key")
    };
    let (provider, stranger) = (pair(), pair());
    let public = BASE64_URL_SAFE_NO_PAD.encode(provider.public_key());
    let folder = tempfile::tempdir().expect("a folder");
    let keys = folder.path().join("jwks.json");
    let set = json!({"keys": [{"kty": "OKP", "crv": "Ed25519", "kid": "1", "x": public}]});
    std::fs::write(&keys, set.to_string()).expect("it can be written");
    let rules = TokenRules {
        issuer: "https://login.example".into(),
        audience: "stillage".into(),
        tenant_claim: "tenant".into(),
    };
    let api = Api::with(|config| {
        config.keys = KeyRule::Required;
        config.tokens = Some(TokenConfig { keys: keys.display().to_string(), rules });
    })
    .await;
    let header = json!({"alg": "EdDSA", "kid": "1"});
    let claims = json!({"iss": "https://login.example", "aud": "stillage", "exp": now().as_second() + 300,
        "sub": "anna", "tenant": "north", "scope": "read admin"});
    let with = |name: &str, value: Value| {
        let mut claims = claims.clone();
        claims[name] = value;
        claims
    };
    let maps = Sent::new(Method::GET, "/v1/maps");
    let good = token(&provider, &header, &claims);
    assert_eq!(with_key(&maps, &good).to(&api).await.status, StatusCode::OK);
    with_key(&Sent::new(Method::POST, "/v1/maps"), &good).to(&api).await.problem(403, "missing-scope");
    let log = with_key(&Sent::new(Method::GET, "/v1/audit-log"), &good).to(&api).await.json();
    assert_eq!(log["entries"][0]["caller"], "sub:anna");
    let sign_in = Sent::new(Method::POST, "/v1/session");
    // A token counts a minute beyond its end.
    let soon = token(&provider, &header, &with("exp", json!(now().as_second() - 55)));
    let mut cookies = Vec::new();
    for token in [&good, &soon] {
        let cookie = with_key(&sign_in, token).to(&api).await.header("set-cookie").to_owned();
        let pair = cookie.split(';').next().expect("name and value").to_owned();
        assert!(pair.starts_with("stillage_session=sub:"), "{pair}");
        assert_eq!(maps.clone().with("cookie", &pair).to(&api).await.status, StatusCode::OK);
        cookies.push(pair);
    }
    tokio::time::sleep(Duration::from_millis(5_100)).await;
    assert_eq!(maps.clone().with("cookie", &cookies[0]).to(&api).await.status, StatusCode::OK);
    maps.clone().with("cookie", &cookies[1]).to(&api).await.problem(401, "invalid-key");
    let log = Sent::new(Method::GET, "/v1/audit-log").with("cookie", &cookies[0]).to(&api).await.json();
    assert_eq!(log["entries"][0]["operation"], "createMap", "with the same scopes as before");
    let unsigned = good.rsplit_once('.').map(|(signed, _)| format!("{signed}.")).expect("a signature");
    for wrong in [
        token(&stranger, &header, &claims),
        token(&provider, &json!({"alg": "none", "kid": "1"}), &claims),
        token(&provider, &json!({"alg": "HS256", "kid": "1"}), &claims),
        token(&provider, &json!({"alg": "EdDSA", "kid": "2"}), &claims),
        token(&provider, &header, &with("exp", json!(now().as_second() - 61))),
        token(&provider, &header, &with("aud", json!("other"))),
        token(&provider, &header, &with("iss", json!("https://elsewhere.example"))),
        token(&provider, &header, &with("tenant", json!(null))),
        unsigned,
    ] {
        let answer = with_key(&maps, &wrong).to(&api).await;
        answer.problem(401, "invalid-key");
        assert!(answer.header("www-authenticate").contains("invalid_token"));
    }
    with_key(&maps, &good).to(&guarded().await).await.problem(401, "invalid-key");
}
