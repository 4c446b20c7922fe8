//! Under which host a request may ask.

use std::sync::Arc;

use axum::extract::{Request, State};
use axum::http::uri::Authority;
use axum::http::{HeaderValue, Version, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

use crate::app::App;
use crate::http::problem::{Problem, ProblemType};
use crate::http::public_address::PublicAddress;

/// Characters of a host that a refusal repeats: the longest name that DNS has.
const TOLD_CHARACTERS: usize = 253;

/// Middleware: exactly one valid `Host` (RFC 9112, 3.2), which is the one of the address where that has one. Requests that
/// smuggle a second one end here.
pub async fn one_host(request: Request, next: Next) -> Response {
    let mut hosts = request.headers().get_all(header::HOST).iter();
    let allowed = match (hosts.next(), hosts.next()) {
        (Some(host), None) => match (plain_authority(host), request.uri().authority()) {
            (Some(host), Some(address)) => host == *address,
            (host, _) => host.is_some(),
        },
        // HTTP/2 names the authority in the address, HTTP/1.0 not at all.
        (None, None) => request.version() != Version::HTTP_11,
        _ => false,
    };
    if allowed {
        return next.run(request).await;
    }
    Problem::new(ProblemType::BadRequest, "a request needs exactly one valid Host header").into_response()
}

/// Host and port, without the user that an authority may have elsewhere (RFC 9110, 7.2).
fn plain_authority(host: &HeaderValue) -> Option<Authority> {
    let authority: Authority = host.to_str().ok()?.parse().ok()?;
    (!authority.as_str().contains('@')).then_some(authority)
}

/// Middleware: the service answers under its own names only ([`crate::allowed_hosts`]); behind a proxy that is trusted, that
/// is the host which clients asked the proxy for. Other names are misdirected (RFC 9110, 15.5.20), which is no matter of
/// rights (403): the same request is right elsewhere.
pub async fn own_host(State(app): State<Arc<App>>, request: Request, next: Next) -> Response {
    let host = request.extensions().get::<PublicAddress>().and_then(PublicAddress::host);
    let Some(stranger) = host.filter(|host| !app.config().allowed_hosts.allows(host)) else {
        return next.run(request).await;
    };
    let told: String = stranger.chars().take(TOLD_CHARACTERS).collect();
    let detail = format!(
        "this service does not answer as {told}: if that is its name, start it with --allowed-hosts {told} \
         (STILLAGE_ALLOWED_HOSTS); it always answers as localhost and under the address of its machine"
    );
    Problem::new(ProblemType::Misdirected, detail).into_response()
}
