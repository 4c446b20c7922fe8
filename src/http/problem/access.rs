//! Refusals of those who have no right, or ask too often.

use super::detail::Problem;
use super::types::ProblemType;
use crate::access::Scope;

impl Problem {
    /// A request without a key, where one is needed.
    #[must_use]
    pub fn key_required() -> Self {
        let detail = "send a key as `Authorization: Bearer stillage_...`; the operator of the service makes one with \
                      `stillage key create`";
        Self::new(ProblemType::KeyRequired, detail).challenge("")
    }

    /// An `Authorization` that is not understood.
    #[must_use]
    pub fn not_bearer() -> Self {
        Self::invalid_key("Authorization is sent once, and is the word Bearer, a blank and the key")
    }

    /// A key that opens nothing.
    #[must_use]
    pub fn invalid_key(detail: impl Into<String>) -> Self {
        Self::new(ProblemType::InvalidKey, detail).challenge(", error=\"invalid_token\"")
    }

    /// A key that is not good for an operation.
    #[must_use]
    pub fn missing_scope(scope: Scope) -> Self {
        let scope = scope.name();
        let detail = format!("this needs a key with the scope {scope}: the operator makes one with --scopes {scope}");
        let challenge = format!(", error=\"insufficient_scope\", scope=\"{scope}\"");
        Self::new(ProblemType::MissingScope, detail).challenge(&challenge)
    }

    /// A wrong key from an address that sent many.
    #[must_use]
    pub fn too_many_wrong_keys(retry_after_s: u32) -> Self {
        let detail = format!(
            "this key opens nothing, and many such came from this address: look at the key, and try again in {retry_after_s} s"
        );
        Self::new(ProblemType::TooManyRequests, detail).retry_after(retry_after_s)
    }

    /// A key that asked too often.
    #[must_use]
    pub fn too_many_requests(most: u32, retry_after_s: u32) -> Self {
        let detail = format!("a key may ask {most} times a minute: try again in {retry_after_s} s");
        Self::new(ProblemType::TooManyRequests, detail).retry_after(retry_after_s)
    }
}
