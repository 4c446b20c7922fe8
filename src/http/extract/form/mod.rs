//! Forms (`multipart/form-data`, RFC 7578) as real clients send them.
//!
//! Boundaries come quoted or with characters that want quotes, names of parts without quotes, names of files in four
//! encodings ([`Disposition`]), and contents in gzip or base64 ([`plain_content`]).

mod content;
mod disposition;

use axum::extract::{FromRequest, Multipart, Request};
use axum::http::{HeaderValue, header};

use crate::http::problem::{Problem, ProblemType};

pub use content::plain_content;
pub use disposition::Disposition;

/// Opens the form in the body of a request.
///
/// # Errors
/// 400 without a boundary.
pub async fn open<S: Send + Sync>(mut request: Request, state: &S) -> Result<Multipart, Problem> {
    let without_boundary = || {
        let detail =
            "the Content-Type has no boundary: send multipart/form-data; boundary=... with the one of the body";
        Problem::new(ProblemType::BadRequest, detail)
    };
    let content_type = request.headers().get(header::CONTENT_TYPE).and_then(|value| value.to_str().ok());
    let boundary = content_type.and_then(boundary).ok_or_else(without_boundary)?;
    let quoted = HeaderValue::try_from(format!("multipart/form-data; boundary=\"{boundary}\""));
    request.headers_mut().insert(header::CONTENT_TYPE, quoted.map_err(|_| without_boundary())?);
    Multipart::from_request(request, state).await.map_err(|_| without_boundary())
}

/// The boundary of a media type, without quotes.
fn boundary(content_type: &str) -> Option<&str> {
    let parameters = content_type.split(';').skip(1).filter_map(|parameter| parameter.split_once('='));
    let (_, value) = parameters.into_iter().find(|(name, _)| name.trim().eq_ignore_ascii_case("boundary"))?;
    Some(value.trim().trim_matches('"')).filter(|boundary| !boundary.is_empty() && !boundary.contains(['"', '\\']))
}

#[cfg(test)]
mod tests {
    use super::boundary;

    #[test]
    fn boundaries_come_with_and_without_quotes() {
        assert_eq!(boundary("multipart/form-data; boundary=b0"), Some("b0"));
        assert_eq!(boundary("multipart/form-data; charset=utf-8; Boundary=\"b 0\""), Some("b 0"));
        assert_eq!(boundary("multipart/form-data; boundary=----=_Part_1.2"), Some("----=_Part_1.2"));
        assert_eq!(boundary("multipart/form-data; boundary="), None);
        assert_eq!(boundary("multipart/form-data"), None);
    }
}
