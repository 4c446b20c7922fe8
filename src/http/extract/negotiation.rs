//! Content negotiation by `Accept` (RFC 9110, 12.5.1). JSON is the default everywhere.

use std::convert::Infallible;

use axum::extract::{FromRequestParts, Request};
use axum::http::request::Parts;
use axum::http::{HeaderMap, HeaderValue, Method, StatusCode, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

use crate::http::links::JSON_FG;
use crate::http::problem::{PROBLEM_JSON, Problem, ProblemType};

/// The name by which version 1.0 of JSON-FG calls itself until it is registered.
const JSON_FG_VENDOR: &str = "application/vnd.ogc.fg+json";

/// One media range of an `Accept` header.
#[derive(Debug, Clone, PartialEq)]
struct MediaRange {
    /// `type/subtype`, either of them may be `*`.
    essence: String,
    /// 0 (not at all) to 1.
    quality: f32,
}

impl MediaRange {
    fn read(text: &str) -> Option<Self> {
        let mut parts = text.split(';').map(str::trim);
        let mut essence = parts.next().filter(|essence| essence.contains('/'))?.to_ascii_lowercase();
        if essence == JSON_FG_VENDOR {
            JSON_FG.clone_into(&mut essence);
        }
        let quality = parts.find_map(|part| part.strip_prefix("q=").or_else(|| part.strip_prefix("Q=")));
        Some(Self { essence, quality: quality.map_or(Some(1.0), |quality| quality.parse().ok())? })
    }

    /// How closely the range names a media type: 0 not at all, 3 by its name.
    fn closeness(&self, media_type: &str) -> u8 {
        let essence = media_type.split(';').next().unwrap_or_default();
        let family = essence.split('/').next().unwrap_or_default();
        match self.essence.as_str() {
            range if range == essence => 4,
            // Whoever reads JSON reads GeoJSON and the other way round: clients ask for either.
            "application/json" | "application/geo+json" if is_json(essence) => 3,
            range if range.strip_suffix("/*") == Some(family) => 2,
            "*/*" => 1,
            _ => 0,
        }
    }
}

fn is_json(essence: &str) -> bool {
    essence == "application/json" || essence.ends_with("+json")
}

/// What the client accepts; everything, without a header.
#[derive(Debug, Clone)]
pub struct Accept(Vec<MediaRange>);

impl Accept {
    /// The ranges but for problem details, in which every refusal is written: clients made by openapi-generator accept
    /// nothing else where the answer is no JSON, a picture for example.
    fn read(headers: &HeaderMap) -> Self {
        let values = headers.get_all(header::ACCEPT).iter().filter_map(|value| value.to_str().ok());
        let ranges = values.flat_map(|value| value.split(',')).filter_map(|text| MediaRange::read(text.trim()));
        Self(ranges.filter(|range| range.essence != PROBLEM_JSON).collect())
    }

    /// Quality of a media type: that of the closest range.
    fn quality(&self, media_type: &str) -> f32 {
        if self.0.is_empty() {
            return 1.0;
        }
        let ranges = self.0.iter().map(|range| (range.closeness(media_type), range.quality));
        ranges
            .filter(|(closeness, _)| *closeness > 0)
            .max_by_key(|(closeness, _)| *closeness)
            .map_or(0.0, |best| best.1)
    }

    /// Whether a media type is accepted.
    #[must_use]
    pub fn accepts(&self, media_type: &str) -> bool {
        self.quality(media_type) > 0.0
    }

    /// The media type that is wanted most; of equals the first. The first too where none is accepted: [`negotiate`] then
    /// refuses it.
    #[must_use]
    pub fn best(&self, media_types: &[&'static str]) -> &'static str {
        let quality = |media_type: &&'static str| self.quality(media_type);
        let better =
            |best: &'static str, other: &'static str| if quality(&other) > quality(&best) { other } else { best };
        media_types.iter().copied().reduce(better).unwrap_or_default()
    }
}

impl<S: Sync> FromRequestParts<S> for Accept {
    type Rejection = Infallible;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Self, Infallible> {
        Ok(Self::read(&parts.headers))
    }
}

/// Middleware: a read whose answer is of no accepted media type is a 406. Writes are answered anyway: they are done.
pub async fn negotiate(request: Request, next: Next) -> Response {
    let is_read = matches!(*request.method(), Method::GET | Method::HEAD);
    let accept = Accept::read(request.headers());
    let mut response = next.run(request).await;
    let status = response.status();
    if !is_read || !(status.is_success() || status == StatusCode::NOT_MODIFIED) {
        return response;
    }
    let media_type = response.headers().get(header::CONTENT_TYPE).and_then(|value| value.to_str().ok());
    if let Some(media_type) = media_type.filter(|media_type| !accept.accepts(media_type)) {
        let detail = format!("the resource is {media_type}, which the Accept header leaves out");
        response = Problem::new(ProblemType::NotAcceptable, detail).into_response();
    }
    response.headers_mut().append(header::VARY, HeaderValue::from_static("accept"));
    response
}

#[cfg(test)]
mod tests {
    use super::*;

    fn accept(value: &'static str) -> Accept {
        let mut headers = HeaderMap::new();
        headers.insert(header::ACCEPT, HeaderValue::from_static(value));
        Accept::read(&headers)
    }

    #[test]
    fn json_answers_whoever_accepts_anything() {
        for value in ["*/*", "application/*", "application/json", "application/geo+json", "text/html, */*;q=0.1", ""] {
            assert!(accept(value).accepts("application/geo+json"), "{value}");
        }
        for value in ["text/html", "image/png", "application/fg+json", "*/*;q=0", "application/geo+json;q=0, */*"] {
            assert!(!accept(value).accepts("application/geo+json"), "{value}");
        }
    }

    #[test]
    fn problems_are_accepted_by_everybody() {
        assert!(accept("application/problem+json").accepts("image/png"));
        assert!(!accept("application/problem+json, text/html").accepts("image/png"));
    }

    #[test]
    fn other_formats_are_for_those_who_ask_for_them() {
        let best = |value| accept(value).best(&["application/geo+json", "text/html", "text/csv"]);
        assert_eq!(best("text/csv"), "text/csv");
        assert_eq!(best("text/csv, */*;q=0.5"), "text/csv");
        assert_eq!(best("text/html,application/xhtml+xml,*/*;q=0.8"), "text/html");
        for value in ["*/*", "", "application/json", "image/png", "text/html;q=0.5, application/geo+json"] {
            assert_eq!(best(value), "application/geo+json", "{value}");
        }
    }
}
