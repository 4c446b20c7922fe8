//! Every refusal of the service is a problem detail (RFC 9457).
//!
//! A [`Problem`] travels in the extensions of its response; [`render`] writes the body once, at the outside, where the
//! path of the request is known. The same place clothes the bare refusals of the framework (405, 413 ...), so that no
//! error leaves in another shape.

use axum::extract::{Path, Request};
use axum::http::{HeaderValue, StatusCode, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use serde::Serialize;
use stillage_core::routing::NoRoute;
use utoipa::ToSchema;

use crate::app::{AppError, FieldProblem};
use crate::ingest::Refusal;

/// Media type of problem details.
pub const PROBLEM_JSON: &str = "application/problem+json";

macro_rules! problem_types {
    ($($(#[$doc:meta])* $name:ident = $slug:literal, $status:ident, $title:literal;)*) => {
        /// The kinds of problems: stable URIs for programs.
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum ProblemType {
            $($(#[$doc])* $name,)*
        }

        impl ProblemType {
            /// All of them.
            pub const ALL: &[Self] = &[$(Self::$name),*];

            /// Last part of the type's URI, status and title.
            const fn row(self) -> (&'static str, StatusCode, &'static str) {
                match self {
                    $(Self::$name => ($slug, StatusCode::$status, $title),)*
                }
            }
        }
    };
}

problem_types! {
    /// The request is not understood.
    BadRequest = "bad-request", BAD_REQUEST, "The request is malformed";
    /// A query parameter is unknown or wrong.
    BadParameter = "bad-parameter", BAD_REQUEST, "A parameter is unknown or has a bad value";
    /// A page of another site tried to write.
    CrossOrigin = "cross-origin-write", FORBIDDEN, "Pages of other sites may not write";
    /// What is built in cannot be changed.
    ReadOnly = "read-only", FORBIDDEN, "The resource is read-only";
    /// Nothing is there.
    NotFound = "not-found", NOT_FOUND, "There is no such resource";
    /// A route begins or ends outside the map.
    RouteOutside = "route-outside", NOT_FOUND, "No route: an end lies outside the map";
    /// A route begins or ends where robots may not drive.
    RouteNotDrivable = "route-not-drivable", NOT_FOUND, "No route: an end lies in a place that is not drivable";
    /// A route begins or ends on an obstacle.
    RouteBlocked = "route-blocked", NOT_FOUND, "No route: an end lies on a cell that is not free";
    /// The storage location cannot be reached from anywhere.
    RouteNoAccess = "route-no-access", NOT_FOUND, "No route: the location has no storage access";
    /// No chain of drivable places.
    RouteDisconnected = "route-disconnected", NOT_FOUND, "No route: no drivable places join the ends";
    /// Obstacles close the way.
    RouteObstructed = "route-obstructed", NOT_FOUND, "No route: obstacles close the way";
    /// The method does not apply.
    MethodNotAllowed = "method-not-allowed", METHOD_NOT_ALLOWED, "The resource does not answer this method";
    /// No representation that the client accepts.
    NotAcceptable = "not-acceptable", NOT_ACCEPTABLE, "No representation of an accepted media type";
    /// The body arrived too slowly.
    Timeout = "request-timeout", REQUEST_TIMEOUT, "The request took too long to arrive";
    /// The state of the resource forbids it.
    Conflict = "conflict", CONFLICT, "The state of the resource forbids the request";
    /// The map is there, its analysis is not.
    NotAnalysed = "not-analysed", CONFLICT, "The map has no finished analysis yet";
    /// `If-Match` named another version.
    PreconditionFailed = "precondition-failed", PRECONDITION_FAILED, "The resource has changed";
    /// Over a limit.
    TooLarge = "too-large", PAYLOAD_TOO_LARGE, "The request is over a limit";
    /// Not a format that is read.
    UnsupportedMediaType = "unsupported-media-type", UNSUPPORTED_MEDIA_TYPE, "The format is not supported";
    /// Well formed, and wrong.
    Invalid = "invalid", UNPROCESSABLE_ENTITY, "The content is invalid";
    /// A write without `If-Match`.
    PreconditionRequired = "precondition-required", PRECONDITION_REQUIRED, "The write needs an If-Match header";
    /// Something is wrong in the service.
    Internal = "internal", INTERNAL_SERVER_ERROR, "The service failed";
    /// The queue is full.
    Busy = "busy", SERVICE_UNAVAILABLE, "The queue is full";
    /// The store does not answer, or the answer took too long.
    Unavailable = "unavailable", SERVICE_UNAVAILABLE, "The service cannot answer now";
    /// The disk is full.
    NoSpace = "no-space", INSUFFICIENT_STORAGE, "The server is short of disk space";
}

impl ProblemType {
    /// The relative URI that names the type.
    #[must_use]
    pub fn uri(self) -> String {
        format!("/problems/{}", self.row().0)
    }

    /// The status that goes with it.
    #[must_use]
    pub const fn status(self) -> StatusCode {
        self.row().1
    }

    /// The type of a refusal that the framework made.
    fn of_status(status: StatusCode) -> Self {
        match status {
            StatusCode::NOT_FOUND => Self::NotFound,
            StatusCode::METHOD_NOT_ALLOWED => Self::MethodNotAllowed,
            StatusCode::PAYLOAD_TOO_LARGE => Self::TooLarge,
            StatusCode::UNSUPPORTED_MEDIA_TYPE => Self::UnsupportedMediaType,
            status if status.is_client_error() => Self::BadRequest,
            _ => Self::Internal,
        }
    }
}

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

/// A refusal.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem {
    kind: ProblemType,
    detail: String,
    errors: Vec<ProblemItem>,
    retry_after_s: Option<u32>,
}

impl Problem {
    /// A refusal with its reason, for people.
    #[must_use]
    pub fn new(kind: ProblemType, detail: impl Into<String>) -> Self {
        Self { kind, detail: detail.into(), errors: Vec::new(), retry_after_s: None }
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

    /// Tells the client when to come back.
    #[must_use]
    pub const fn retry_after(mut self, seconds: u32) -> Self {
        self.retry_after_s = Some(seconds);
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

    /// The kind of the problem.
    #[cfg(test)]
    pub const fn kind(&self) -> ProblemType {
        self.kind
    }

    /// What is wrong, piece by piece.
    #[cfg(test)]
    pub fn errors(&self) -> &[ProblemItem] {
        &self.errors
    }

    fn document(&self, instance: &str) -> ProblemDocument {
        let (_, status, title) = self.kind.row();
        ProblemDocument {
            r#type: self.kind.uri(),
            title: title.to_owned(),
            status: status.as_u16(),
            detail: self.detail.clone(),
            instance: instance.to_owned(),
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
    /// What is wrong, piece by piece, where that is known.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    errors: Vec<ProblemItem>,
}

impl IntoResponse for Problem {
    /// The bare response: [`render`] gives it its body.
    fn into_response(self) -> Response {
        let mut response = self.kind.status().into_response();
        if let Some(seconds) = self.retry_after_s {
            response.headers_mut().insert(header::RETRY_AFTER, seconds.into());
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
            AppError::PreconditionFailed { .. } => Self::new(ProblemType::PreconditionFailed, detail),
            AppError::PreconditionRequired => Self::new(ProblemType::PreconditionRequired, detail),
            AppError::Conflict(_) => Self::new(ProblemType::Conflict, detail),
            AppError::TooLarge(_) => Self::new(ProblemType::TooLarge, detail),
            AppError::Busy { retry_after_s } => Self::new(ProblemType::Busy, detail).retry_after(retry_after_s),
            AppError::NoSpace => Self::new(ProblemType::NoSpace, detail).retry_after(60),
            AppError::Unavailable => Self::new(ProblemType::Unavailable, detail).retry_after(5),
            AppError::Internal(source) => {
                tracing::error!(error = &*source, "a request failed");
                Self::new(ProblemType::Internal, "the service failed: its log says why, under this request's id")
            }
        }
    }
}

impl From<NoRoute> for Problem {
    fn from(reason: NoRoute) -> Self {
        let kind = match reason {
            NoRoute::Outside(_) => ProblemType::RouteOutside,
            NoRoute::NotDrivable { .. } => ProblemType::RouteNotDrivable,
            NoRoute::Blocked(_) => ProblemType::RouteBlocked,
            NoRoute::NoAccess { .. } => ProblemType::RouteNoAccess,
            NoRoute::Disconnected { .. } => ProblemType::RouteDisconnected,
            NoRoute::Obstructed => ProblemType::RouteObstructed,
        };
        Self::new(kind, reason.to_string())
    }
}

/// Middleware: writes the body of every refusal.
pub async fn render(request: Request, next: Next) -> Response {
    let (method, uri) = (request.method().clone(), request.uri().clone());
    let mut response = next.run(request).await;
    let status = response.status();
    if !status.is_client_error() && !status.is_server_error() {
        return response;
    }
    let problem = response.extensions_mut().remove::<Problem>().unwrap_or_else(|| {
        let kind = ProblemType::of_status(status);
        let detail = match kind {
            ProblemType::NotFound => format!("there is nothing at {}", uri.path()),
            ProblemType::MethodNotAllowed => format!("{} does not answer {method}", uri.path()),
            kind => kind.row().2.to_owned(),
        };
        Problem::new(kind, detail)
    });
    let body = serde_json::to_vec(&problem.document(uri.path())).expect("strings and numbers can be written");
    let (mut parts, _) = response.into_parts();
    parts.headers.remove(header::CONTENT_LENGTH);
    parts.headers.insert(header::CONTENT_TYPE, HeaderValue::from_static(PROBLEM_JSON));
    parts.headers.insert(header::CACHE_CONTROL, HeaderValue::from_static("no-store"));
    Response::from_parts(parts, body.into())
}

/// What a panic becomes.
#[must_use]
#[expect(clippy::needless_pass_by_value, reason = "the layer that catches panics hands them over")]
pub fn of_panic(panic: Box<dyn std::any::Any + Send>) -> Response {
    let message = panic.downcast_ref::<&str>().copied().map(str::to_owned);
    let message = message.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_default();
    tracing::error!(panic = message, "a request panicked");
    Problem::new(ProblemType::Internal, "the service failed: its log says why, under this request's id").into_response()
}

/// A kind of problem, described.
#[derive(Debug, Serialize, ToSchema)]
pub struct ProblemTypeView {
    /// Its URI.
    #[schema(example = "/problems/not-found")]
    r#type: String,
    /// The kind, for people.
    title: &'static str,
    /// The HTTP status.
    status: u16,
}

/// A kind of problem
///
/// What the `type` of a problem detail leads to.
#[utoipa::path(get, path = "/problems/{problem}", tag = "service", operation_id = "getProblemType",
    params(("problem" = String, Path, description = "Last part of the type's URI", example = "not-found")),
    responses((status = 200, description = "The kind of problem", body = ProblemTypeView)))]
pub async fn describe(Path(slug): Path<String>) -> Result<axum::Json<ProblemTypeView>, Problem> {
    let kind = ProblemType::ALL.iter().find(|kind| kind.row().0 == slug);
    let kind = kind.ok_or_else(|| Problem::not_found(format!("there is no kind of problem {slug}")))?;
    let (_, status, title) = kind.row();
    Ok(axum::Json(ProblemTypeView { r#type: kind.uri(), title, status: status.as_u16() }))
}

#[cfg(test)]
mod tests {
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
