//! JSON bodies, and where and why they do not fit.

use std::error::Error;

use axum::extract::rejection::JsonRejection;
use axum::extract::{FromRequest, Request};
use axum::http::HeaderMap;
use serde::de::{DeserializeOwned, IgnoredAny};
use serde::{Deserialize, Deserializer};

use super::plain_words::plain;
use super::whole_body::{body, content_type};
use crate::http::problem::{Problem, ProblemType};

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
            Err(Problem::invalid(format!("{pointer}{}", json_pointer(&path)), message))
        }
        // Where a word must stand, its reader takes a number for an error of the text.
        Err(error) if serde_json::from_slice::<IgnoredAny>(bytes).is_ok() => Err(Problem::invalid(
            format!("{pointer}{}", json_pointer(&path_and_message(&error).0)),
            "is none of the values that it may be",
        )),
        Err(error) => Err(Problem::at(ProblemType::BadRequest, pointer, path_and_message(&error).1)),
    }
}

/// Splits the message of a deserialization error into the path of its culprit, empty where it is unknown, and what is wrong,
/// in plain words. axum keeps track of the path and puts it in front, and so do values that are read in a second step.
pub fn path_and_message(rejection: &(dyn Error + 'static)) -> (String, String) {
    let innermost =
        std::iter::successors(rejection.source(), |&cause| cause.source().filter(|_| cause.is::<axum::Error>()));
    let text = innermost.last().map_or_else(|| rejection.to_string(), ToString::to_string);
    let (mut path, mut message) = (String::new(), text.as_str());
    while let Some((head, rest)) = message.split_once(": ").filter(|(head, _)| is_path(head)) {
        let between = if path.is_empty() { "" } else { "." };
        path = format!("{path}{between}{head}");
        message = rest;
    }
    (path, shortened(&plain(message)))
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
        expect_test::expect![[
            r#"422 Unprocessable Entity /options/labels/1/a~1b: must be a whole number from 0 to 255, and is the text "x""#
        ]]
        .assert_eq(&refusal(r#"{"labels":[{},{"a/b":"x"}]}"#));
        expect_test::expect!["422 Unprocessable Entity /options/color: color is not known here: it is labels"]
            .assert_eq(&refusal(r#"{"color":1}"#));
        let long = refusal(&format!(r#"{{"labels":"{}"}}"#, "x".repeat(10_000)));
        assert!(long.len() < 400 && long.contains("xxx ... xxx"), "{long}");
        expect_test::expect!["422 Unprocessable Entity /options: needs the member labels"].assert_eq(&refusal("{}"));
        expect_test::expect!["422 Unprocessable Entity /options: must be an object"].assert_eq(&refusal(" [[]]"));
        expect_test::expect!["400 Bad Request /options: is no JSON: it ends too early (line 1, column 1)"]
            .assert_eq(&refusal("{"));
    }
}
