//! What of a request decides the answer.

use axum::extract::Request;
use axum::http::{HeaderName, Method, Version, header};

/// Headers that decide what is answered, in which format and coding, and with which links.
const DECIDING: [HeaderName; 8] = [
    header::HOST,
    header::ACCEPT,
    header::ACCEPT_ENCODING,
    header::FORWARDED,
    HeaderName::from_static("x-forwarded-proto"),
    HeaderName::from_static("x-forwarded-host"),
    HeaderName::from_static("x-forwarded-port"),
    HeaderName::from_static("x-forwarded-prefix"),
];
/// Headers with which a request is answered anew each time.
const UNUSUAL: [HeaderName; 4] =
    [header::RANGE, header::IF_MATCH, header::CONTENT_ENCODING, HeaderName::from_static("content-transfer-encoding")];

/// A read, as far as it decides the answer: address and headers, line by line. Neither can hold the end of a line.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Question(Box<str>);

impl Question {
    /// The question of a request; `None` where its answer cannot be given again.
    pub fn of(request: &Request) -> Option<Self> {
        let (uri, headers) = (request.uri(), request.headers());
        let is_usual = matches!(*request.method(), Method::GET | Method::HEAD)
            && request.version() == Version::HTTP_11
            && uri.authority().is_none()
            && uri.path().starts_with("/v1/maps/")
            && !UNUSUAL.iter().any(|name| headers.contains_key(name));
        let mut text = uri.path_and_query().filter(|_| is_usual)?.as_str().to_owned();
        for name in DECIDING {
            // A line for each header, and one more for each further value.
            for value in headers.get_all(&name) {
                text.push('\t');
                text.push_str(value.to_str().ok()?);
            }
            text.push('\n');
        }
        Some(Self(text.into_boxed_str()))
    }

    /// Its bytes in memory.
    pub const fn bytes(&self) -> usize {
        self.0.len()
    }
}

#[cfg(test)]
mod tests {
    use axum::body::Body;
    use axum::http::request::Builder;

    use super::*;

    fn question(change: impl FnOnce(Builder) -> Builder) -> Option<Question> {
        let request = Request::builder().uri("/v1/maps/7?f=json").header("host", "robots");
        Question::of(&change(request).body(Body::empty()).expect("a request"))
    }

    #[test]
    fn questions_differ_by_what_decides_the_answer() {
        let plain = question(|request| request);
        assert!(plain.is_some());
        assert_eq!(plain, question(|request| request.header("user-agent", "x").header("if-none-match", "\"7\"")));
        for (name, value) in [("accept", "text/csv"), ("accept-encoding", "gzip"), ("x-forwarded-host", "other")] {
            assert_ne!(plain, question(|request| request.header(name, value)), "{name}");
        }
        assert_ne!(plain, question(|request| request.header("host", "second")));
        assert_ne!(plain, question(|request| request.uri("/v1/maps/7?f=html")));
        let swapped = |accept, coding| question(|it| it.header("accept", accept).header("accept-encoding", coding));
        assert_ne!(swapped("a", "b"), swapped("b", "a"));
        assert_eq!(plain, question(|request| request.method("HEAD")), "it is answered as GET is, without content");
    }

    #[test]
    fn writes_parts_and_other_resources_are_no_such_questions() {
        assert_eq!(question(|request| request.method("PUT")), None);
        assert_eq!(question(|request| request.header("range", "bytes=0-9")), None);
        assert_eq!(question(|request| request.uri("/metrics")), None);
    }
}
