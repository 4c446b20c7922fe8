//! Bodies, read whole.

use std::error::Error;

use axum::body::Bytes;
use axum::extract::rejection::BytesRejection;
use axum::extract::{FromRequest, Request};
use axum::http::{HeaderMap, StatusCode, header};

use crate::http::problem::{Problem, ProblemType};

/// Media type of the body, without parameters, lower case.
#[must_use]
pub fn content_type(headers: &HeaderMap) -> String {
    let value = headers.get(header::CONTENT_TYPE).and_then(|value| value.to_str().ok()).unwrap_or_default();
    value.split(';').next().unwrap_or_default().trim().to_ascii_lowercase()
}

/// Reads a body whole, up to the limit of its route.
///
/// # Errors
/// 413 over the limit, 408 when it arrives too slowly, 400 when it breaks off.
pub async fn body<S: Send + Sync>(request: Request, state: &S) -> Result<Bytes, Problem> {
    Bytes::from_request(request, state).await.map_err(|rejection: BytesRejection| match rejection.status() {
        StatusCode::PAYLOAD_TOO_LARGE => Problem::new(ProblemType::TooLarge, "the body is over the limit"),
        _ => broken_body(&rejection),
    })
}

/// Why a body could not be read to its end.
pub fn broken_body(error: &(dyn Error + 'static)) -> Problem {
    let mut causes = std::iter::successors(Some(error), |&cause| cause.source());
    match causes.find_map(|cause| cause.downcast_ref::<crate::http::guard::pace::TooSlow>()) {
        Some(slow) => Problem::new(ProblemType::Timeout, slow.to_string()),
        None => Problem::new(
            ProblemType::BadRequest,
            "the body cannot be read to its end: it breaks off, or it is not what its headers say",
        ),
    }
}
