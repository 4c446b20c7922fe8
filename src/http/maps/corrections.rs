//! Corrections: what people say about a map that no automatic reading got right.

use std::sync::Arc;

use axum::Json;
use axum::extract::{Request, State};
use axum::http::{StatusCode, header};
use axum::response::{AppendHeaders, IntoResponse, Response};
use serde::Deserialize;
use serde_json::{Map, Value};
use utoipa::IntoParams;

use super::corrections_body::{self, NewCorrectionsBody};
use super::semantics::{answered_tag, in_force_tag};
use crate::app::{App, Caller, CorrectionId, MapContext, WantedCorrection};
use crate::blocking::off_the_runtime;
use crate::http::docs::refusals::{NotAnalysed, NotFound, PreconditionRequired};
use crate::http::extract::conditional::{IfMatch, IfNoneMatch};
use crate::http::extract::crs::CrsName;
use crate::http::extract::negotiation::Accept;
use crate::http::extract::{self, JsonBody, MapPath, Path, Query};
use crate::http::links::{Base, JSON};
use crate::http::page;
use crate::http::problem::Problem;
use crate::records::LostDecision;
use crate::views::correction::{
    CorrectionFeaturesBody, CorrectionListView, CorrectionPatch, CorrectionsBody, ListedCorrection,
};
use crate::views::id::Id;

/// How shapes are read.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub struct CorrectionsQuery {
    /// System of the coordinates of GeoJSON. CRS84 (longitude, latitude) when absent, as everywhere; `EPSG:3857` for the
    /// metres of the map frame (of a map without georeference). Corrections as JSON are always in metres of the map frame.
    #[serde(default)]
    #[param(value_type = Option<CrsName>)]
    crs: CrsName,
}

/// `/v1/maps/{mapId}/corrections/{correctionId}`
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
#[serde(rename_all = "camelCase")]
pub struct CorrectionPath {
    /// The map.
    pub map_id: Id,
    /// The correction, such as `c1`.
    pub correction_id: String,
}

/// List corrections
///
/// All corrections in the order in which they are applied, each with what became of it on the analysis in force. One that does
/// not fit there is kept, changes nothing, and says why.
#[utoipa::path(get, path = "/v1/maps/{mapId}/corrections", tag = "corrections", operation_id = "listCorrections",
    params(MapPath),
    responses((status = 200, description = "The corrections",
        content((CorrectionListView = "application/json"), (String = "text/html")),
        headers(("ETag" = String, description = "That of the semantics, which they are part of"))),
        NotFound, NotAnalysed))]
pub async fn list(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<MapPath>,
    accept: Accept,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    let context = app.context(&caller, path.map_id.0).await?;
    let tag = answered_tag(&context, &accept);
    let answer = move || Ok(page::answer(&accept, "Corrections", &document(&context, &base, Vec::new())));
    tag.answer_computed(&if_none_match, answer).await
}

/// A correction
///
/// What it says, and what became of it on the analysis in force.
#[utoipa::path(get, path = "/v1/maps/{mapId}/corrections/{correctionId}", tag = "corrections",
    operation_id = "getCorrection", params(CorrectionPath),
    responses((status = 200, description = "The correction",
        content((ListedCorrection = "application/json"), (String = "text/html")),
        headers(("ETag" = String, description = "That of the semantics, which it is part of"))),
        NotFound, NotAnalysed))]
pub async fn get(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<CorrectionPath>,
    accept: Accept,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    let context = app.context(&caller, path.map_id.0).await?;
    let found = ListedCorrection::find(&context, path.id()?).ok_or_else(|| path.not_found())?;
    let tag = answered_tag(&context, &accept);
    Ok(tag.answer(&if_none_match, || page::answer(&accept, "A correction", &found)))
}

/// Correct a map
///
/// Adds corrections at the end of the list: one, several, or the shapes of a GeoJSON file, such as the racks of a plan. All of
/// them or none: one that makes no sense or does not fit onto the map is refused with the reason. What is corrected is a new
/// version of the semantics, in force at once; faces are numbered anew, and labels that people gave to single faces stay with
/// their ground.
#[utoipa::path(post, path = "/v1/maps/{mapId}/corrections", tag = "corrections", operation_id = "correctMap",
    params(MapPath, CorrectionsQuery, ("If-Match" = Option<String>, Header,
        description = "The ETag of the corrections or of the semantics, as it was read; 428 without it")),
    request_body(content((CorrectionsBody = "application/json"), (CorrectionFeaturesBody = "application/geo+json"))),
    responses((status = 201, description = "The corrections as they are now", body = CorrectionListView,
            headers(("ETag" = String, description = "That of the semantics, which they are part of"),
                ("Location" = String, description = "The correction; where it is not one, their list"))),
        NotFound, NotAnalysed, PreconditionRequired))]
pub async fn create(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<MapPath>,
    Query(query): Query<CorrectionsQuery>,
    if_match: IfMatch,
    request: Request,
) -> Result<Response, Problem> {
    corrections_body::check_media_type(request.headers())?;
    let bytes = extract::body(request, &app).await?;
    let context = app.context(&caller, path.map_id.0).await?;
    let transform =
        query.crs.transform(context.record.georeference).map_err(|detail| Problem::parameter("crs", detail))?;
    let on = Arc::clone(&context);
    let read = move || {
        let body = NewCorrectionsBody::read(&bytes, &on.semantic.rule_set, &transform)?;
        let is_one = body.corrections.len() == 1;
        let (wanted, in_request) = body.after(&on);
        Ok::<_, Problem>((wanted, in_request, is_one))
    };
    let (wanted, in_request, is_one) = off_the_runtime(read).await?;
    let if_match = if_match.against(&in_force_tag(&context), context.semantics.version)?;
    let made = app.change_corrections(&caller, path.map_id.0, wanted, if_match).await;
    let (context, lost) = made.map_err(|error| Problem::from(error).map_pointers(in_request))?;
    let made = format!("/v1/maps/{}/corrections", path.map_id);
    let location = match context.correction_ids.last() {
        Some(id) if is_one => format!("{made}/{id}"),
        _ => made,
    };
    let location = AppendHeaders([(header::LOCATION, base.link("self", &location, JSON).href)]);
    Ok((StatusCode::CREATED, location, answer(&context, &base, lost)).into_response())
}

/// Change a correction
///
/// A JSON merge patch (RFC 7396): other points, another label, another name. It is refused where the correction does not fit
/// then. Corrections after it are applied anew; they stay in the list where they no longer fit.
#[utoipa::path(patch, path = "/v1/maps/{mapId}/corrections/{correctionId}", tag = "corrections",
    operation_id = "changeCorrection",
    params(CorrectionPath, ("If-Match" = Option<String>, Header,
        description = "The ETag of the corrections or of the semantics, as it was read; 428 without it")),
    request_body(content((CorrectionPatch = "application/merge-patch+json"), (CorrectionPatch = "application/json"))),
    responses((status = 200, description = "The corrections as they are now", body = CorrectionListView,
            headers(("ETag" = String, description = "That of the semantics, which they are part of"))),
        NotFound, NotAnalysed, PreconditionRequired))]
pub async fn change(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<CorrectionPath>,
    if_match: IfMatch,
    JsonBody(patch): JsonBody<Map<String, Value>>,
) -> Result<Response, Problem> {
    let context = app.context(&caller, path.map_id.0).await?;
    let (mut wanted, index) = path.find(&context)?;
    let correction = &mut wanted[index].1;
    *correction = corrections_body::patched(correction, patch)?;
    let if_match = if_match.against(&in_force_tag(&context), context.semantics.version)?;
    let made = app.change_corrections(&caller, path.map_id.0, wanted, if_match).await;
    let in_list = format!("/corrections/{index}");
    let in_patch = |pointer: &str| pointer.strip_prefix(&in_list).unwrap_or(pointer).to_owned();
    let (context, lost) = made.map_err(|error| Problem::from(error).map_pointers(in_patch))?;
    Ok(answer(&context, &base, lost))
}

/// Delete a correction
///
/// The map is as if nobody had said it. Corrections after it are applied anew; they stay in the list where they no longer fit.
/// The way back is `…/semantics/undo`.
#[utoipa::path(delete, path = "/v1/maps/{mapId}/corrections/{correctionId}", tag = "corrections",
    operation_id = "deleteCorrection",
    params(CorrectionPath, ("If-Match" = Option<String>, Header,
        description = "The ETag of the corrections or of the semantics, as it was read; 428 without it")),
    responses((status = 200, description = "The corrections as they are now", body = CorrectionListView,
            headers(("ETag" = String, description = "That of the semantics, which they are part of"))),
        NotFound, NotAnalysed, PreconditionRequired))]
pub async fn delete(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<CorrectionPath>,
    if_match: IfMatch,
) -> Result<Response, Problem> {
    let context = app.context(&caller, path.map_id.0).await?;
    let (mut wanted, index) = path.find(&context)?;
    wanted.remove(index);
    let if_match = if_match.against(&in_force_tag(&context), context.semantics.version)?;
    let (context, lost) = app.change_corrections(&caller, path.map_id.0, wanted, if_match).await?;
    Ok(answer(&context, &base, lost))
}

impl CorrectionPath {
    fn id(&self) -> Result<CorrectionId, Problem> {
        self.correction_id.parse().map_err(|_| self.not_found())
    }

    fn not_found(&self) -> Problem {
        Problem::not_found(format!("there is nothing at /v1/maps/{}/corrections/{}", self.map_id, self.correction_id))
    }

    /// The list of a map, and the index of the correction there.
    fn find(&self, context: &MapContext) -> Result<(Vec<WantedCorrection>, usize), Problem> {
        let id = self.id()?;
        let index = context.correction_ids.iter().position(|of| *of == id).ok_or_else(|| self.not_found())?;
        Ok((context.wanted_corrections(), index))
    }
}

/// The corrections after a write, with their tag.
fn answer(context: &MapContext, base: &Base, lost: Vec<LostDecision>) -> Response {
    let headers = [(header::ETAG, in_force_tag(context).header())];
    (headers, Json(document(context, base, lost))).into_response()
}

fn document(context: &MapContext, base: &Base, lost: Vec<LostDecision>) -> CorrectionListView {
    let map = context.record.id;
    let links = vec![
        base.link("self", &format!("/v1/maps/{map}/corrections"), JSON),
        base.link("related", &format!("/v1/maps/{map}/semantics"), JSON).titled("Labels in force"),
    ];
    CorrectionListView::new(context, lost, links)
}
