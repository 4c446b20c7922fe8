//! What is checked of every request before a handler sees it: key, host, origin, parameters, pace, room and patience.

pub mod access;
pub mod admission;
mod bodies;
mod gate;
pub mod hosts;
pub mod observe;
pub mod pace;
pub mod sign_in;
#[cfg(feature = "otel")]
mod trace_parent;

use std::collections::{HashMap, HashSet};
use std::sync::Arc;
use std::time::Duration;

use axum::extract::{MatchedPath, Query, Request, State};
use axum::http::{HeaderName, HeaderValue, Method, StatusCode, Uri, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use utoipa::openapi::path::ParameterIn;
use utoipa::openapi::{OpenApi, RefOr};

use crate::http::docs::openapi::operations;
use crate::http::problem::{Problem, ProblemType};
use crate::http::public_address::PublicAddress;

/// Longest time in which a request is answered, once its body is there.
const PATIENCE: Duration = Duration::from_secs(30);

/// Middleware: what pages of other sites may do (CORS), and `OPTIONS`.
///
/// They may read, without credentials; they may not write, nor read what a write answers. A form of another site can post
/// without asking first, so a write whose `Origin` is not this host is refused. Programs send no `Origin` and are not touched.
pub async fn other_origins(request: Request, next: Next) -> Response {
    let is_options = request.method() == Method::OPTIONS;
    let is_write = !request.method().is_safe();
    if is_write && !is_own_origin(&request) {
        let detail = "a page of another site may read this service, not write to it";
        return Problem::new(ProblemType::CrossOrigin, detail).into_response();
    }
    let mut response = next.run(request).await;
    let fixed =
        |name: &'static str, value: &'static str| (HeaderName::from_static(name), HeaderValue::from_static(value));
    if is_options && response.status() == StatusCode::METHOD_NOT_ALLOWED {
        let allow = response.headers_mut().remove(header::ALLOW);
        response = StatusCode::NO_CONTENT.into_response();
        response.headers_mut().extend(allow.map(|allow| (header::ALLOW, allow)));
    }
    if is_options {
        response.headers_mut().extend([
            fixed("access-control-allow-methods", "GET, HEAD"),
            fixed("access-control-allow-headers", "accept, authorization, if-none-match, last-event-id"),
            fixed("access-control-max-age", "86400"),
        ]);
    }
    if !is_write {
        response.headers_mut().extend([
            fixed("access-control-allow-origin", "*"),
            fixed(
                "access-control-expose-headers",
                "content-crs, etag, link, location, preference-applied, ratelimit, ratelimit-policy, retry-after, www-authenticate, \
                 x-request-id",
            ),
        ]);
    }
    response
}

/// Whether a request comes from a page of this service, or from no page at all.
fn is_own_origin(request: &Request) -> bool {
    let Some(origin) = request.headers().get(header::ORIGIN) else { return true };
    let address = request.extensions().get::<PublicAddress>();
    origin.to_str().is_ok_and(|origin| address.is_some_and(|address| address.is_origin(origin)))
}

/// The query parameters of every operation, as the OpenAPI document lists them.
#[derive(Debug, Default)]
pub struct KnownParameters(HashMap<(String, Method), HashSet<String>>);

impl KnownParameters {
    /// Reads them from the document.
    #[must_use]
    pub fn of(document: &OpenApi) -> Self {
        let mut known = HashMap::new();
        for (path, method, operation) in operations(document) {
            let parameters = operation.parameters.iter().flatten().filter_map(|parameter| match parameter {
                RefOr::T(parameter) => Some(parameter),
                RefOr::Ref(_) => None,
            });
            let names = parameters.filter(|parameter| parameter.parameter_in == ParameterIn::Query);
            known.insert((path.to_owned(), method), names.map(|parameter| parameter.name.clone()).collect());
        }
        Self(known)
    }

    /// A parameter of the query that the operation does not have.
    fn stranger(&self, path: &str, method: &Method, uri: &Uri) -> Option<String> {
        let method = if *method == Method::HEAD { Method::GET } else { method.clone() };
        let known = self.0.get(&(path.to_owned(), method))?;
        let Query(pairs) = Query::<Vec<(String, String)>>::try_from_uri(uri).ok()?;
        pairs.into_iter().map(|(name, _)| name).find(|name| !known.contains(name))
    }
}

/// Middleware: a query parameter that the operation does not have is an error, never ignored.
pub async fn known_parameters(
    State(known): State<Arc<KnownParameters>>,
    path: Option<MatchedPath>,
    request: Request,
    next: Next,
) -> Response {
    let stranger = path.and_then(|path| known.stranger(path.as_str(), request.method(), request.uri()));
    match stranger {
        Some(name) => Problem::parameter(&name, "is not a parameter of this operation").into_response(),
        None => next.run(request).await,
    }
}

/// A resource is the same with a slash at its end: clients that take an address for a root ask for it so. The reference page
/// alone lies in a folder.
#[must_use]
pub fn without_last_slash(mut request: Request) -> Request {
    let path = request.uri().path();
    let trimmed = path.trim_end_matches('/');
    if trimmed.len() == path.len() || trimmed.is_empty() || trimmed.starts_with("/docs") {
        return request;
    }
    let query = request.uri().query().map(|query| format!("?{query}")).unwrap_or_default();
    if let Ok(address) = format!("{trimmed}{query}").parse() {
        *request.uri_mut() = address;
    }
    request
}

/// Middleware: the answer has to come in time. Streams of events begin at once and go on as long as they like.
pub async fn in_time(request: Request, next: Next) -> Response {
    tokio::time::timeout(PATIENCE, next.run(request)).await.unwrap_or_else(|_| {
        Problem::new(ProblemType::Unavailable, "the answer took too long").retry_after(10).into_response()
    })
}
