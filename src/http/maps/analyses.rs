//! Analyses of a map, and the signals behind the newest one.

use std::sync::Arc;

use axum::Json;
use axum::extract::State;
use axum::response::{IntoResponse, Response};

use crate::app::{AnalysisTicket, App, Caller};
use crate::http::docs::refusals::{NoSpace, NotAnalysed, NotFound};
use crate::http::extract::conditional::{EntityTag, IfNoneMatch};
use crate::http::extract::{JsonBody, MapPath, Path};
use crate::http::links::{Base, JSON};
use crate::http::ogc::jobs;
use crate::http::problem::Problem;
use crate::options::RequestedOptions;
use crate::views::analysis::{AnalysisList, AnalysisView};
use crate::views::diagnostics::Diagnostics;
use crate::views::job::JobView;
use crate::views::options::AnalysisOptionsView;

/// List analyses
///
/// Every analysis of the map, one per set of options.
#[utoipa::path(get, path = "/v1/maps/{mapId}/analyses", tag = "maps", operation_id = "listAnalyses", params(MapPath),
    responses((status = 200, description = "The analyses", body = AnalysisList),
        NotFound))]
pub async fn list(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<MapPath>,
) -> Result<Json<AnalysisList>, Problem> {
    let analyses = app.analyses(&caller, path.map_id.0).await?.into_iter().map(Into::into).collect();
    let links = vec![base.link("self", &format!("/v1/maps/{}/analyses", path.map_id), JSON)];
    Ok(Json(AnalysisList { analyses, links }))
}

/// Analyse again
///
/// With other options. Options that were analysed before answer that analysis (200) instead of a job (202).
#[utoipa::path(post, path = "/v1/maps/{mapId}/analyses", tag = "maps", operation_id = "createAnalysis", params(MapPath),
    request_body = AnalysisOptionsView,
    responses(
        (status = 200, description = "These options were analysed before", body = AnalysisView),
        (status = 202, description = "The job will do it", body = JobView,
            headers(("Location" = String, description = "The job"))),
        NotFound, NoSpace))]
pub async fn create(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<MapPath>,
    JsonBody(RequestedOptions(options)): JsonBody<RequestedOptions>,
) -> Result<Response, Problem> {
    let ticket = app.create_analysis(&caller, path.map_id.0, options).await;
    // The use case names the options as a part of an upload; here they are the whole body.
    let in_body = |pointer: &str| pointer.strip_prefix("/options").unwrap_or(pointer).to_owned();
    Ok(match ticket.map_err(|error| Problem::from(error).map_pointers(in_body))? {
        AnalysisTicket::Existing(record) => Json(AnalysisView::from(*record)).into_response(),
        AnalysisTicket::Job(job) => jobs::accepted(&base, *job),
    })
}

/// Signals and timings
///
/// What was taken for clutter, the orientation histogram and its mixture, the radiograms, the time of each stage, and the
/// remarks on the newest analysis.
#[utoipa::path(get, path = "/v1/maps/{mapId}/diagnostics", tag = "maps", operation_id = "getDiagnostics",
    params(MapPath),
    responses((status = 200, description = "The diagnostics", body = Diagnostics,
        headers(("ETag" = String, description = "Changes with the analysis"))),
        NotFound, NotAnalysed))]
pub async fn diagnostics(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<MapPath>,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    let context = app.context(&caller, path.map_id.0).await?;
    let records = app.analyses(&caller, path.map_id.0).await?;
    let record = records.iter().find(|record| record.id == context.analysis_id);
    let stages = record.map(|record| record.stages.iter().map(Into::into).collect()).unwrap_or_default();
    let tag = EntityTag::of_content(&["diagnostics", &context.analysis_id.to_string()]);
    tag.answer_computed(&if_none_match, move || Ok(Json(Diagnostics::new(&context, stages)).into_response())).await
}
