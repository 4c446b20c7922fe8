//! Who sends a request, by its key or session.

use std::sync::Arc;
use std::time::Instant;

use axum::extract::{Request, State};
use axum::http::{HeaderMap, HeaderName, HeaderValue, header};
use axum::middleware::Next;
use axum::response::Response;

use crate::access::{Allowance, RateLimiter, WINDOW};
use crate::app::{App, Caller, Credential};
use crate::http::admin::session;
use crate::http::problem::Problem;

/// Why a request has no caller.
#[derive(Debug, Clone)]
pub struct NotSignedIn(pub Problem);

/// What the middleware works with.
#[derive(Debug, Clone)]
pub struct SignIn {
    app: Arc<App>,
    /// `None` where a key may ask as often as it likes.
    limiter: Option<Arc<RateLimiter>>,
}

impl SignIn {
    /// That of a service. Where it needs no keys, nobody is counted.
    #[must_use]
    pub fn new(app: Arc<App>) -> Self {
        let most = app.config().requests_per_minute;
        let limiter = (app.needs_keys() && most > 0).then(|| Arc::new(RateLimiter::new(most)));
        Self { app, limiter }
    }
}

/// Middleware: gives a request its [`Caller`], or the reason why it has none: no key, a wrong one, or too many requests of it.
/// What needs a caller refuses for that reason ([`super::access`]); what needs none is answered, whatever the request brought.
/// Answers to a key tell how much it may ask still.
pub async fn sign_in(State(SignIn { app, limiter }): State<SignIn>, mut request: Request, next: Next) -> Response {
    if !app.needs_keys() {
        request.extensions_mut().insert(Caller::local());
        return next.run(request).await;
    }
    let caller = match shown(&request) {
        Ok(shown) => app.sign_in(&shown).await.map_err(Problem::from),
        Err(problem) => Err(problem),
    };
    let mut left = HeaderMap::new();
    let caller = caller.and_then(|caller| match &limiter {
        Some(limiter) => {
            let allowance = limiter.take(caller.name(), Instant::now());
            left = headers(limiter.per_window(), allowance);
            let too_many = || Problem::too_many_requests(limiter.per_window(), allowance.reset_s);
            allowance.is_allowed.then_some(caller).ok_or_else(too_many)
        }
        None => Ok(caller),
    });
    match caller {
        Ok(caller) => drop(request.extensions_mut().insert(caller)),
        Err(problem) => drop(request.extensions_mut().insert(NotSignedIn(problem))),
    }
    let is_signed_in = request.extensions().get::<Caller>().is_some();
    let mut response = next.run(request).await;
    response.headers_mut().extend(left);
    if is_signed_in {
        keep_private(response.headers_mut());
    }
    response
}

/// An answer to somebody is for nobody else who asks the same cache, and is asked for again after they signed out. Those that may
/// not be kept at all, or are the same for everybody, say so.
fn keep_private(headers: &mut HeaderMap) {
    if headers.get(header::CACHE_CONTROL).is_none_or(|known| known == "no-cache") {
        headers.insert(header::CACHE_CONTROL, HeaderValue::from_static("private, no-cache"));
    }
}

/// What is left of a limit (draft-ietf-httpapi-ratelimit-headers-10, 3 and 4).
fn headers(most: u32, allowance: Allowance) -> HeaderMap {
    let header =
        |name: &'static str, value: String| Some((HeaderName::from_static(name), HeaderValue::try_from(value).ok()?));
    let policy = header("ratelimit-policy", format!("\"key\";q={most};w={}", WINDOW.as_secs()));
    let left = header("ratelimit", format!("\"key\";r={};t={}", allowance.remaining, allowance.reset_s));
    policy.into_iter().chain(left).collect()
}

/// What a request shows: a key, or the session of a browser.
fn shown(request: &Request) -> Result<Credential, Problem> {
    let mut sent = request.headers().get_all(header::AUTHORIZATION).iter();
    let Some(first) = sent.next() else {
        return session::sent(request.headers()).map(Credential::Session).ok_or_else(Problem::key_required);
    };
    let key = first.to_str().ok().filter(|_| sent.next().is_none()).and_then(bearer);
    key.map(|key| Credential::Key(key.to_owned())).ok_or_else(Problem::not_bearer)
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
