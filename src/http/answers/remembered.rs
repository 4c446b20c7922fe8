//! An answer, with what it takes to give it again.

use axum::body::{Body, Bytes};
use axum::extract::MatchedPath;
use axum::http::response::Parts;
use axum::http::{HeaderMap, HeaderName, StatusCode, header};
use axum::response::Response;

use crate::http::extract::conditional::{EntityTag, IfNoneMatch};

/// Headers of content, which a 304 has none of.
const OF_CONTENT: [HeaderName; 5] =
    [header::CONTENT_TYPE, header::CONTENT_LENGTH, header::CONTENT_ENCODING, header::CONTENT_DISPOSITION, header::LINK];

/// An answer, or no more than its tag where only a 304 was given.
#[derive(Debug)]
pub struct Remembered {
    /// The tag, without coding.
    pub tag: EntityTag,
    route: Option<MatchedPath>,
    not_modified: HeaderMap,
    whole: Option<(HeaderMap, Bytes)>,
}

impl Remembered {
    /// Keeps an answer of this tag: one with content, or a 304.
    pub fn of(tag: EntityTag, parts: &Parts, body: &Bytes) -> Self {
        let mut not_modified = parts.headers.clone();
        for name in OF_CONTENT {
            not_modified.remove(name);
        }
        let whole = (parts.status == StatusCode::OK).then(|| (parts.headers.clone(), body.clone()));
        Self { tag, route: parts.extensions.get().cloned(), not_modified, whole }
    }

    /// The answer to a client that has what it says.
    pub fn answer(&self, if_none_match: &IfNoneMatch) -> Option<Response> {
        let mut response = if let Some(known) = if_none_match.matched(&self.tag) {
            let mut response = Response::new(Body::empty());
            *response.status_mut() = StatusCode::NOT_MODIFIED;
            *response.headers_mut() = self.not_modified.clone();
            response.headers_mut().insert(header::ETAG, known);
            response
        } else {
            let (headers, body) = self.whole.as_ref()?;
            let mut response = Response::new(Body::from(body.clone()));
            *response.headers_mut() = headers.clone();
            response
        };
        if let Some(route) = self.route.clone() {
            response.extensions_mut().insert(route);
        }
        Some(response)
    }

    /// Its bytes in memory, about: headers have some hundred each time.
    pub fn bytes(&self) -> usize {
        const HEADERS: usize = 4_096;
        HEADERS + self.whole.as_ref().map_or(0, |(_, body)| body.len())
    }
}
