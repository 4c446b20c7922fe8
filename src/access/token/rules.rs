//! Which tokens are taken, what they tell, and why others are not.

use jiff::Timestamp;

use crate::access::Scopes;
use crate::records::Tenant;

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
    /// When it opens nothing any more.
    pub end: Timestamp,
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
