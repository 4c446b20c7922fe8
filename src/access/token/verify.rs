//! Header, signature and claims of a token, in this order.

use base64::Engine as _;
use base64::prelude::BASE64_URL_SAFE_NO_PAD;
use jiff::Timestamp;
use serde::Deserialize;

use super::claims;
use super::key_set::TokenKeySet;
use super::rules::{TokenBearer, TokenRefusal, TokenRules};

/// Longest token that is read, bytes.
pub(super) const MAX_BYTES: usize = 8 << 10;

/// What stands before the claims (RFC 7515, 4).
#[derive(Debug, Deserialize)]
struct TokenHeader {
    alg: String,
    kid: Option<String>,
    /// Extensions that must be understood; none is.
    crit: Option<serde_json::Value>,
}

/// Whether a text looks like a token rather than a key.
#[must_use]
pub fn is_token(text: &str) -> bool {
    text.bytes().filter(|byte| *byte == b'.').count() == 2
}

/// Who shows a token, at a time.
///
/// # Errors
/// Why it opens nothing.
pub fn verify(
    token: &str,
    keys: &TokenKeySet,
    rules: &TokenRules,
    now: Timestamp,
) -> Result<TokenBearer, TokenRefusal> {
    let malformed = || TokenRefusal::Malformed;
    let (signed, signature) = token.rsplit_once('.').filter(|_| token.len() <= MAX_BYTES).ok_or_else(malformed)?;
    let (header, claims) = signed.split_once('.').ok_or_else(malformed)?;
    let decoded = |part: &str| BASE64_URL_SAFE_NO_PAD.decode(part).map_err(|_| malformed());
    let header: TokenHeader = serde_json::from_slice(&decoded(header)?).map_err(|_| malformed())?;
    if header.crit.is_some() {
        return Err(malformed());
    }
    let signature = decoded(signature)?;
    keys.verify(&header.alg, header.kid.as_deref(), signed.as_bytes(), &signature)?;
    claims::read(&decoded(claims)?, rules, now)
}
