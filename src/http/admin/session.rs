//! Browsers sign in with a key or a token and then have a cookie, which goes with pictures, streams of events and links, too.

use std::sync::Arc;

use axum::Extension;
use axum::extract::State;
use axum::http::{HeaderMap, HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};

use crate::app::{App, Caller};
use crate::http::public_address::PublicAddress;

/// The name of the cookie.
const COOKIE: &str = "stillage_session";

/// Sign in
///
/// For browsers: answers a key or a token (`Authorization: Bearer`) with a cookie that stands for it for 12 hours, or until the
/// browser is closed, the key is revoked, or key or token have ended. Scripts cannot read it, and it is not sent from pages of
/// other sites. A service without keys answers no cookie.
#[utoipa::path(post, path = "/v1/session", tag = "service", operation_id = "signIn", security(("key" = ["read"]), ()),
    responses((status = 204, description = "Signed in",
        headers(("Set-Cookie" = Option<String>, description = "The session")))))]
pub async fn sign_in(
    State(app): State<Arc<App>>,
    Extension(address): Extension<PublicAddress>,
    caller: Caller,
) -> Response {
    let cookie = app.session(&caller).and_then(|session| cookie(&address, &session, ""));
    (StatusCode::NO_CONTENT, HeaderMap::from_iter(cookie)).into_response()
}

/// Sign out
///
/// Takes the cookie away.
#[utoipa::path(delete, path = "/v1/session", tag = "service", operation_id = "signOut", security(()),
    responses((status = 204, description = "Signed out",
        headers(("Set-Cookie" = String, description = "An empty session")))))]
pub async fn sign_out(Extension(address): Extension<PublicAddress>) -> Response {
    let cookie = cookie(&address, "", "; Max-Age=0");
    (StatusCode::NO_CONTENT, HeaderMap::from_iter(cookie)).into_response()
}

fn cookie(address: &PublicAddress, session: &str, end: &str) -> Option<(header::HeaderName, HeaderValue)> {
    let path = address.path("/");
    let secure = if address.is_secure() { "; Secure" } else { "" };
    let cookie = format!("{COOKIE}={session}; Path={path}; HttpOnly; SameSite=Strict{secure}{end}");
    Some((header::SET_COOKIE, HeaderValue::try_from(cookie).ok()?))
}

/// The session that a request brings.
#[must_use]
pub fn sent(headers: &HeaderMap) -> Option<String> {
    let lines = headers.get_all(header::COOKIE).iter().filter_map(|line| line.to_str().ok());
    let mut cookies = lines.flat_map(|line| line.split(';')).filter_map(|cookie| cookie.trim().split_once('='));
    cookies.find(|(name, _)| *name == COOKIE).map(|(_, session)| session.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_session_is_found_among_other_cookies() {
        let sent_with = |cookies: &str| {
            sent(&HeaderMap::from_iter([(header::COOKIE, HeaderValue::from_str(cookies).expect("a header"))]))
        };
        assert_eq!(sent_with("a=b; stillage_session=7.8.9; c=d").as_deref(), Some("7.8.9"));
        assert_eq!(sent_with("my_stillage_session=7"), None);
    }
}
