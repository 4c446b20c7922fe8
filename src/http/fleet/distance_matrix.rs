//! Lengths and times between many ends.

use std::sync::Arc;

use axum::Json;
use axum::extract::State;
use serde::{Deserialize, Serialize};
use stillage_core::routing::Waypoint;
use utoipa::ToSchema;

use super::vehicle::{self, Footprint, Numbers};
use super::waypoint::End;
use crate::app::{App, Caller, MapContext};
use crate::blocking::off_the_runtime;
use crate::http::docs::refusals::{NotAnalysed, NotFound};
use crate::http::extract::crs::CrsName;
use crate::http::extract::{JsonBody, MapPath, Path};
use crate::http::problem::Problem;

/// Pairs of one request at most: 200 to 200.
const MOST_PAIRS: usize = 40_000;

/// From where to where, for which vehicle.
#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields, rename_all = "camelCase")]
pub struct MatrixRequest {
    /// Where ways begin: `x,y`, `face:ID`, `place:ID`, `location:CODE` or `name:NAME`.
    from: Vec<End>,
    /// Where they end, likewise; `from` when absent.
    to: Option<Vec<End>>,
    /// System of the coordinates; CRS84 when absent.
    #[serde(default)]
    #[schema(required = false)]
    crs: CrsName,
    /// Distance that the middle of the vehicle keeps from obstacles, metres.
    #[serde(rename = "footprintRadiusM")]
    footprint_radius: Option<f64>,
    /// Outline of the vehicle in its place: x and y of its corners, metres. Ways are those of the circle around it.
    #[schema(value_type = Option<String>)]
    footprint: Option<Numbers>,
    /// Ids of faces that may not be driven on.
    #[serde(default)]
    blocked_faces: Vec<u32>,
    /// Ids of edges that may not be crossed.
    #[serde(default)]
    blocked_edges: Vec<u32>,
    /// Mean speed for the times, metres per second; 1.5 when absent.
    speed_mps: Option<f64>,
}

/// Lengths and times, a row for each start.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = DistanceMatrix)]
#[serde(rename_all = "camelCase")]
pub struct MatrixView {
    /// Lengths, metres; null where no way leads.
    lengths_m: Vec<Vec<Option<f64>>>,
    /// Times at the mean speed, seconds; null where no way leads.
    times_s: Vec<Vec<Option<f64>>>,
    /// Distance that the middle of the vehicle keeps from obstacles, metres.
    footprint_radius_m: f64,
}

/// Measure ways between many ends
///
/// lengths are those of routes to within three percent. What has no way is null: `GET …/routes` says why.
#[utoipa::path(post, path = "/v1/maps/{mapId}/distance-matrix", tag = "fleet", operation_id = "getDistanceMatrix", security(("key" = ["read"]), ()),
    params(MapPath), request_body = MatrixRequest,
    responses((status = 200, description = "The lengths and times", body = MatrixView), NotFound, NotAnalysed))]
pub async fn create(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<MapPath>,
    JsonBody(body): JsonBody<MatrixRequest>,
) -> Result<Json<MatrixView>, Problem> {
    let pairs = body.from.len() * body.to.as_ref().unwrap_or(&body.from).len();
    if pairs == 0 || pairs > MOST_PAIRS {
        let detail = format!("{pairs} pairs of ends: give 1 to {MOST_PAIRS}, in several requests if need be");
        let culprit = if body.to.as_deref().is_some_and(<[End]>::is_empty) { "/to" } else { "/from" };
        return Err(Problem::invalid(culprit, detail));
    }
    let context = app.context(&caller, path.map_id.0).await?;
    off_the_runtime(move || measure(&context, &body).map(Json).map_err(Problem::in_body)).await
}

fn measure(context: &MapContext, body: &MatrixRequest) -> Result<MatrixView, Problem> {
    let transform =
        body.crs.transform(context.record.georeference).map_err(|detail| Problem::invalid("/crs", detail))?;
    let radius = Footprint::of(context, body.footprint_radius, body.footprint.as_ref())?.turning_radius();
    let speed = vehicle::speeds(body.speed_mps, None, None)?.speed;
    let blocked = vehicle::blocked(context, &body.blocked_faces, &body.blocked_edges)?;
    let waypoints = |ends: &[End]| -> Result<Vec<Waypoint<'_>>, Problem> {
        ends.iter().map(|end| end.waypoint(context, &transform)).collect()
    };
    let from = waypoints(&body.from)?;
    let to = body.to.as_deref().map_or_else(|| Ok(from.clone()), waypoints)?;
    let lengths = context.router(radius, blocked).matrix(&context.site(), &from, &to);
    let rows = |value: &dyn Fn(f64) -> f64| {
        let row = |row: &Vec<Option<f64>>| {
            row.iter().map(|length| length.map(|length| (value(length) * 1e3).round() / 1e3)).collect()
        };
        lengths.iter().map(row).collect()
    };
    Ok(MatrixView {
        lengths_m: rows(&|length| length),
        times_s: rows(&|length| length / speed),
        footprint_radius_m: radius,
    })
}
