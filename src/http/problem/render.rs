//! Writes the body of every refusal, once, at the outside.

use axum::extract::Request;
use axum::http::{HeaderValue, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

use super::detail::Problem;
use super::types::ProblemType;
use crate::http::public_address::PublicAddress;

/// Media type of problem details.
pub const PROBLEM_JSON: &str = "application/problem+json";

/// Middleware: writes the body of every refusal.
pub async fn render(request: Request, next: Next) -> Response {
    let (method, uri) = (request.method().clone(), request.uri().clone());
    let address = request.extensions().get::<PublicAddress>().cloned().unwrap_or_default();
    let mut response = next.run(request).await;
    let status = response.status();
    if !status.is_client_error() && !status.is_server_error() {
        return response;
    }
    let problem = response.extensions_mut().remove::<Problem>().unwrap_or_else(|| {
        let kind = ProblemType::of_status(status);
        let detail = match kind {
            ProblemType::NotFound => format!("there is nothing at {}", uri.path()),
            ProblemType::MethodNotAllowed => format!("{} does not answer {method}", uri.path()),
            kind => kind.title().to_owned(),
        };
        Problem::new(kind, detail)
    });
    let body =
        serde_json::to_vec(&problem.document(&address.path(uri.path()))).expect("strings and numbers can be written");
    let (mut parts, _) = response.into_parts();
    // For the metrics, which lie around this.
    parts.extensions.insert(problem.kind());
    parts.headers.remove(header::CONTENT_LENGTH);
    parts.headers.insert(header::CONTENT_TYPE, HeaderValue::from_static(PROBLEM_JSON));
    parts.headers.insert(header::CACHE_CONTROL, HeaderValue::from_static("no-store"));
    Response::from_parts(parts, body.into())
}

/// What a panic becomes.
#[must_use]
#[expect(clippy::needless_pass_by_value, reason = "the layer that catches panics hands them over")]
pub fn of_panic(panic: Box<dyn std::any::Any + Send>) -> Response {
    let message = panic.downcast_ref::<&str>().copied().map(str::to_owned);
    let message = message.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_default();
    tracing::error!(panic = message, "a request panicked");
    Problem::new(ProblemType::Internal, "the service failed: its log says why, under this request's id").into_response()
}
