//! The human level of a map: categories with suggestions, and the labels in force.

use std::sync::Arc;

use axum::Json;
use axum::extract::State;
use axum::http::header;
use axum::response::{IntoResponse, Response};
use serde::Deserialize;
use utoipa::IntoParams;
use uuid::Uuid;

use super::semantics_body::{self, SemanticsPatchBody};
use crate::app::{App, Caller, MapContext, SemanticsChange, SemanticsRecord};
use crate::http::docs::refusals::{Conflict, NotAnalysed, NotFound, PreconditionRequired};
use crate::http::extract::conditional::{EntityTag, IfMatch, IfNoneMatch};
use crate::http::extract::negotiation::Accept;
use crate::http::extract::{JsonBody, MapPath, Path};
use crate::http::links::{Base, JSON};
use crate::http::page;
use crate::http::problem::Problem;
use crate::views::category::{CategoryList, CategoryView};
use crate::views::id::Id;
use crate::views::semantics::{SemanticsBody, SemanticsHistory, SemanticsView};

/// List categories
///
/// What there is to name: each category with its extent, its features, the label in force and a suggested one.
#[utoipa::path(get, path = "/v1/maps/{mapId}/categories", tag = "semantics", operation_id = "listCategories",
    params(MapPath),
    responses((status = 200, description = "The categories",
        content((CategoryList = "application/json"), (String = "text/html")),
        headers(("ETag" = String, description = "Changes with the analysis and the labels"))),
        NotFound, NotAnalysed))]
pub async fn categories(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<MapPath>,
    accept: Accept,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    let context = app.context(&caller, path.map_id.0).await?;
    let (kind, version) = (page::kind("categories", &accept), context.semantics.version.to_string());
    let tag = EntityTag::of_content(&[&kind, &context.analysis_id.to_string(), &version]);
    tag.answer_computed(&if_none_match, move || {
        let links = vec![
            base.link("self", &format!("/v1/maps/{}/categories", path.map_id), JSON),
            base.link("related", &format!("/v1/maps/{}/semantics", path.map_id), JSON).titled("Labels in force"),
        ];
        let categories = 0..context.analysis.face_categories.count() as u8;
        let categories = categories.map(|category| CategoryView::new(&context, category)).collect();
        let list = CategoryList { categories, rule_set: context.semantics.rule_set.clone(), links };
        Ok(page::answer(&accept, "Categories", &list))
    })
    .await
}

/// The name of the labels in their tags, which a write names.
const KIND: &str = "semantics";

/// The tag of the labels in force.
pub(super) fn in_force_tag(context: &MapContext) -> EntityTag {
    tag(KIND, context.analysis_id, &context.semantics)
}

/// The tag of what the labels in force answer, as JSON or as a page.
pub(super) fn answered_tag(context: &MapContext, accept: &Accept) -> EntityTag {
    tag(&page::kind(KIND, accept), context.analysis_id, &context.semantics)
}

/// The tag of a version. Version 0 is the suggestion of whatever analysis is in force, with the layout of the
/// newest decision on the site, so these are in it too.
fn tag(kind: &str, analysis: Uuid, record: &SemanticsRecord) -> EntityTag {
    let layout = serde_json::to_string(&record.layout).expect("a layout is plain data");
    EntityTag::of_content(&[kind, &analysis.to_string(), &record.version.to_string(), &layout])
}

/// Labels in force
///
/// Until a person assigns labels, the suggestion is in force (version 0, origin `suggested`).
#[utoipa::path(get, path = "/v1/maps/{mapId}/semantics", tag = "semantics", operation_id = "getSemantics",
    params(MapPath),
    responses((status = 200, description = "The labels",
        content((SemanticsView = "application/json"), (String = "text/html")),
        headers(("ETag" = String, description = "Changes with them"))),
        NotFound, NotAnalysed))]
pub async fn get(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<MapPath>,
    accept: Accept,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    let context = app.context(&caller, path.map_id.0).await?;
    let answer = {
        let (context, accept) = (Arc::clone(&context), accept.clone());
        move || {
            let view = SemanticsView::new(context.semantics.clone(), &context.record.to_site());
            Ok(page::answer(&accept, "Labels in force", &view))
        }
    };
    answered_tag(&context, &accept).answer_computed(&if_none_match, answer).await
}

/// Assign labels
///
/// Makes a new version, which is in force at once: labels, cogency, connectivity, places and locations follow from it
/// in milliseconds, without a job. Categories and members that are not named stay as they are in force.
#[utoipa::path(put, path = "/v1/maps/{mapId}/semantics", tag = "semantics", operation_id = "assignSemantics",
    params(MapPath, ("If-Match" = Option<String>, Header, description = "The ETag that was read; 428 without it")),
    request_body = SemanticsBody,
    responses((status = 200, description = "The labels as they are now", body = SemanticsView,
            headers(("ETag" = String, description = "Changes with them"))),
        NotFound, NotAnalysed, PreconditionRequired))]
pub async fn assign(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<MapPath>,
    if_match: IfMatch,
    JsonBody(body): JsonBody<SemanticsBody>,
) -> Result<Response, Problem> {
    let faces: Vec<u32> = body.overrides.iter().flatten().map(|entry| entry.face).collect();
    let context = app.context(&caller, path.map_id.0).await?;
    let change = semantics_body::of_put(body, &context)?;
    decide(&app, &caller, &context, &if_match, change).await.map_err(in_list(faces))
}

/// Change labels
///
/// Makes a new version as `PUT` does, from what the merge patch (RFC 7396) names: one category, one face, one member of the
/// layout. Null takes back what a person decided.
#[utoipa::path(patch, path = "/v1/maps/{mapId}/semantics", tag = "semantics", operation_id = "changeSemantics",
    params(MapPath, ("If-Match" = Option<String>, Header, description = "The ETag that was read; 428 without it")),
    request_body(content((SemanticsPatchBody = "application/merge-patch+json"),
        (SemanticsPatchBody = "application/json"))),
    responses((status = 200, description = "The labels as they are now", body = SemanticsView,
            headers(("ETag" = String, description = "Changes with them"))),
        NotFound, NotAnalysed, PreconditionRequired))]
pub async fn change(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<MapPath>,
    if_match: IfMatch,
    JsonBody(body): JsonBody<SemanticsPatchBody>,
) -> Result<Response, Problem> {
    let faces = body.listed_faces();
    let context = app.context(&caller, path.map_id.0).await?;
    let change = semantics_body::of_patch(body, &context)?;
    decide(&app, &caller, &context, &if_match, change).await.map_err(in_list(faces))
}

/// Makes a new version and answers it.
async fn decide(
    app: &App,
    caller: &Caller,
    context: &MapContext,
    if_match: &IfMatch,
    change: SemanticsChange,
) -> Result<Response, Problem> {
    let if_match = if_match.against(&in_force_tag(context), context.semantics.version)?;
    let (record, _) = app.change_semantics(caller, context.record.id, change, if_match).await?;
    Ok(answer(context, record))
}

/// Labels with their tag.
pub(super) fn answer(context: &MapContext, record: SemanticsRecord) -> Response {
    let headers = [(header::ETAG, tag(KIND, context.analysis_id, &record).header())];
    (headers, Json(SemanticsView::new(record, &context.record.to_site()))).into_response()
}

/// Lets a problem point into the list of overrides that was sent.
pub(super) fn in_list(faces: Vec<u32>) -> impl FnOnce(Problem) -> Problem {
    move |problem| problem.map_pointers(|pointer| list_pointer(pointer, &faces))
}

/// The core names an override by its face (`/overrides/12`); in the request it is an entry of a list.
fn list_pointer(pointer: &str, faces: &[u32]) -> String {
    let face = pointer.strip_prefix("/overrides/").and_then(|rest| rest.split('/').next()?.parse::<u32>().ok());
    match face.and_then(|face| faces.iter().position(|&entry| entry == face)) {
        Some(index) => format!("/overrides/{index}"),
        None => pointer.to_owned(),
    }
}

/// Versions of the labels
///
/// Every version that a person made, newest first.
#[utoipa::path(get, path = "/v1/maps/{mapId}/semantics/versions", tag = "semantics",
    operation_id = "listSemanticsVersions", params(MapPath),
    responses((status = 200, description = "The versions",
        content((SemanticsHistory = "application/json"), (String = "text/html"))),
        NotFound))]
pub async fn versions(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<MapPath>,
    accept: Accept,
) -> Result<Response, Problem> {
    let to_site = app.map(&caller, path.map_id.0).await?.to_site();
    let versions = app.semantics_versions(&caller, path.map_id.0).await?.into_iter();
    let versions = versions.map(|record| SemanticsView::new(record, &to_site)).collect();
    let links = vec![
        base.link("self", &format!("/v1/maps/{}/semantics/versions", path.map_id), JSON),
        base.link("latest-version", &format!("/v1/maps/{}/semantics", path.map_id), JSON),
    ];
    Ok(page::answer(&accept, "Versions of the labels", &SemanticsHistory { versions, links }))
}

/// `/v1/maps/{mapId}/semantics/versions/{version}`
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
#[serde(rename_all = "camelCase")]
pub struct VersionPath {
    /// The map.
    pub map_id: Id,
    /// The version; 0 is the suggestion for the analysis in force.
    pub version: u64,
}

/// A version of the labels
///
/// A version that a person made never changes. Version 0 is the suggestion for the analysis in force.
#[utoipa::path(get, path = "/v1/maps/{mapId}/semantics/versions/{version}", tag = "semantics",
    operation_id = "getSemanticsVersion", params(VersionPath),
    responses((status = 200, description = "The version",
        content((SemanticsView = "application/json"), (String = "text/html")),
        headers(("ETag" = String, description = "Changes with the suggestion"))),
        NotFound, NotAnalysed))]
pub async fn version(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<VersionPath>,
    accept: Accept,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    let to_site = app.map(&caller, path.map_id.0).await?.to_site();
    let record = app.semantics_version(&caller, path.map_id.0, path.version).await?;
    let tag = tag(&page::kind(KIND, &accept), record.analysis, &record);
    let answer = || page::answer(&accept, "A version of the labels", &SemanticsView::new(record, &to_site));
    Ok(tag.answer(&if_none_match, answer))
}

/// Restore a version of the labels
///
/// Makes a new version that is equal to an earlier one, with the rule set as it was then: the way to undo, and to undo an
/// undo. Version 0 is the suggestion: its labels come into force under the default rule set, in the layout in force.
#[utoipa::path(post, path = "/v1/maps/{mapId}/semantics/versions/{version}/restore", tag = "semantics",
    operation_id = "restoreSemantics",
    params(VersionPath, ("If-Match" = Option<String>, Header,
        description = "The ETag of the labels in force, as it was read; 428 without it")),
    responses((status = 200, description = "The labels as they are now", body = SemanticsView,
            headers(("ETag" = String, description = "Changes with them"))),
        NotFound, Conflict, PreconditionRequired))]
pub async fn restore(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<VersionPath>,
    if_match: IfMatch,
) -> Result<Response, Problem> {
    let context = app.context(&caller, path.map_id.0).await?;
    let if_match = if_match.against(&in_force_tag(&context), context.semantics.version)?;
    let record = app.restore_semantics(&caller, path.map_id.0, path.version, if_match).await?;
    Ok(answer(&context, record))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pointers_lead_into_the_list() {
        assert_eq!(list_pointer("/overrides/12", &[7, 12]), "/overrides/1");
        assert_eq!(list_pointer("/assignment/9", &[7, 12]), "/assignment/9");
    }
}
