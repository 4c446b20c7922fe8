//! Analyses of a map, and the signals behind the newest one.

use std::collections::BTreeMap;
use std::sync::Arc;

use axum::Json;
use axum::extract::State;
use axum::http::header;
use axum::response::{IntoResponse, Response};
use jiff::Timestamp;
use serde::Serialize;
use stillage_core::AnalysisOptions;
use stillage_core::declutter::Removed;
use utoipa::ToSchema;

use crate::app::{AnalysisRecord, AnalysisTicket, App, Caller, MapContext};
use crate::http::docs::refusals::{NoSpace, NotAnalysed, NotFound};
use crate::http::extract::conditional::{EntityTag, IfNoneMatch};
use crate::http::extract::{Id, JsonBody, MapPath, Path};
use crate::http::links::{Base, JSON, Link};
use crate::http::maps::options::AnalysisOptionsView;
use crate::http::ogc::jobs::JobView;
use crate::http::problem::Problem;
use crate::http::views::{DiagnosticView, StageView};
use crate::options::RequestedOptions;

/// A finished analysis.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Analysis)]
#[serde(rename_all = "camelCase")]
pub struct AnalysisView {
    id: Id,
    map_id: Id,
    #[schema(value_type = String, format = DateTime)]
    created: Timestamp,
    /// The options, with every default filled in.
    #[schema(value_type = AnalysisOptionsView)]
    options: AnalysisOptions,
    /// What each stage cost.
    stages: Vec<StageView>,
    /// Remarks on the result.
    diagnostics: Vec<DiagnosticView>,
}

impl From<AnalysisRecord> for AnalysisView {
    fn from(record: AnalysisRecord) -> Self {
        Self {
            id: Id(record.id),
            map_id: Id(record.map),
            created: record.created,
            stages: record.stages.iter().map(Into::into).collect(),
            diagnostics: record.diagnostics.iter().map(Into::into).collect(),
            options: record.options,
        }
    }
}

/// The analyses of a map.
#[derive(Debug, Serialize, ToSchema)]
pub struct AnalysisList {
    analyses: Vec<AnalysisView>,
    links: Vec<Link>,
}

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
        AnalysisTicket::Job(job) => JobView::accepted(&base, *job),
    })
}

/// All that a plot of the analysis needs. Lengths and angles are those of the grid frame.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "camelCase")]
#[allow(clippy::struct_field_names, reason = "the remarks are called so wherever there are any")]
pub struct Diagnostics {
    analysis_id: Id,
    frame: FrameView,
    clutter: ClutterView,
    orientations: OrientationsView,
    radiograms: Vec<RadiogramView>,
    /// What each stage cost.
    stages: Vec<StageView>,
    /// Counts of the result: faces, edges, lines ...
    counts: BTreeMap<&'static str, usize>,
    /// Remarks on the result.
    diagnostics: Vec<DiagnosticView>,
    /// Remarks of the upload.
    warnings: Vec<DiagnosticView>,
}

/// Where the grid frame lies in the map frame.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "camelCase")]
pub struct FrameView {
    /// Side of a cell, metres.
    resolution_m: f64,
    /// Lower left corner of the grid in the map frame, metres.
    origin_m: [f64; 2],
    /// Counter-clockwise turn of the grid in the map frame, radians.
    yaw_rad: f64,
}

/// What was taken for clutter before the first stage, in runs of cells: the first one (row by row from the lower left
/// corner of the grid) and their number.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "camelCase")]
pub struct ClutterView {
    /// Share of the floor's cells that carry a lone hit.
    rate: f64,
    /// Number of occupied cells taken for speckle.
    occupied_cells: usize,
    /// Number of unknown cells taken for holes in free space.
    unknown_cells: usize,
    /// Runs of occupied cells taken for speckle.
    occupied_runs: Vec<[u32; 2]>,
    /// Runs of unknown cells taken for holes in free space.
    unknown_runs: Vec<[u32; 2]>,
}

impl From<&Removed> for ClutterView {
    fn from(removed: &Removed) -> Self {
        Self {
            rate: removed.rate,
            occupied_cells: removed.occupied.len(),
            unknown_cells: removed.unknown.len(),
            occupied_runs: runs(&removed.occupied),
            unknown_runs: runs(&removed.unknown),
        }
    }
}

/// Ascending numbers as the first of each run and its length.
fn runs(cells: &[u32]) -> Vec<[u32; 2]> {
    cells.chunk_by(|one, next| one + 1 == *next).map(|run| [run[0], run.len() as u32]).collect()
}

/// The dominant orientations and the signals they were read from.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "camelCase")]
pub struct OrientationsView {
    /// Directions of lines in [-pi/2, pi/2), ascending.
    angles_rad: Vec<f64>,
    /// Weighted histogram over [-pi/2, pi/2), evenly spaced bins, sum 1.
    histogram: Vec<f64>,
    /// The histogram after the low-pass: density of the mixture at the same bins.
    mixture: Vec<f64>,
}

/// Projection of the occupied cells of a region on the normal of an orientation.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "camelCase")]
pub struct RadiogramView {
    region: u8,
    /// Direction of projection.
    orientation_rad: f64,
    /// Offset of the lower edge of the first bin along the normal.
    start_m: f64,
    /// Width of a bin.
    bin_m: f64,
    /// Occupied length per bin, metres.
    values_m: Vec<f64>,
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
    Ok(tag.answer(&if_none_match, || {
        ([(header::CONTENT_TYPE, JSON)], Json(Diagnostics::new(&context, stages))).into_response()
    }))
}

impl Diagnostics {
    fn new(context: &MapContext, stages: Vec<StageView>) -> Self {
        let analysis = &context.analysis;
        let radiogram = |radiogram: &stillage_core::radiography::Radiogram| RadiogramView {
            region: radiogram.region,
            orientation_rad: radiogram.orientation,
            start_m: radiogram.start,
            bin_m: radiogram.bin,
            values_m: radiogram.values.clone(),
        };
        Self {
            analysis_id: Id(context.analysis_id),
            frame: FrameView {
                resolution_m: analysis.frame.resolution,
                origin_m: [analysis.frame.origin.x, analysis.frame.origin.y],
                yaw_rad: analysis.frame.yaw,
            },
            clutter: ClutterView::from(&analysis.clutter),
            orientations: OrientationsView {
                angles_rad: analysis.orientations.angles.clone(),
                histogram: analysis.orientations.histogram.clone(),
                mixture: analysis.orientations.mixture.clone(),
            },
            radiograms: analysis.radiograms.iter().map(radiogram).collect(),
            stages,
            counts: BTreeMap::from([
                ("categories", analysis.categories.categories.len()),
                ("regions", analysis.regions.regions.len()),
                ("lines", analysis.lines.len()),
                ("vertices", analysis.subdivision.vertex_count()),
                ("edges", analysis.subdivision.edge_count()),
                ("faces", analysis.subdivision.faces().len()),
                ("places", context.semantic.places.len()),
                ("locations", context.locations.len()),
            ]),
            diagnostics: analysis.diagnostics.iter().map(Into::into).collect(),
            warnings: context.record.warnings.iter().map(Into::into).collect(),
        }
    }
}
