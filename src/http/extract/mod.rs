//! What handlers take from a request, typed; what cannot be taken is a problem.

pub mod bbox;
mod caller;
pub mod coding;
pub mod conditional;
pub mod crs;
pub mod datetime;
pub mod form;
pub mod format;
pub mod negotiation;
pub mod prefer;

use std::error::Error;

use axum::body::Bytes;
use axum::extract::rejection::{BytesRejection, JsonRejection};
use axum::extract::{FromRequest, FromRequestParts, Request};
use axum::http::request::Parts;
use axum::http::{HeaderMap, StatusCode, Uri, header};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Deserializer};
use utoipa::IntoParams;

use crate::http::problem::{Problem, ProblemType};
use crate::views::id::Id;

/// Typed path parameters: an id that cannot be valid names nothing, so it is a 404.
#[derive(Debug)]
pub struct Path<T>(pub T);

impl<S: Send + Sync, T: DeserializeOwned + Send> FromRequestParts<S> for Path<T> {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Problem> {
        let path = axum::extract::Path::from_request_parts(parts, state).await;
        let axum::extract::Path(value) =
            path.map_err(|_| Problem::not_found(format!("there is nothing at {}", parts.uri.path())))?;
        Ok(Self(value))
    }
}

/// `/v1/maps/{mapId}`
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
#[serde(rename_all = "camelCase")]
pub struct MapPath {
    /// The map.
    pub map_id: Id,
}

/// Typed query parameters. Which names exist at all is checked before, by [`crate::http::guard::known_parameters`].
#[derive(Debug)]
pub struct Query<T>(pub T);

impl<S: Sync, T: DeserializeOwned> FromRequestParts<S> for Query<T> {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Self, Problem> {
        Self::read(&parts.uri)
    }
}

impl<T: DeserializeOwned> Query<T> {
    /// Reads the query of an address.
    pub fn read(uri: &Uri) -> Result<Self, Problem> {
        match axum::extract::Query::try_from_uri(uri) {
            Ok(axum::extract::Query(value)) => Ok(Self(value)),
            Err(rejection) => {
                let (path, message) = path_and_message(&rejection);
                Err(match path.as_deref() {
                    Some(name) => Problem::parameter(name, message),
                    None => Problem::new(ProblemType::BadParameter, message),
                })
            }
        }
    }
}

/// How many entries a list may hold; `DEFAULT` when nothing is said. Whoever asks for more than `MAX` gets `MAX` (OGC API
/// Features part 1, requirement 22).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(try_from = "String")]
pub struct Limit<const DEFAULT: u32, const MAX: u32>(pub u32);

impl<const DEFAULT: u32, const MAX: u32> Default for Limit<DEFAULT, MAX> {
    fn default() -> Self {
        Self(DEFAULT)
    }
}

impl<const DEFAULT: u32, const MAX: u32> TryFrom<String> for Limit<DEFAULT, MAX> {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        let is_number = !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
        // More digits than fit are more than the most.
        let limit = is_number.then(|| text.parse().unwrap_or(MAX)).filter(|limit| *limit > 0);
        limit
            .map(|limit| Self(limit.min(MAX)))
            .ok_or_else(|| format!("must be a whole number from 1 (at most {MAX} are answered)"))
    }
}

/// Limit of the lists of maps and jobs.
pub type ListLimit = Limit<100, 1_000>;

/// Paging of a list.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub struct Paging {
    /// Most entries of the answer, and never more than 1,000.
    #[serde(default)]
    #[param(value_type = Option<u32>, minimum = 1, default = 100)]
    pub limit: ListLimit,
    /// Id of the last entry of the page before: taken from the `next` link.
    pub after: Option<Id>,
}

/// A JSON body. Its errors carry a JSON pointer: 400 what is not JSON, 422 what does not fit.
#[derive(Debug)]
pub struct JsonBody<T>(pub T);

impl<S: Send + Sync, T: DeserializeOwned> FromRequest<S> for JsonBody<T> {
    type Rejection = Problem;

    async fn from_request(request: Request, state: &S) -> Result<Self, Problem> {
        if !is_json(request.headers()) {
            let detail = "the body must be JSON: send Content-Type: application/json";
            return Err(Problem::new(ProblemType::UnsupportedMediaType, detail));
        }
        let bytes = body(request, state).await?;
        parse_json("", &bytes).map(Self)
    }
}

/// Whether the body says that it is JSON.
#[must_use]
pub fn is_json(headers: &HeaderMap) -> bool {
    let essence = content_type(headers);
    essence == "application/json" || (essence.starts_with("application/") && essence.ends_with("+json"))
}

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
    match causes.find_map(|cause| cause.downcast_ref::<crate::http::guard::TooSlow>()) {
        Some(slow) => Problem::new(ProblemType::Timeout, slow.to_string()),
        None => Problem::new(
            ProblemType::BadRequest,
            "the body cannot be read to its end: it breaks off, or it is not what its headers say",
        ),
    }
}

/// Reads JSON from a body, or from the part of a form that `pointer` names.
///
/// # Errors
/// 400 what is not JSON, 422 what does not fit, with the JSON pointer of the culprit.
pub fn parse_json<T: DeserializeOwned>(pointer: &str, bytes: &[u8]) -> Result<T, Problem> {
    // serde would read an array as the members of a structure in their order.
    if bytes.trim_ascii_start().first() == Some(&b'[') {
        return Err(Problem::invalid(pointer, "must be an object"));
    }
    match axum::Json::from_bytes(bytes) {
        Ok(axum::Json(value)) => Ok(value),
        Err(JsonRejection::JsonDataError(error)) => {
            let (path, message) = path_and_message(&error);
            Err(Problem::invalid(
                format!("{pointer}{}", path.as_deref().map(json_pointer).unwrap_or_default()),
                message,
            ))
        }
        Err(error) => Err(Problem::at(ProblemType::BadRequest, pointer, path_and_message(&error).1)),
    }
}

/// Splits the message of a deserialization error: axum keeps track of the path and puts it in front.
fn path_and_message(rejection: &(dyn Error + 'static)) -> (Option<String>, String) {
    let innermost =
        std::iter::successors(rejection.source(), |&cause| cause.source().filter(|_| cause.is::<axum::Error>()));
    let text = innermost.last().map_or_else(|| rejection.to_string(), ToString::to_string);
    match text.split_once(": ") {
        Some((path, message)) if is_path(path) => (Some(path.to_owned()), shortened(message)),
        _ => (None, shortened(&text)),
    }
}

/// A message without the middle of what it repeats of the input.
fn shortened(message: &str) -> String {
    /// Longest message that is told whole, and what is kept of a longer one at either end, characters.
    const WHOLE: usize = 300;
    const KEPT: usize = 120;
    let count = message.chars().count();
    if count <= WHOLE {
        return message.to_owned();
    }
    let (start, end) = (message.chars().take(KEPT), message.chars().skip(count - KEPT));
    start.chain(" ... ".chars()).chain(end).collect()
}

/// Whether the head of a message is a path (`labels[0].id`) and not the first words of a sentence.
fn is_path(head: &str) -> bool {
    !head.is_empty() && !head.contains(char::is_whitespace)
}

/// A name as a step of a JSON pointer (RFC 6901).
#[must_use]
pub fn pointer_step(name: &str) -> String {
    name.replace('~', "~0").replace('/', "~1")
}

/// `labels[0].id` as a JSON pointer, `/labels/0/id`.
fn json_pointer(path: &str) -> String {
    let steps = pointer_step(path).replace('[', ".").replace(']', "");
    steps.split('.').filter(|step| !step.is_empty()).flat_map(|step| ["/", step]).collect()
}

/// Reads a member that may be absent (`None`), null (`Some(None)`) or a value: the three states of a merge patch.
///
/// # Errors
/// Those of the value.
#[allow(clippy::option_option, reason = "a merge patch tells absent from null")]
pub fn present<'de, D: Deserializer<'de>, T: Deserialize<'de>>(deserializer: D) -> Result<Option<Option<T>>, D::Error> {
    Option::deserialize(deserializer).map(Some)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Body {
        #[serde(rename = "labels")]
        _labels: Vec<BTreeMap<String, u8>>,
    }

    fn refusal(json: &str) -> String {
        let problem = parse_json::<Body>("/options", json.as_bytes()).expect_err("is refused");
        let item = &problem.errors()[0];
        format!("{} {}: {}", problem.kind().status(), item.pointer.as_deref().unwrap_or_default(), item.detail)
    }

    #[test]
    fn errors_in_json_carry_a_pointer() {
        expect_test::expect![[r#"422 Unprocessable Entity /options/labels/1/a~1b: invalid type: string "x", expected u8 at line 1 column 24"#]]
            .assert_eq(&refusal(r#"{"labels":[{},{"a/b":"x"}]}"#));
        expect_test::expect![
            "422 Unprocessable Entity /options/color: unknown field `color`, expected `labels` at line 1 column 8"
        ]
        .assert_eq(&refusal(r#"{"color":1}"#));
        let long = refusal(&format!(r#"{{"labels":"{}"}}"#, "x".repeat(10_000)));
        assert!(long.len() < 400 && long.contains("xxx ... xxx"), "{long}");
        expect_test::expect!["422 Unprocessable Entity /options: missing field `labels` at line 1 column 2"]
            .assert_eq(&refusal("{}"));
        expect_test::expect!["422 Unprocessable Entity /options: must be an object"].assert_eq(&refusal(" [[]]"));
        expect_test::expect!["400 Bad Request /options: EOF while parsing an object at line 1 column 1"]
            .assert_eq(&refusal("{"));
    }

    #[tokio::test]
    async fn errors_in_the_query_name_the_parameter() {
        let paging = |query: &str| {
            let request = Request::builder().uri(format!("/v1/maps?{query}")).body(()).expect("is a request");
            let mut parts = request.into_parts().0;
            async move { Query::<Paging>::from_request_parts(&mut parts, &()).await }
        };
        assert_eq!(paging("").await.expect("is right").0.limit.0, 100);
        assert_eq!(paging("limit=7").await.expect("is right").0.limit.0, 7);
        for many in ["limit=1001", "limit=99999999999999999999"] {
            assert_eq!(paging(many).await.expect("is right").0.limit.0, 1000, "{many}");
        }
        for wrong in [
            "limit=0",
            "limit=-1",
            "limit=+1",
            "limit=1.5",
            "limit=x",
            "limit=",
            "after=1",
            "limit=1&limit=2",
            "bogus=1",
        ] {
            let problem = paging(wrong).await.expect_err(wrong);
            assert_eq!(problem.kind(), ProblemType::BadParameter, "{wrong}");
        }
        let problem = paging("limit=0").await.expect_err("is refused");
        assert_eq!(problem.errors()[0].parameter.as_deref(), Some("limit"));
        assert_eq!(problem.errors()[0].detail, "must be a whole number from 1 (at most 1000 are answered)");
    }
}
