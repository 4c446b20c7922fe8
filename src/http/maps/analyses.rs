//! Analyses of a map, and the signals behind the newest one.

use std::sync::Arc;

use axum::Json;
use axum::extract::State;
use axum::http::{HeaderValue, header};
use axum::response::{IntoResponse, Response};
use serde::Deserialize;
use utoipa::IntoParams;
use uuid::Uuid;

use crate::app::{AnalysisRecord, AnalysisTicket, App, Caller};
use crate::blocking::off_the_runtime;
use crate::features::Collection;
use crate::formats::geojson;
use crate::http::docs::refusals::{NoSpace, NotAnalysed, NotFound};
use crate::http::extract::conditional::{EntityTag, IfNoneMatch};
use crate::http::extract::crs::{CONTENT_CRS, CrsName};
use crate::http::extract::negotiation::Accept;
use crate::http::extract::{JsonBody, MapPath, Path, Query};
use crate::http::links::{Base, GEO_JSON, JSON};
use crate::http::ogc::item_query::properties;
use crate::http::ogc::jobs;
use crate::http::page;
use crate::http::problem::Problem;
use crate::options::RequestedOptions;
use crate::views::analysis::{AnalysisList, AnalysisView};
use crate::views::diagnostics::Diagnostics;
use crate::views::feature::FeatureListView;
use crate::views::id::Id;
use crate::views::job::JobView;
use crate::views::link::Link;
use crate::views::options::AnalysisOptionsView;

/// List analyses
///
/// Every analysis of the map, one per set of options. One is in force, the others are proposals.
#[utoipa::path(get, path = "/v1/maps/{mapId}/analyses", tag = "maps", operation_id = "listAnalyses", params(MapPath),
    responses((status = 200, description = "The analyses",
        content((AnalysisList = "application/json"), (String = "text/html"))),
        NotFound))]
pub async fn list(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<MapPath>,
    accept: Accept,
) -> Result<Response, Problem> {
    let in_force = app.map(&caller, path.map_id.0).await?.analysis;
    let versions = app.semantics_versions(&caller, path.map_id.0).await?;
    let analyses = app.analyses(&caller, path.map_id.0).await?.into_iter();
    let view = |record: AnalysisRecord| {
        let links = links(&base, &record, in_force);
        AnalysisView::new(record, in_force, &versions, links)
    };
    let analyses = analyses.map(view).collect();
    let links = vec![base.link("self", &format!("/v1/maps/{}/analyses", path.map_id), JSON)];
    Ok(page::answer(&accept, "Analyses", &AnalysisList { analyses, links }))
}

/// When a new analysis comes into force.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
pub struct ActivateQuery {
    /// Whether the analysis comes into force as soon as it is there.
    #[serde(default)]
    #[param(value_type = Option<bool>, default = false)]
    activate: bool,
}

/// `/v1/maps/{mapId}/analyses/{analysisId}`
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
#[serde(rename_all = "camelCase")]
pub struct AnalysisPath {
    /// The map.
    pub map_id: Id,
    /// The analysis.
    pub analysis_id: Id,
}

/// Analyse again
///
/// With other options. The result is a proposal beside the analysis in force, which still answers, until it is activated.
/// Options that were analysed before answer that analysis (200) instead of a job (202).
#[utoipa::path(post, path = "/v1/maps/{mapId}/analyses", tag = "maps", operation_id = "createAnalysis",
    params(MapPath, ActivateQuery),
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
    Query(query): Query<ActivateQuery>,
    JsonBody(RequestedOptions(options)): JsonBody<RequestedOptions>,
) -> Result<Response, Problem> {
    let ticket = app.create_analysis(&caller, path.map_id.0, options, query.activate).await;
    // The use case names the options as a part of an upload; here they are the whole body.
    let in_body = |pointer: &str| pointer.strip_prefix("/options").unwrap_or(pointer).to_owned();
    Ok(match ticket.map_err(|error| Problem::from(error).map_pointers(in_body))? {
        AnalysisTicket::Existing(record) => Json(document(&app, &caller, &base, *record).await?).into_response(),
        AnalysisTicket::Job(job) => jobs::accepted(&base, *job),
    })
}

/// Activate an analysis
///
/// It answers from now on, with the labels that people gave to it. Where nobody did, those of the analysis before are carried
/// over by the ground that they lie on, and `carried` says what could not be; where nobody decided on that one either, its
/// suggestion stands. The way back is to activate the one before.
#[utoipa::path(post, path = "/v1/maps/{mapId}/analyses/{analysisId}/activate", tag = "maps",
    operation_id = "activateAnalysis", params(AnalysisPath),
    responses((status = 200, description = "The analysis, in force", body = AnalysisView),
        NotFound))]
pub async fn activate(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<AnalysisPath>,
) -> Result<Json<AnalysisView>, Problem> {
    let record = app.activate_analysis(&caller, path.map_id.0, path.analysis_id.0).await?;
    Ok(Json(document(&app, &caller, &base, record).await?))
}

/// An analysis
///
/// Of a proposal, `wouldCarry` says which labels that people gave would be kept and lost if it was activated now.
#[utoipa::path(get, path = "/v1/maps/{mapId}/analyses/{analysisId}", tag = "maps", operation_id = "getAnalysis",
    params(AnalysisPath),
    responses((status = 200, description = "The analysis",
        content((AnalysisView = "application/json"), (String = "text/html"))),
        NotFound, NotAnalysed))]
pub async fn get(
    State(app): State<Arc<App>>,
    caller: Caller,
    base: Base,
    Path(path): Path<AnalysisPath>,
    accept: Accept,
) -> Result<Response, Problem> {
    let proposal = app.proposal(&caller, path.map_id.0, path.analysis_id.0).await?;
    let record = app.analysis(&caller, path.map_id.0, path.analysis_id.0).await?;
    let view = document(&app, &caller, &base, record).await?.with_prospect(proposal.carried);
    Ok(page::answer(&accept, "Analysis", &view))
}

/// How to write faces.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub struct FacesQuery {
    /// Only these properties; all when absent. They come in the order of the schema.
    #[param(value_type = Option<Vec<String>>, style = Form, explode = false, min_items = 1, example = json!(["label"]))]
    properties: Option<String>,
    /// System of the coordinates; CRS84 when absent.
    #[serde(default)]
    #[param(value_type = Option<CrsName>)]
    crs: CrsName,
}

/// Faces of an analysis
///
/// As they are, or of a proposal as they would be if it was activated now: with the labels of people where those would be kept,
/// else with the suggested ones.
#[utoipa::path(get, path = "/v1/maps/{mapId}/analyses/{analysisId}/faces", tag = "maps",
    operation_id = "getAnalysisFaces", params(AnalysisPath, FacesQuery),
    responses((status = 200, description = "All faces",
        content((FeatureListView = "application/geo+json"), (String = "text/html")),
        headers(("Content-Crs" = String, description = "System of the coordinates"))),
        NotFound, NotAnalysed))]
pub async fn faces(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<AnalysisPath>,
    Query(query): Query<FacesQuery>,
    accept: Accept,
) -> Result<Response, Problem> {
    let properties = properties(query.properties.as_deref(), Collection::Faces)?;
    let context = app.proposal(&caller, path.map_id.0, path.analysis_id.0).await?.context;
    let transform =
        query.crs.transform(context.record.georeference).map_err(|detail| Problem::parameter("crs", detail))?;
    let headers = [(header::CONTENT_TYPE, HeaderValue::from_static(GEO_JSON)), (CONTENT_CRS, query.crs.header())];
    let written = move || {
        let faces = context.features(Collection::Faces);
        let written = geojson::feature_collection(faces, &properties, &transform, &[("numberReturned", &faces.len())]);
        page::answer_geojson(&accept, "Faces of an analysis", headers, written)
    };
    Ok(off_the_runtime(written).await)
}

/// An analysis, its faces, what would change, and the way to put it in force.
fn links(base: &Base, record: &AnalysisRecord, in_force: Option<Uuid>) -> Vec<Link> {
    let path = format!("/v1/maps/{}/analyses/{}", record.map, record.id);
    let to = |rel, below: &str, media_type| base.link(rel, &format!("{path}{below}"), media_type);
    let mut links = vec![to("self", "", JSON), to("related", "/faces", GEO_JSON).titled("Its labelled faces")];
    if in_force != Some(record.id) {
        links.push(to("related", "/changes", JSON).titled("What would change"));
        links.push(to("related", "/activate", JSON).titled("POST puts it in force"));
    }
    links
}

/// The document of an analysis as it is now.
async fn document(app: &App, caller: &Caller, base: &Base, record: AnalysisRecord) -> Result<AnalysisView, Problem> {
    let in_force = app.map(caller, record.map).await?.analysis;
    let versions = app.semantics_versions(caller, record.map).await?;
    let links = links(base, &record, in_force);
    Ok(AnalysisView::new(record, in_force, &versions, links))
}

/// Signals and timings
///
/// What was taken for clutter, the orientation histogram and its mixture, the radiograms, the time of each stage, and the
/// remarks on the analysis in force.
#[utoipa::path(get, path = "/v1/maps/{mapId}/diagnostics", tag = "maps", operation_id = "getDiagnostics",
    params(MapPath),
    responses((status = 200, description = "The diagnostics",
        content((Diagnostics = "application/json"), (String = "text/html")),
        headers(("ETag" = String, description = "Changes with the analysis"))),
        NotFound, NotAnalysed))]
pub async fn diagnostics(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<MapPath>,
    accept: Accept,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    let context = app.context(&caller, path.map_id.0).await?;
    let records = app.analyses(&caller, path.map_id.0).await?;
    let record = records.iter().find(|record| record.id == context.analysis_id);
    let stages = record.map(|record| record.stages.iter().map(Into::into).collect()).unwrap_or_default();
    let tag = EntityTag::of_content(&[&page::kind("diagnostics", &accept), &context.analysis_id.to_string()]);
    let answer = move || Ok(page::answer(&accept, "Signals and timings", &Diagnostics::new(&context, stages)));
    tag.answer_computed(&if_none_match, answer).await
}
