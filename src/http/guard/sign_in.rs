//! Who sends a request, by its key.

use std::sync::Arc;

use axum::extract::{Request, State};
use axum::http::header;
use axum::middleware::Next;
use axum::response::Response;

use crate::app::{App, Caller};
use crate::http::problem::Problem;

/// Why a request has no caller.
#[derive(Debug, Clone)]
pub struct NotSignedIn(pub Problem);

/// Middleware: gives a request its [`Caller`], or the reason why it has none. What needs one refuses for that reason
/// ([`super::access`]); what needs none is answered, whatever the request brought.
pub async fn sign_in(State(app): State<Arc<App>>, mut request: Request, next: Next) -> Response {
    let caller = match sent_key(&request) {
        _ if !app.needs_keys() => Ok(Caller::local()),
        Ok(key) => app.sign_in(&key).await.map_err(Problem::from),
        Err(problem) => Err(problem),
    };
    match caller {
        Ok(caller) => drop(request.extensions_mut().insert(caller)),
        Err(problem) => drop(request.extensions_mut().insert(NotSignedIn(problem))),
    }
    next.run(request).await
}

/// The key of a request.
fn sent_key(request: &Request) -> Result<String, Problem> {
    let mut sent = request.headers().get_all(header::AUTHORIZATION).iter();
    let (first, second) = (sent.next().ok_or_else(Problem::key_required)?, sent.next());
    let key = first.to_str().ok().filter(|_| second.is_none()).and_then(bearer);
    key.map(str::to_owned).ok_or_else(Problem::not_bearer)
}

/// What stands behind `Bearer` (RFC 6750, 2.1); the word is written in any case (RFC 9110, 11.1).
fn bearer(value: &str) -> Option<&str> {
    let (scheme, key) = value.split_once(' ')?;
    scheme.eq_ignore_ascii_case("bearer").then(|| key.trim_matches(' '))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_key_stands_behind_bearer() {
        assert_eq!(bearer("Bearer stillage_1"), Some("stillage_1"));
        assert_eq!(bearer("bearer  stillage_1 "), Some("stillage_1"));
        assert_eq!(bearer("Basic c3RpbGxhZ2U="), None);
        assert_eq!(bearer("stillage_1"), None);
    }
}
