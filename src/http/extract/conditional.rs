//! Conditional requests (RFC 9110, section 13): strong entity tags, 304 and 412.
//!
//! A tag names content, not bytes on the wire. Compressed answers must differ in their strong tags, so
//! [`tag_encodings`] appends the coding (`"7"` becomes `"7-zstd"`), and the headers read here take it off again.

use std::convert::Infallible;

use axum::extract::{FromRequestParts, Request};
use axum::http::request::Parts;
use axum::http::{HeaderMap, HeaderName, HeaderValue, StatusCode, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use uuid::Uuid;

use crate::app::MapContext;
use crate::blocking::off_the_runtime;
use crate::http::problem::{Problem, ProblemType};
use crate::store::MapState;

/// The codings of the compression layer.
const CODINGS: [&str; 3] = ["br", "gzip", "zstd"];

/// A strong entity tag.
#[derive(Debug, Clone)]
pub struct EntityTag {
    /// Without its quotes.
    text: String,
    /// The map in some state from which the content follows, by the address and what `Vary` names and by nothing else. An
    /// answer with such a tag has it among its extensions, too.
    moment: Option<MapMoment>,
}

/// A map in some state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MapMoment {
    /// The map.
    pub map: Uuid,
    /// Its state.
    pub state: MapState,
}

impl EntityTag {
    /// The tag of a resource that counts its versions.
    #[must_use]
    pub fn of_version(version: u64) -> Self {
        Self { text: version.to_string(), moment: None }
    }

    /// The tag of content that follows from these parts, and from the version of the service.
    #[must_use]
    pub fn of_content(parts: &[&str]) -> Self {
        let mut hasher = blake3::Hasher::new();
        for part in parts.iter().chain(&[env!("CARGO_PKG_VERSION")]) {
            hasher.update(&(part.len() as u64).to_le_bytes()).update(part.as_bytes());
        }
        Self { text: hasher.finalize().to_hex()[..32].to_owned(), moment: None }
    }

    /// The tag as the value of an `ETag` header.
    #[must_use]
    pub fn header(&self) -> HeaderValue {
        HeaderValue::try_from(format!("\"{}\"", self.text)).expect("tags are hexadecimal")
    }

    /// The tag of what an analysed map answers.
    #[must_use]
    pub fn of_map(kind: &str, context: &MapContext) -> Self {
        let versions = [context.record.version, context.semantics.version].map(|version| version.to_string());
        let tag = Self::of_content(&[kind, &context.analysis_id.to_string(), &versions[0], &versions[1]]);
        Self { moment: Some(MapMoment { map: context.record.id, state: context.state() }), ..tag }
    }

    /// The map in some state from which the content follows, and nothing else but the request.
    #[must_use]
    pub const fn moment(&self) -> Option<MapMoment> {
        self.moment
    }

    /// An answer with this tag, or 304 without a body where the client has it already.
    pub fn answer(&self, if_none_match: &IfNoneMatch, body: impl FnOnce() -> Response) -> Response {
        self.not_modified(if_none_match).unwrap_or_else(|| self.on(body()))
    }

    /// [`Self::answer`] with a body that takes longer than a moment: it is made off the runtime.
    ///
    /// # Errors
    /// Those of the body.
    pub async fn answer_computed(
        &self,
        if_none_match: &IfNoneMatch,
        body: impl FnOnce() -> Result<Response, Problem> + Send + 'static,
    ) -> Result<Response, Problem> {
        match self.not_modified(if_none_match) {
            Some(answer) => Ok(answer),
            None => Ok(self.on(off_the_runtime(body).await?)),
        }
    }

    /// 304 where the client has what this tag stands for.
    pub fn not_modified(&self, if_none_match: &IfNoneMatch) -> Option<Response> {
        let known = if_none_match.matched(self)?;
        Some(self.tagged(known, StatusCode::NOT_MODIFIED.into_response()))
    }

    /// An answer with this tag.
    pub fn on(&self, response: Response) -> Response {
        self.tagged(self.header(), response)
    }

    fn tagged(&self, tag: HeaderValue, mut response: Response) -> Response {
        response.headers_mut().insert(header::ETAG, tag);
        response.headers_mut().insert(header::CACHE_CONTROL, HeaderValue::from_static("no-cache"));
        if self.moment.is_some() {
            response.extensions_mut().insert(self.clone());
        }
        response
    }
}

/// One tag of a request.
#[derive(Debug, Clone, PartialEq, Eq)]
struct RequestTag {
    /// Without quotes and coding.
    plain: String,
    weak: bool,
    /// As it was sent.
    text: String,
}

/// The tags of `If-Match` or `If-None-Match`.
#[derive(Debug, Clone, PartialEq, Eq)]
enum Tags {
    Absent,
    Any,
    Listed(Vec<RequestTag>),
}

impl Tags {
    fn read(headers: &HeaderMap, name: HeaderName) -> Self {
        let mut values = headers.get_all(name).iter().filter_map(|value| value.to_str().ok()).peekable();
        if values.peek().is_none() {
            return Self::Absent;
        }
        let entries: Vec<&str> = values.flat_map(|value| value.split(',')).map(str::trim).collect();
        if entries == ["*"] {
            return Self::Any;
        }
        // A tag of this service holds no comma and no quote: what is not one of ours cannot match.
        Self::Listed(entries.into_iter().filter_map(RequestTag::read).collect())
    }
}

impl RequestTag {
    fn read(text: &str) -> Option<Self> {
        let (weak, quoted) = text.strip_prefix("W/").map_or((false, text), |rest| (true, rest));
        let opaque = quoted.strip_prefix('"')?.strip_suffix('"')?;
        let plain =
            opaque.rsplit_once('-').filter(|(_, coding)| CODINGS.contains(coding)).map_or(opaque, |pair| pair.0);
        Some(Self { plain: plain.to_owned(), weak, text: text.to_owned() })
    }
}

/// `If-None-Match` of a read.
#[derive(Debug, Clone)]
pub struct IfNoneMatch(Tags);

impl IfNoneMatch {
    /// The header of a request.
    pub fn read(headers: &HeaderMap) -> Self {
        Self(Tags::read(headers, header::IF_NONE_MATCH))
    }

    /// Whether the client has what this tag stands for.
    pub fn has(&self, current: &EntityTag) -> bool {
        self.matched(current).is_some()
    }

    /// The tag that the client has, as it sent it (weak comparison).
    pub fn matched(&self, current: &EntityTag) -> Option<HeaderValue> {
        match &self.0 {
            Tags::Absent => None,
            Tags::Any => Some(current.header()),
            Tags::Listed(tags) => {
                let found = tags.iter().find(|request| request.plain == current.text)?;
                HeaderValue::try_from(found.text.trim_start_matches("W/")).ok()
            }
        }
    }
}

impl<S: Sync> FromRequestParts<S> for IfNoneMatch {
    type Rejection = Infallible;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Self, Infallible> {
        Ok(Self::read(&parts.headers))
    }
}

/// `If-Match` of a write.
#[derive(Debug, Clone)]
pub struct IfMatch(Tags);

impl IfMatch {
    /// The version that the write is meant for, given the tag and the version in force; `None` without a header.
    /// Whether it is still in force when the write is made, is for the store to say.
    ///
    /// # Errors
    /// 412 when the header names other tags only (strong comparison).
    pub fn against(&self, current: &EntityTag, version: u64) -> Result<Option<u64>, Problem> {
        match &self.0 {
            Tags::Absent => Ok(None),
            Tags::Any => Ok(Some(version)),
            Tags::Listed(tags) if tags.iter().any(|request| !request.weak && request.plain == current.text) => {
                Ok(Some(version))
            }
            Tags::Listed(_) => {
                let detail = format!(
                    "the resource is at \"{}\" (version {version}), not at what If-Match names: read it again",
                    current.text
                );
                Err(Problem::new(ProblemType::PreconditionFailed, detail))
            }
        }
    }
}

impl<S: Sync> FromRequestParts<S> for IfMatch {
    type Rejection = Infallible;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Self, Infallible> {
        Ok(Self(Tags::read(&parts.headers, header::IF_MATCH)))
    }
}

/// Middleware around the compression: tells the codings of an answer apart by their strong tags. A 304 names what the answer
/// varies by, as the answer does (RFC 9110, 15.4.5).
pub async fn tag_encodings(request: Request, next: Next) -> Response {
    let mut response = next.run(request).await;
    if response.status() == StatusCode::NOT_MODIFIED {
        response.headers_mut().append(header::VARY, HeaderValue::from_static("accept-encoding"));
    }
    let headers = response.headers();
    let coding = headers.get(header::CONTENT_ENCODING).and_then(|value| value.to_str().ok());
    let opaque = headers.get(header::ETAG).and_then(|value| value.to_str().ok()?.strip_suffix('"'));
    if let (Some(coding), Some(opaque)) = (coding, opaque)
        && let Ok(tag) = HeaderValue::try_from(format!("{opaque}-{coding}\""))
    {
        response.headers_mut().insert(header::ETAG, tag);
    }
    response
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tags(value: Option<&'static str>) -> Tags {
        let mut headers = HeaderMap::new();
        if let Some(value) = value {
            headers.insert(header::IF_MATCH, HeaderValue::from_static(value));
        }
        Tags::read(&headers, header::IF_MATCH)
    }

    #[test]
    fn a_write_names_the_version_it_was_made_from() {
        let against = |value| {
            IfMatch(tags(value))
                .against(&EntityTag::of_version(7), 7)
                .map_err(|problem| problem.kind().status().as_u16())
        };
        assert_eq!(against(None), Ok(None));
        assert_eq!(against(Some("*")), Ok(Some(7)));
        assert_eq!(against(Some("\"7\"")), Ok(Some(7)));
        assert_eq!(against(Some("\"5\", \"7-zstd\"")), Ok(Some(7)));
        assert_eq!(against(Some("\"5\"")), Err(412));
        assert_eq!(against(Some("W/\"7\"")), Err(412), "weak tags do not match strongly");
        assert_eq!(against(Some("7")), Err(412), "a tag without quotes is none");
    }

    #[test]
    fn a_read_that_is_up_to_date_gets_its_own_tag_back() {
        let current = EntityTag::of_version(7);
        let matched = |value| IfNoneMatch(tags(value)).matched(&current);
        assert_eq!(matched(None), None);
        assert_eq!(matched(Some("\"6\"")), None);
        assert_eq!(matched(Some("*")).expect("any"), "\"7\"");
        assert_eq!(matched(Some("W/\"7-gzip\"")).expect("weak comparison"), "\"7-gzip\"");
    }

    #[test]
    fn content_tags_tell_parts_apart() {
        assert_ne!(EntityTag::of_content(&["a", "bc"]).text, EntityTag::of_content(&["ab", "c"]).text);
    }
}
