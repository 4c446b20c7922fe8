//! A refusal, and the problem detail that it becomes.

use axum::http::header;
use axum::response::{IntoResponse, Response};
use serde::Serialize;
use utoipa::ToSchema;

use super::types::ProblemType;
use crate::app::{AppError, FieldProblem};
use crate::ingest::Refusal;

/// One thing that is wrong: in the body (`pointer`) or in the query (`parameter`).
#[derive(Debug, Clone, PartialEq, Eq, Serialize, ToSchema)]
pub struct ProblemItem {
    /// JSON pointer to the culprit in the body, or to the part of a form.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(example = "/categorization/k")]
    pub pointer: Option<String>,
    /// The query parameter.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub parameter: Option<String>,
    /// What is wrong and what would be right.
    #[schema(example = "0 is outside 2 to 32")]
    pub detail: String,
}

impl ProblemItem {
    fn message(&self) -> String {
        match self.parameter.as_ref().or(self.pointer.as_ref()) {
            Some(name) => format!("{name}: {}", self.detail),
            None => self.detail.clone(),
        }
    }
}

/// A refusal.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    kind: ProblemType,
    detail: String,
    position: Option<[f64; 2]>,
    errors: Vec<ProblemItem>,
    retry_after_s: Option<u32>,
    challenge: Option<String>,
}

impl Problem {
    /// What is wrong, in one line for people.
    #[must_use]
    pub fn message(&self) -> String {
        let items: Vec<String> = self.errors.iter().map(ProblemItem::message).collect();
        if items.is_empty() { self.detail.clone() } else { items.join("; ") }
    }

    /// A refusal with its reason, for people.
    #[must_use]
    pub fn new(kind: ProblemType, detail: impl Into<String>) -> Self {
        Self { kind, detail: detail.into(), position: None, errors: Vec::new(), retry_after_s: None, challenge: None }
    }

    /// A query parameter that is unknown or wrong.
    #[must_use]
    pub fn parameter(name: &str, detail: impl Into<String>) -> Self {
        let detail = detail.into();
        let item = ProblemItem { pointer: None, parameter: Some(name.to_owned()), detail: detail.clone() };
        Self { errors: vec![item], ..Self::new(ProblemType::BadParameter, format!("{name}: {detail}")) }
    }

    /// Content that is wrong at a JSON pointer.
    #[must_use]
    pub fn invalid(pointer: impl Into<String>, detail: impl Into<String>) -> Self {
        Self::at(ProblemType::Invalid, pointer, detail)
    }

    /// A refusal about one place of the body.
    #[must_use]
    pub fn at(kind: ProblemType, pointer: impl Into<String>, detail: impl Into<String>) -> Self {
        let (pointer, detail) = (pointer.into(), detail.into());
        let item = ProblemItem { pointer: Some(pointer), parameter: None, detail: detail.clone() };
        Self { errors: vec![item], ..Self::new(kind, detail) }
    }

    /// Nothing is there.
    #[must_use]
    pub fn not_found(detail: impl Into<String>) -> Self {
        Self::new(ProblemType::NotFound, detail)
    }

    /// Tells the client how to sign in (RFC 6750, 3).
    pub(super) fn challenge(mut self, parameters: &str) -> Self {
        self.challenge = Some(format!("Bearer realm=\"stillage\"{parameters}"));
        self
    }

    /// Tells the client when to come back.
    #[must_use]
    pub const fn retry_after(mut self, seconds: u32) -> Self {
        self.retry_after_s = Some(seconds);
        self
    }

    /// Tells where on the map the reason lies, in the coordinates of the request.
    #[must_use]
    pub const fn on_map(mut self, position: Option<[f64; 2]>) -> Self {
        self.position = position;
        self
    }

    /// Rewrites the pointers: the shape of the request differs from the shape that was checked.
    #[must_use]
    pub fn map_pointers(mut self, rewrite: impl Fn(&str) -> String) -> Self {
        for item in &mut self.errors {
            item.pointer = item.pointer.as_deref().map(&rewrite);
        }
        self
    }

    /// A refusal of parameters as one of the members of a body that have their names.
    #[must_use]
    pub fn in_body(mut self) -> Self {
        for item in &mut self.errors {
            item.pointer = item.parameter.take().map(|name| format!("/{name}")).or(item.pointer.take());
        }
        if self.kind == ProblemType::BadParameter {
            self.kind = ProblemType::Invalid;
        }
        self
    }

    /// The kind of the problem.
    #[must_use]
    pub const fn kind(&self) -> ProblemType {
        self.kind
    }

    /// What is wrong, piece by piece.
    #[cfg(test)]
    pub fn errors(&self) -> &[ProblemItem] {
        &self.errors
    }

    /// The problem detail of a request to this path.
    #[must_use]
    pub fn document(&self, instance: &str) -> ProblemDocument {
        ProblemDocument {
            r#type: self.kind.uri(),
            title: self.kind.title().to_owned(),
            status: self.kind.status().as_u16(),
            detail: self.detail.clone(),
            instance: instance.to_owned(),
            position: self.position,
            errors: self.errors.clone(),
        }
    }
}

/// A problem detail as it is sent.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Problem)]
pub struct ProblemDocument {
    /// Stable URI of the kind of problem, relative to the service. It can be fetched.
    #[schema(format = "uri-reference", example = "/problems/not-found")]
    r#type: String,
    /// The kind, for people.
    #[schema(example = "There is no such resource")]
    title: String,
    /// The HTTP status.
    #[schema(example = 404)]
    status: u16,
    /// What is wrong this time.
    #[schema(example = "there is no map 019ab3c2-0000-7000-8000-000000000000")]
    detail: String,
    /// The path of the request.
    #[schema(format = "uri-reference", example = "/v1/maps/019ab3c2-0000-7000-8000-000000000000")]
    instance: String,
    /// Where on the map a route fails, or the nearest place that would do: x and y, or longitude and latitude, in the
    /// coordinates of the request.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(required = false, example = json!([12.05, -7.35]))]
    position: Option<[f64; 2]>,
    /// What is wrong, piece by piece, where that is known.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    errors: Vec<ProblemItem>,
}

impl IntoResponse for Problem {
    /// The bare response: [`render()`](super::render()) gives it its body.
    fn into_response(self) -> Response {
        let mut response = self.kind.status().into_response();
        if let Some(seconds) = self.retry_after_s {
            response.headers_mut().insert(header::RETRY_AFTER, seconds.into());
        }
        if let Some(challenge) = self.challenge.as_ref().and_then(|challenge| challenge.parse().ok()) {
            response.headers_mut().insert(header::WWW_AUTHENTICATE, challenge);
        }
        response.extensions_mut().insert(self);
        response
    }
}

impl From<AppError> for Problem {
    fn from(error: AppError) -> Self {
        let detail = error.to_string();
        match error {
            AppError::NotFound { .. } => Self::not_found(detail),
            AppError::NotAnalysed { map, job } => Self::new(
                ProblemType::NotAnalysed,
                match job {
                    Some(job) => format!("map {map} has no finished analysis yet: see /v1/jobs/{job}"),
                    None => format!("map {map} has no finished analysis yet"),
                },
            ),
            AppError::Invalid { fields, .. } => {
                let item =
                    |FieldProblem { pointer, detail }| ProblemItem { pointer: Some(pointer), parameter: None, detail };
                Self { errors: fields.into_iter().map(item).collect(), ..Self::new(ProblemType::Invalid, detail) }
            }
            AppError::Ingest(error) => {
                let kind = match error.refusal {
                    Refusal::TooLarge => ProblemType::TooLarge,
                    Refusal::UnsupportedFormat => ProblemType::UnsupportedMediaType,
                    Refusal::Invalid => ProblemType::Invalid,
                };
                Self::at(kind, error.pointer, error.message)
            }
            AppError::Unauthorized(detail) => Self::invalid_key(detail),
            AppError::PreconditionFailed { .. } => Self::new(ProblemType::PreconditionFailed, detail),
            AppError::PreconditionRequired => Self::new(ProblemType::PreconditionRequired, detail),
            AppError::NotSameSite(_) => Self::new(ProblemType::NotSameSite, detail),
            AppError::Conflict(_) => Self::new(ProblemType::Conflict, detail),
            AppError::TooLarge(_) => Self::new(ProblemType::TooLarge, detail),
            AppError::Busy { retry_after_s } => Self::new(ProblemType::Busy, detail).retry_after(retry_after_s),
            AppError::TooManyJobs { retry_after_s, .. } => {
                Self::new(ProblemType::TooManyJobs, detail).retry_after(retry_after_s)
            }
            AppError::OverQuota(_) => Self::new(ProblemType::OverQuota, detail),
            AppError::NoSpace => Self::new(ProblemType::NoSpace, detail).retry_after(60),
            AppError::Unavailable | AppError::BeingMended(_) => {
                Self::new(ProblemType::Unavailable, detail).retry_after(5)
            }
            AppError::Damaged(_) => Self::new(ProblemType::Damaged, detail),
            AppError::Internal(source) => {
                tracing::error!(error = &*source, "a request failed");
                Self::new(ProblemType::Internal, "the service failed: its log says why, under this request's id")
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use axum::http::StatusCode;

    use super::*;

    #[test]
    fn problems_of_the_application_keep_their_status_and_pointers() {
        let fields = vec![FieldProblem { pointer: "/labels/0/id".into(), detail: "is used twice".into() }];
        let problem = Problem::from(AppError::Invalid { detail: "the rule set is wrong".into(), fields });
        assert_eq!(problem.kind().status(), StatusCode::UNPROCESSABLE_ENTITY);
        expect_test::expect![[r#"{"type":"/problems/invalid","title":"The content is invalid","status":422,"detail":"the rule set is wrong","instance":"/v1/rule-sets","errors":[{"pointer":"/labels/0/id","detail":"is used twice"}]}"#]]
            .assert_eq(&serde_json::to_string(&problem.document("/v1/rule-sets")).expect("can be written"));
    }

    #[test]
    fn a_full_queue_says_when_to_come_back() {
        let response = Problem::from(AppError::Busy { retry_after_s: 7 }).into_response();
        assert_eq!(response.status(), StatusCode::SERVICE_UNAVAILABLE);
        assert_eq!(response.headers()[header::RETRY_AFTER], "7");
    }

    #[test]
    fn the_uris_of_the_types_are_unique() {
        let mut uris: Vec<String> = ProblemType::ALL.iter().map(|kind| kind.uri()).collect();
        uris.sort();
        uris.dedup();
        assert_eq!(uris.len(), ProblemType::ALL.len());
    }
}
