//! Tokens that hold, and those that do not.

use base64::Engine as _;
use base64::prelude::BASE64_URL_SAFE_NO_PAD;
use jiff::Timestamp;
use ring::rand::SystemRandom;
use ring::signature::{ECDSA_P256_SHA256_FIXED_SIGNING, EcdsaKeyPair, Ed25519KeyPair, KeyPair as _};
use serde_json::{Value, json};

use super::verify::MAX_BYTES;
use super::*;
use crate::access::Scope;
use crate::records::Tenant;

/// Modulus of an RSA key that was made with OpenSSL and thrown away.
const RSA_MODULUS: &str = "uQqS7D5wi5_I8qeXvayPKEeF5a8wdNUDtTRIjTT2gg9E-jPM7j_d985DCieS055-6mhdy4Cxy2a7EHyDSpGaoUe7mvvegTiup6Hs\
    RnNWLXgJn4QNpbiNFBlrT1Q1_YPreB6ZfEhm9-hgVecc_iBzBQDhdkI01TjfU5AUgRlhHJ3GqgtsaDRmXauOVbKrsleJ_mU4gZ3Z\
    EwUm00A23JlmmysmaCfBZPsWCembtj7OyejJZFmkTvAHboxBn6SzA3O5UdmjryvVuO0C5t-NxLqlaVN1vy0P9-FFI7eUkEWV4wYP\
    kaLD85DS9caEwnBYLF9erbYQjVIxtrhvbv4P4do04Q";
/// A token that it signed, until 2100.
const RSA_TOKEN: &str = "eyJhbGciOiJSUzI1NiIsImtpZCI6InJzYSJ9.eyJpc3MiOiJodHRwczovL2xvZ2luLmV4YW1wbGUiLCJhdWQiOiJzdGlsbGFnZSI\
    sImV4cCI6NDEwMjQ0NDgwMCwic3ViIjoicm9ib3QtNyIsInRlbmFudCI6Im5vcnRoIiwic2NvcGUiOiJyZWFkIn0.rOCkPvZDnUR\
    nWM4Jx2C_z2ahzyuP77Ckmj5mYu7rV1bqWYmJKOVUKVRSv-bdM8k-MFmCPkIs_sxT9Q-aOMkmEw5Pg9p6sP3KbrX3CduKab4R-UO\
    N1jZnu5xT_5FJX6hP9WE9Eng3vgfblFdrb9gAfwvmCozn9LGllDYLEx3r-h6x11emRcl6gQrooZZmJgZghVjs1-sKAPugFUt4mbF\
    j1hLQ_6FczT-fzEGy4CaiCi6pPSYZIVMmbnEM2fKxACmrc5AYaov9MeR5xBLPVHRy6hXVB-GBEmbViYuR4XoaJFu5XgHxKbOUGH9\
    CbqFnQnLHG0-_gJUy1SwUwUl6_GtvpA";

/// When the tests take place, seconds since 1970.
const NOW: i64 = 1_800_000_000;

/// A provider with one key of each kind that a test can sign with.
struct Provider {
    p256: EcdsaKeyPair,
    ed25519: Ed25519KeyPair,
    random: SystemRandom,
}

impl Provider {
    fn new() -> Self {
        let random = SystemRandom::new();
        let kind = &ECDSA_P256_SHA256_FIXED_SIGNING;
        let p256 = EcdsaKeyPair::generate_pkcs8(kind, &random).expect("a key");
        let p256 = EcdsaKeyPair::from_pkcs8(kind, p256.as_ref(), &random).expect("a key");
        let ed25519 = Ed25519KeyPair::generate_pkcs8(&random).expect("a key");
        Self { p256, ed25519: Ed25519KeyPair::from_pkcs8(ed25519.as_ref()).expect("a key"), random }
    }

    fn keys(&self) -> TokenKeySet {
        let point = &self.p256.public_key().as_ref()[1..];
        let (x, y) = (BASE64_URL_SAFE_NO_PAD.encode(&point[..32]), BASE64_URL_SAFE_NO_PAD.encode(&point[32..]));
        let ed25519 = BASE64_URL_SAFE_NO_PAD.encode(self.ed25519.public_key());
        let set = json!({"keys": [
            {"kty": "RSA", "kid": "rsa", "use": "sig", "n": RSA_MODULUS, "e": "AQAB"},
            {"kty": "EC", "kid": "p256", "crv": "P-256", "x": x, "y": y},
            {"kty": "OKP", "kid": "ed", "alg": "EdDSA", "crv": "Ed25519", "x": ed25519},
            {"kty": "oct", "kid": "shared", "k": "AAAA"}]});
        TokenKeySet::read(set.to_string().as_bytes()).expect("a set of keys")
    }

    /// A token with this header and these claims, signed as `signer` says, whatever the header says.
    fn token(&self, header: &Value, claims: &Value, signer: &str) -> String {
        let part = |value: &Value| BASE64_URL_SAFE_NO_PAD.encode(value.to_string());
        let signed = format!("{}.{}", part(header), part(claims));
        let signature = match signer {
            "p256" => self.p256.sign(&self.random, signed.as_bytes()).expect("it is signed").as_ref().to_vec(),
            "ed" => self.ed25519.sign(signed.as_bytes()).as_ref().to_vec(),
            _ => Vec::new(),
        };
        format!("{signed}.{}", BASE64_URL_SAFE_NO_PAD.encode(signature))
    }
}

fn rules() -> TokenRules {
    TokenRules { issuer: "https://login.example".into(), audience: "stillage".into(), tenant_claim: "tenant".into() }
}

fn claims() -> Value {
    json!({"iss": "https://login.example", "aud": "stillage", "exp": NOW + 300, "sub": "robot-7", "tenant": "north",
        "scope": "openid read write"})
}

fn verified(provider: &Provider, token: &str) -> Result<TokenBearer, TokenRefusal> {
    verify(token, &provider.keys(), &rules(), Timestamp::from_second(NOW).expect("a time"))
}

#[test]
fn a_token_of_each_algorithm_names_tenant_scopes_and_subject() {
    let provider = Provider::new();
    let expected = TokenBearer {
        tenant: Tenant::new("north"),
        scopes: [Scope::Read, Scope::Write].into_iter().collect(),
        subject: "robot-7".into(),
        end: Timestamp::from_second(NOW + 360).expect("a time"),
    };
    for (algorithm, id) in [("ES256", "p256"), ("EdDSA", "ed")] {
        let token = provider.token(&json!({"alg": algorithm, "kid": id, "typ": "JWT"}), &claims(), id);
        assert_eq!(verified(&provider, &token), Ok(expected.clone()), "{algorithm}");
        let token = provider.token(&json!({"alg": algorithm}), &claims(), id);
        assert_eq!(verified(&provider, &token), Ok(expected.clone()), "without the id of a key");
    }
    let by_rsa = verified(&provider, RSA_TOKEN).expect("it holds");
    assert_eq!(by_rsa.scopes.to_string(), "read");
    let mut several = claims();
    several["aud"] = json!(["other", "stillage"]);
    several.as_object_mut().expect("claims").remove("scope");
    several["scp"] = json!(["admin"]);
    let token = provider.token(&json!({"alg": "EdDSA", "kid": "ed"}), &several, "ed");
    assert!(verified(&provider, &token).expect("it holds").scopes.has(Scope::Admin));
}

#[test]
fn the_algorithm_is_that_of_the_key_whatever_the_token_says() {
    let provider = Provider::new();
    let signature = Err(TokenRefusal::Signature);
    for (algorithm, id, signer) in [
        ("none", "ed", ""),
        ("None", "ed", "ed"),
        ("HS256", "shared", ""),
        ("HS256", "rsa", "p256"),
        ("ES256", "ed", "ed"),
        ("EdDSA", "p256", "p256"),
        ("EdDSA", "unknown", "ed"),
        ("EdDSA", "ed", "p256"),
        ("EdDSA", "ed", ""),
    ] {
        let token = provider.token(&json!({"alg": algorithm, "kid": id}), &claims(), signer);
        assert_eq!(verified(&provider, &token), signature, "{algorithm} {id} {signer}");
    }
    let theirs = Provider::new().token(&json!({"alg": "EdDSA", "kid": "ed"}), &claims(), "ed");
    assert_eq!(verified(&provider, &theirs), signature, "of another provider");
    let good = provider.token(&json!({"alg": "EdDSA", "kid": "ed"}), &claims(), "ed");
    let mut other = claims();
    other["tenant"] = json!("south");
    let forged = provider.token(&json!({"alg": "EdDSA", "kid": "ed"}), &other, "");
    let forged = format!("{}{}", forged, good.rsplit('.').next().expect("a signature"));
    assert_eq!(verified(&provider, &forged), signature, "other claims under a good signature");
    let critical = provider.token(&json!({"alg": "EdDSA", "kid": "ed", "crit": ["b64"]}), &claims(), "ed");
    for text in ["", "a.b", "..", "a.b.c", &critical, &format!("{}{}", "A".repeat(MAX_BYTES), good)] {
        assert_eq!(verified(&provider, text), Err(TokenRefusal::Malformed), "{text:.40}");
    }
}

#[test]
fn what_a_token_says_must_hold_now_and_here() {
    let provider = Provider::new();
    let with = |name: &str, value: Value| {
        let mut claims = claims();
        if value.is_null() {
            claims.as_object_mut().expect("claims").remove(name);
        } else {
            claims[name] = value;
        }
        verified(&provider, &provider.token(&json!({"alg": "EdDSA", "kid": "ed"}), &claims, "ed"))
    };
    let wrong = [
        ("exp", json!(NOW - 61)),
        ("exp", json!("tomorrow")),
        ("exp", Value::Null),
        ("nbf", json!(NOW + 61)),
        ("iss", json!("https://elsewhere.example")),
        ("aud", json!("other")),
        ("aud", json!(["other"])),
        ("aud", Value::Null),
        ("tenant", Value::Null),
        ("tenant", json!("")),
        ("tenant", json!("../north")),
        ("sub", Value::Null),
    ];
    for (name, value) in wrong {
        let refusal = with(name, value.clone()).expect_err("it does not hold");
        let TokenRefusal::Claim(detail) = refusal else { panic!("{name} {value}: {refusal}") };
        assert!(detail.contains(&format!("({name}")), "{name} {value}: {detail}");
    }
    assert!(with("exp", json!(NOW - 59)).is_ok() && with("nbf", json!(NOW + 59)).is_ok(), "clocks differ");
    assert!(!with("scope", Value::Null).expect("it holds").scopes.has(Scope::Read), "no scope opens nothing");
}

#[test]
fn a_set_without_a_key_that_is_used_is_refused() {
    for text in ["", "[]", r#"{"keys": []}"#, r#"{"keys": [{"kty": "oct", "k": "AAAA"}]}"#] {
        assert_eq!(TokenKeySet::read(text.as_bytes()).err(), Some(NoKeySet), "{text}");
    }
    let for_encryption = r#"{"keys": [{"kty": "OKP", "crv": "Ed25519", "x": "AAAA", "use": "enc"}]}"#;
    assert!(TokenKeySet::read(for_encryption.as_bytes()).is_err());
}
