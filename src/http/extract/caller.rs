//! Who sends a request.

use axum::extract::FromRequestParts;
use axum::http::request::Parts;

use crate::app::Caller;
use crate::http::problem::Problem;

impl<S: Send + Sync> FromRequestParts<S> for Caller {
    type Rejection = Problem;

    /// Whoever [signed in](crate::http::guard::sign_in::sign_in). A handler gets at nothing that belongs to somebody without
    /// a caller.
    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Self, Problem> {
        parts.extensions.get().cloned().ok_or_else(Problem::key_required)
    }
}
