//! Back and forth in the versions of the semantics.

use std::sync::Arc;

use axum::extract::State;
use axum::response::Response;

use super::semantics::{answer, in_force_tag};
use crate::app::{App, Caller};
use crate::http::docs::refusals::{Conflict, NotFound, PreconditionRequired};
use crate::http::extract::conditional::IfMatch;
use crate::http::extract::{MapPath, Path};
use crate::http::problem::Problem;
use crate::views::semantics::SemanticsView;

/// Undo
///
/// Takes the newest change of labels and corrections back that is in force: makes a new version that is equal to the one
/// before it. Again and again that leads back to the suggestion; 409 where there is nothing to undo.
#[utoipa::path(post, path = "/v1/maps/{mapId}/semantics/undo", tag = "semantics", operation_id = "undoSemantics",
    params(MapPath, ("If-Match" = Option<String>, Header,
        description = "The ETag of the labels in force, as it was read; 428 without it")),
    responses((status = 200, description = "The labels as they are now", body = SemanticsView,
            headers(("ETag" = String, description = "Changes with them"))),
        NotFound, Conflict, PreconditionRequired))]
pub async fn undo(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<MapPath>,
    if_match: IfMatch,
) -> Result<Response, Problem> {
    let context = app.context(&caller, path.map_id.0).await?;
    let if_match = if_match.against(&in_force_tag(&context), context.semantics.version)?;
    let record = app.undo_semantics(&caller, path.map_id.0, if_match).await?;
    Ok(answer(&context, record))
}

/// Redo
///
/// Puts the change in force again that was undone last; 409 where nothing was undone since the newest change.
#[utoipa::path(post, path = "/v1/maps/{mapId}/semantics/redo", tag = "semantics", operation_id = "redoSemantics",
    params(MapPath, ("If-Match" = Option<String>, Header,
        description = "The ETag of the labels in force, as it was read; 428 without it")),
    responses((status = 200, description = "The labels as they are now", body = SemanticsView,
            headers(("ETag" = String, description = "Changes with them"))),
        NotFound, Conflict, PreconditionRequired))]
pub async fn redo(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<MapPath>,
    if_match: IfMatch,
) -> Result<Response, Problem> {
    let context = app.context(&caller, path.map_id.0).await?;
    let if_match = if_match.against(&in_force_tag(&context), context.semantics.version)?;
    let record = app.redo_semantics(&caller, path.map_id.0, if_match).await?;
    Ok(answer(&context, record))
}
