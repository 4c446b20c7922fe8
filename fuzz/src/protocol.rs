//! What comes before any document: the bytes of a connection, and the token that somebody shows.

use std::sync::LazyLock;

use jiff::Timestamp;
use stillage::access::{TokenKeySet, TokenRules, verify_token};
use stillage::server::HeadWatch;

use super::check_refusal;

/// A connection, as the watch over its heads passes it on: the same bytes however they are cut, but for line feeds.
pub fn heads(bytes: &[u8]) {
    let whole = passed(bytes, bytes.len());
    for piece in [1, 7] {
        assert_eq!(passed(bytes, piece), whole, "in pieces of {piece}");
    }
    let changed = bytes.iter().zip(&whole).filter(|(before, after)| before != after);
    assert!(changed.clone().all(|(before, after)| (*before, *after) == (b'\n', 0)));
    assert!(changed.count() <= 1, "the parser refuses the first one, and reads no further");
}

fn passed(bytes: &[u8], piece: usize) -> Vec<u8> {
    let (mut watch, mut bytes) = (HeadWatch::default(), bytes.to_vec());
    bytes.chunks_mut(piece.max(1)).for_each(|piece| watch.pass(piece));
    bytes
}

static KEYS: LazyLock<TokenKeySet> = LazyLock::new(|| {
    // The public key of the example in RFC 8037, A.2.
    let set = br#"{"keys": [{"kty": "OKP", "crv": "Ed25519", "x": "11qYAYKxCrfVS_7TyWQHOg7hcvPapiMlrwIaaPcHURo"}]}"#;
    TokenKeySet::read(set).expect("a set of keys")
});

/// A token of an identity provider, whose key nobody here has: none opens anything.
pub fn token(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let rules = TokenRules {
        issuer: "https://login.example".into(),
        audience: "stillage".into(),
        tenant_claim: "tenant".into(),
    };
    check_refusal(&verify_token(text, &KEYS, &rules, Timestamp::UNIX_EPOCH).expect_err("nobody signed it"));
}
