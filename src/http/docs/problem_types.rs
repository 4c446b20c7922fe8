//! What the `type` of a problem detail leads to.

use axum::extract::Path;
use axum::response::Response;
use serde::Serialize;
use utoipa::ToSchema;

use super::refusals::NotFound;
use crate::http::extract::negotiation::Accept;
use crate::http::page;
use crate::http::problem::{Problem, ProblemType};

/// A kind of problem, described.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = ProblemType)]
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
#[utoipa::path(get, path = "/problems/{problem}", tag = "service", operation_id = "getProblemType", security(()),
    params(("problem" = String, Path, description = "Last part of the type's URI", example = "not-found")),
    responses((status = 200, description = "The kind of problem",
        content((ProblemTypeView = "application/json"), (String = "text/html"))),
        NotFound))]
pub async fn describe(Path(slug): Path<String>, accept: Accept) -> Result<Response, Problem> {
    let missing = || Problem::not_found(format!("there is no kind of problem {slug}"));
    let kind = ProblemType::find(&slug).ok_or_else(missing)?;
    let view = ProblemTypeView { r#type: kind.uri(), title: kind.title(), status: kind.status().as_u16() };
    Ok(page::answer(&accept, kind.title(), &view))
}
