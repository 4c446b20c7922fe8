//! What there is to say of the navigation graph of a map, as a document and as a picture.

use std::sync::Arc;

use axum::extract::State;
use axum::http::header;
use axum::response::{IntoResponse, Response};
use serde::Deserialize;
use stillage_core::Watch;
use stillage_core::graph::NavigationGraph;
use stillage_core::graph_report::{GraphReport, ReportOptions, graph_report};
use stillage_core::routing::Blocked;
use utoipa::IntoParams;

use super::vehicle::Footprint;
use crate::app::{App, AppError, Caller, MapContext};
use crate::http::docs::binary::Binary;
use crate::http::docs::refusals::{NotAnalysed, NotFound};
use crate::http::extract::conditional::{EntityTag, IfNoneMatch};
use crate::http::extract::negotiation::Accept;
use crate::http::extract::{MapPath, Path, Query};
use crate::http::links::PNG;
use crate::http::page;
use crate::http::problem::Problem;
use crate::render;
use crate::views::graph_report::GraphReportView;

/// Widest passage that is asked for, metres: twice the widest vehicle.
const WIDEST_PASSAGE_M: f64 = 20.0;
/// Random pairs of nodes at most: a second on the largest maps for each ten thousand.
const MOST_SAMPLES: usize = 10_000;

/// For which vehicle, and what is told.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields, rename_all = "camelCase")]
pub struct ReportQuery {
    /// Distance that the middle of the vehicle keeps from obstacles, metres; half the vehicle width of the analysis when
    /// absent.
    #[param(value_type = Option<f64>, minimum = 0, maximum = 10)]
    #[serde(rename = "footprintRadiusM")]
    footprint_radius: Option<f64>,
    /// Passages narrower than this are told, metres; the width of the vehicle and 0.2 m when absent.
    #[param(value_type = Option<f64>, minimum = 0, maximum = 20)]
    #[serde(rename = "minPassageWidthM")]
    min_passage_width: Option<f64>,
    /// Random pairs of nodes between which ways are looked for; 1000 when absent.
    #[param(value_type = Option<usize>, minimum = 1, maximum = 10000)]
    samples: Option<usize>,
    /// The number that the pairs follow from; 0 when absent.
    #[serde(default)]
    #[param(value_type = Option<u32>)]
    seed: u32,
}

impl ReportQuery {
    /// The radius of the vehicle, metres, and the options.
    fn checked(&self, context: &MapContext) -> Result<(f64, ReportOptions), Problem> {
        let radius = Footprint::of(context, self.footprint_radius, None)?.turning_radius();
        let usual = ReportOptions::for_radius(radius);
        let min_passage_width = self.min_passage_width.unwrap_or(usual.min_passage_width);
        if !(0.0..=WIDEST_PASSAGE_M).contains(&min_passage_width) {
            let detail = format!("{min_passage_width} is outside 0 to {WIDEST_PASSAGE_M} m");
            return Err(Problem::parameter("minPassageWidthM", detail));
        }
        let samples = self.samples.unwrap_or(usual.samples);
        if !(1..=MOST_SAMPLES).contains(&samples) {
            return Err(Problem::parameter("samples", format!("{samples} is outside 1 to {MOST_SAMPLES}")));
        }
        Ok((radius, ReportOptions { min_passage_width, samples, seed: self.seed.into() }))
    }
}

/// Report on the navigation graph
///
/// What fleet people ask of a map before vehicles drive on it: what belongs together, dead ends, locations that no lane leads
/// to and why, narrow passages, borders where labels and obstacles disagree, and the nineteen figures that the evaluation of
/// NVIDIA's SWAGGER defines. A map without drivable ground has an empty report.
#[utoipa::path(get, path = "/v1/maps/{mapId}/graph-report", tag = "fleet", operation_id = "getGraphReport",
    params(MapPath, ReportQuery),
    responses((status = 200, description = "The report",
        content((GraphReportView = "application/json"), (String = "text/html")),
        headers(("ETag" = String, description = "Changes with the report"))),
        NotFound, NotAnalysed))]
pub async fn get(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<MapPath>,
    Query(query): Query<ReportQuery>,
    accept: Accept,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    let name = page::kind("graph-report", &accept);
    let answer = move |context: &MapContext, graph: &NavigationGraph, report: &GraphReport| {
        page::answer(&accept, "Report on the navigation graph", &GraphReportView::new(context, graph, report))
    };
    reported(&app, &caller, &path, &query, &if_none_match, &name, answer).await
}

/// Report on the navigation graph, as a picture
///
/// Lanes over the map in the colour of their component, dead ends, locations that are not reached, narrow passages, and borders
/// where labels and obstacles disagree.
#[utoipa::path(get, path = "/v1/maps/{mapId}/graph-report.png", tag = "fleet", operation_id = "getGraphReportImage",
    params(MapPath, ReportQuery),
    responses((status = 200, description = "The picture", body = Binary, content_type = "image/png",
        headers(("ETag" = String, description = "Changes with the picture"))),
        NotFound, NotAnalysed))]
pub async fn picture(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<MapPath>,
    Query(query): Query<ReportQuery>,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    let answer = |context: &MapContext, graph: &NavigationGraph, report: &GraphReport| {
        let png = render::graph_report_png(&context.site(), &context.layout, graph, report);
        ([(header::CONTENT_TYPE, PNG)], png).into_response()
    };
    reported(&app, &caller, &path, &query, &if_none_match, "graph-report.png", answer).await
}

/// Answers with a report, unless the client has it.
async fn reported(
    app: &App,
    caller: &Caller,
    path: &MapPath,
    query: &ReportQuery,
    if_none_match: &IfNoneMatch,
    name: &str,
    answer: impl FnOnce(&MapContext, &NavigationGraph, &GraphReport) -> Response + Send + 'static,
) -> Result<Response, Problem> {
    let context = app.context(caller, path.map_id.0).await?;
    let (radius, options) = query.checked(&context)?;
    let tag = EntityTag::of_map(&format!("{name} {radius} {options:?}"), &context);
    tag.answer_computed(if_none_match, move || {
        let (site, router) = (context.site(), context.router(radius, Blocked::default()));
        let graph = context.graph(radius);
        let report = graph_report(&site, &context.layout, &router, &graph, &options, &Watch::unwatched())
            .map_err(|_| AppError::Unavailable)?;
        Ok(answer(&context, &graph, &report))
    })
    .await
}
