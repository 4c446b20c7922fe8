//! Bodies in gzip or zstd (`Content-Encoding`).

use axum::body::Body;
use axum::extract::Request;
use axum::http::{HeaderValue, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use tower::{Layer as _, ServiceExt as _, service_fn};
use tower_http::decompression::{DecompressionBody, RequestDecompressionLayer};

use crate::http::problem::{Problem, ProblemType};

/// The codings of bodies that are read, for `Accept-Encoding` in refusals (RFC 9110, 12.5.3).
const CODINGS: HeaderValue = HeaderValue::from_static("gzip, zstd");

/// Middleware: bodies come out of their coding before anything reads them. The limits hold for what comes out; other codings
/// are refused by name (RFC 9110, 8.4).
pub async fn decoded(mut request: Request, next: Next) -> Response {
    let transfer = lower_case(&request, "content-transfer-encoding");
    if !matches!(transfer.as_str(), "" | "binary" | "8bit" | "7bit") {
        let detail = format!("the body is encoded as {transfer:.20}, which HTTP does not have: send it as it is");
        return Problem::new(ProblemType::UnsupportedMediaType, detail).into_response();
    }
    match lower_case(&request, "content-encoding").as_str() {
        "" => return next.run(request).await,
        "identity" => {
            request.headers_mut().remove(header::CONTENT_ENCODING);
            return next.run(request).await;
        }
        "gzip" | "x-gzip" => {
            request.headers_mut().insert(header::CONTENT_ENCODING, HeaderValue::from_static("gzip"));
        }
        "zstd" => {}
        other => {
            let detail = format!("the body is encoded as {other:.20}: send it as it is, in gzip or in zstd");
            let mut response = Problem::new(ProblemType::UnsupportedMediaType, detail).into_response();
            response.headers_mut().insert(header::ACCEPT_ENCODING, CODINGS);
            return response;
        }
    }
    let inner = service_fn(move |request: axum::http::Request<DecompressionBody<Body>>| {
        let next = next.clone();
        async move { Ok::<_, std::convert::Infallible>(next.run(request.map(Body::new)).await) }
    });
    match RequestDecompressionLayer::new().layer(inner).oneshot(request).await {
        Ok(response) => response.map(Body::new),
        Err(impossible) => match impossible {},
    }
}

/// The value of a header in lower case; empty where there is none.
fn lower_case(request: &Request, name: &str) -> String {
    let value = request.headers().get(name).map(|value| String::from_utf8_lossy(value.as_bytes()).to_ascii_lowercase());
    value.unwrap_or_default()
}
