//! Who sends a request, by its key or session.

use std::sync::Arc;
use std::time::Instant;

use axum::extract::{Request, State};
use axum::http::{HeaderMap, HeaderName, HeaderValue, header};
use axum::middleware::Next;
use axum::response::Response;

use crate::access::{Allowance, RateLimiter, WINDOW};
use crate::app::{App, Caller, Credential};
use crate::http::ClientAddress;
use crate::http::admin::session;
use crate::http::problem::{Problem, ProblemType};

/// Wrong keys that an address may send in a minute: a program whose key has ended, and that tries again every two seconds, is
/// told so each time.
const WRONG_KEYS_PER_WINDOW: u32 = 30;

/// Why a request has no caller.
#[derive(Debug, Clone)]
pub struct NotSignedIn(pub Problem);

/// What the middleware works with.
#[derive(Debug, Clone)]
pub struct SignIn {
    app: Arc<App>,
    /// `None` where a key may ask as often as it likes.
    limiter: Option<Arc<RateLimiter>>,
    /// Counts the wrong keys of an address. Right ones never wait for it.
    wrong_keys: Arc<RateLimiter>,
}

impl SignIn {
    /// That of a service. Where it needs no keys, nobody is counted.
    #[must_use]
    pub fn new(app: Arc<App>) -> Self {
        let most = app.config().requests_per_minute;
        let limiter = (app.needs_keys() && most > 0).then(|| Arc::new(RateLimiter::new(most)));
        Self { app, limiter, wrong_keys: Arc::new(RateLimiter::new(WRONG_KEYS_PER_WINDOW)) }
    }

    /// Who shows something from an address, or the reason why that is nobody.
    async fn caller(&self, shown: Result<Credential, Problem>, address: ClientAddress) -> Result<Caller, Problem> {
        // A session of a browser ends in the course of things.
        let is_key = matches!(shown, Ok(Credential::Key(_)));
        let caller = match shown {
            Ok(shown) => self.app.sign_in(&shown).await.map_err(Problem::from),
            Err(problem) => Err(problem),
        };
        caller.map_err(|problem| {
            let is_wrong_key = is_key && problem.kind() == ProblemType::InvalidKey;
            if is_wrong_key { self.after_wrong_key(address, problem) } else { problem }
        })
    }

    /// What an address is told that sent a wrong key.
    fn after_wrong_key(&self, ClientAddress(address): ClientAddress, problem: Problem) -> Problem {
        let allowance = self.wrong_keys.take(&address.to_string(), Instant::now());
        if !allowance.is_allowed {
            return Problem::too_many_wrong_keys(allowance.reset_s);
        }
        if allowance.remaining == 0 {
            tracing::warn!(%address, "sends many wrong keys; further ones are answered 429");
        }
        problem
    }
}

/// Middleware: gives a request its [`Caller`], or the reason why it has none: no key, a wrong one, too many wrong ones of
/// its address, or too many requests of it. What needs a caller refuses for that reason ([`super::access`]); what needs none is
/// answered, whatever the request brought. Answers to a key tell how much it may ask still.
pub async fn sign_in(State(guard): State<SignIn>, mut request: Request, next: Next) -> Response {
    if !guard.app.needs_keys() {
        request.extensions_mut().insert(Caller::local());
        return next.run(request).await;
    }
    let mut left = HeaderMap::new();
    let sender = guard.caller(shown(&request), ClientAddress::of(&request)).await;
    let caller = sender.and_then(|caller| match &guard.limiter {
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
