//! Tokens of an identity provider: JWT (RFC 7519) signed with its keys (RFC 7515, 7517).
//!
//! What a token says of itself decides nothing: of the three algorithms, which are fixed, its key decides which one is used, and
//! only signatures are believed. What is not known is refused (`none`, `HS256`, `crit`).
//!
//! | file | what it holds |
//! | --- | --- |
//! | `key_set` | the public keys of the provider |
//! | `claims` | what a token says, and whether it holds now and here |

mod claims;
mod key_set;
#[cfg(test)]
mod tests;

use base64::Engine as _;
use base64::prelude::BASE64_URL_SAFE_NO_PAD;
use jiff::Timestamp;
use serde::Deserialize;

use super::Scopes;
use crate::records::Tenant;

pub use key_set::{NoKeySet, TokenKeySet};

/// Longest token that is read, bytes.
const MAX_BYTES: usize = 8 << 10;

/// Which tokens are taken.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TokenRules {
    /// Who must have made them (`iss`).
    pub issuer: String,
    /// For whom they must be (`aud`).
    pub audience: String,
    /// The claim that names the tenant.
    pub tenant_claim: String,
}

/// Who shows a token that holds.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TokenBearer {
    /// For whom it acts.
    pub tenant: Tenant,
    /// What it is good for.
    pub scopes: Scopes,
    /// Who it is (`sub`).
    pub subject: String,
}

/// Why a token opens nothing.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum TokenRefusal {
    /// It is no token, or one of a kind that is not taken.
    #[error("this is no token that is taken here: three parts in base64url, signed with RS256, ES256 or EdDSA")]
    Malformed,
    /// No key of the provider made its signature.
    #[error("no key of the identity provider made the signature of this token")]
    Signature,
    /// What it says does not hold.
    #[error("{0}")]
    Claim(String),
}

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
