//! Routes between two ends.

use std::sync::Arc;

use axum::extract::State;
use axum::http::{HeaderValue, header};
use axum::response::Response;
use serde::{Deserialize, Serialize};
use stillage_core::Point;
use stillage_core::routing::{self, OutlineRouters, Route, SpeedProfile, instructions};
use utoipa::{IntoParams, ToSchema};

use super::no_route;
use super::vehicle::{self, Footprint, Ids, LabelCosts, Numbers, ProfileName};
use super::waypoint::End;
use crate::app::{App, Caller, MapContext};
use crate::blocking::off_the_runtime;
use crate::coordinates::Transform;
use crate::features::{Geometry, Pose};
use crate::formats::geojson;
use crate::http::docs::refusals::{NotAnalysed, NotFound};
use crate::http::extract::crs::{CONTENT_CRS, CrsName};
use crate::http::extract::negotiation::Accept;
use crate::http::extract::{MapPath, Path, Query};
use crate::http::links::GEO_JSON;
use crate::http::page;
use crate::http::problem::{Problem, ProblemType};

/// Routes that are found at most for one request.
const MOST_ALTERNATIVES: usize = 5;

/// From where to where, for which vehicle.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields, rename_all = "camelCase")]
pub struct RouteQuery {
    /// Where it begins: `x,y` in the coordinates of `crs`, `face:ID`, `place:ID`, `location:CODE` or `name:NAME`.
    #[param(example = "face:3")]
    from: End,
    /// Where it ends, likewise. At a location a route ends where the vehicle stands to serve it.
    #[param(example = "location:01-002")]
    to: End,
    /// System of the coordinates, of `from` and `to` and of the answer alike. CRS84 (longitude, latitude) when absent,
    /// as everywhere; `EPSG:3857` for the metres of the map frame (of a map without georeference).
    #[serde(default)]
    #[param(value_type = Option<CrsName>)]
    crs: CrsName,
    /// Distance that the middle of the vehicle keeps from obstacles, metres; half the vehicle width of the analysis when
    /// absent, 0 for a point.
    #[param(value_type = Option<f64>, minimum = 0, maximum = 10)]
    #[serde(rename = "footprintRadiusM")]
    footprint_radius: Option<f64>,
    /// Outline of the vehicle in place of its radius: x and y of its corners in metres, x forwards from its middle. It
    /// drives forwards and turns on the spot where there is room. `alternatives` keep the circle around it clear.
    #[param(value_type = Option<String>, pattern = "^-?[0-9.]+(,-?[0-9.]+)*$")]
    footprint: Option<Numbers>,
    /// What is best: `shortest`, or `clearance` for distance from obstacles.
    #[serde(default)]
    #[param(inline)]
    profile: ProfileName,
    /// Factors from 1 on the length of ways over labels, by the id of a label or a functionality: `ju:2,connection:5`.
    #[serde(default)]
    #[param(value_type = Option<String>, pattern = "^[^:,]+:[0-9.]+(,[^:,]+:[0-9.]+)*$")]
    label_costs: LabelCosts,
    /// Ids of faces that may not be driven on.
    #[serde(default)]
    #[param(value_type = Option<String>, pattern = "^[0-9]{1,9}(,[0-9]{1,9})*$")]
    blocked_faces: Ids,
    /// Ids of edges that may not be crossed.
    #[serde(default)]
    #[param(value_type = Option<String>, pattern = "^[0-9]{1,9}(,[0-9]{1,9})*$")]
    blocked_edges: Ids,
    /// How many routes that differ are wanted; the others come as `alternatives` of the best.
    #[serde(default = "one")]
    #[param(value_type = Option<usize>, minimum = 1, maximum = 5)]
    alternatives: usize,
    /// Greatest speed for the time, metres per second; 1.5 when absent.
    #[param(value_type = Option<f64>, exclusive_minimum = 0, maximum = 20)]
    speed_mps: Option<f64>,
    /// Speeding up and braking, metres per second squared; 0.5 when absent.
    #[param(value_type = Option<f64>, exclusive_minimum = 0, maximum = 20)]
    acceleration_mps2: Option<f64>,
    /// Turning on the spot, degrees per second; 45 when absent.
    #[param(value_type = Option<f64>, exclusive_minimum = 0, maximum = 720)]
    turn_rate_degps: Option<f64>,
}

impl RouteQuery {
    /// Reads a query string.
    ///
    /// # Errors
    /// The parameter that is wrong.
    pub fn read(query: &str) -> Result<Self, Problem> {
        let address = format!("/?{query}").parse();
        let address =
            address.map_err(|_| Problem::new(ProblemType::BadParameter, "the parameters are no query string"));
        Query::read(&address?).map(|Query(query)| query)
    }
}

const fn one() -> usize {
    1
}

/// A way through the map, in GeoJSON.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Route)]
#[allow(dead_code, reason = "it describes what is written straight to bytes")]
pub struct RouteView {
    /// `Feature`
    #[schema(example = "Feature")]
    r#type: String,
    /// A `LineString`.
    #[schema(value_type = Object, example = json!({"type": "LineString", "coordinates": [[1.5, 2.0], [1.5, 8.25]]}))]
    geometry: serde_json::Value,
    properties: RouteProperties,
}

/// What there is to say of a route.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "camelCase")]
pub struct RouteProperties {
    /// Length of the path, metres.
    length_m: f64,
    /// Time for it, seconds: with the speeds asked for, stopping at sharp turns.
    time_s: f64,
    /// Radius of the vehicle, metres; of one with an outline that of the circle around it.
    footprint_radius_m: f64,
    /// Least distance between the path and an obstacle, metres, to within a cell.
    clearance_m: f64,
    /// Faces crossed, in order.
    faces: Vec<u32>,
    /// Edges crossed between them, in order.
    edges: Vec<u32>,
    /// Where the vehicle looks at the goal, map frame; at locations only.
    #[serde(skip_serializing_if = "Option::is_none")]
    goal_heading_deg: Option<f64>,
    /// Turn by turn.
    instructions: Vec<InstructionView>,
    /// Other routes: their coordinates, lengths and times.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    alternatives: Vec<AlternativeView>,
}

/// One step of turn-by-turn instructions.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Instruction)]
#[serde(rename_all = "camelCase")]
pub struct InstructionView {
    /// `depart`, `left`, `right`, `turn-around` or `arrive`.
    action: &'static str,
    /// For people.
    text: String,
    /// Where, map frame, metres, and where to look afterwards.
    #[schema(value_type = Object)]
    pose: Pose,
    /// Way to the next instruction, metres.
    length_m: f64,
}

/// Another route.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Alternative)]
#[serde(rename_all = "camelCase")]
pub struct AlternativeView {
    /// Length of the path, metres.
    length_m: f64,
    /// Time for it, seconds.
    time_s: f64,
    /// Faces crossed, in order.
    faces: Vec<u32>,
    /// The path, as the coordinates of a `LineString`.
    coordinates: Vec<[f64; 2]>,
}

/// Find a route
///
/// The best way over connected links between drivable places, clear of obstacles by the footprint of the vehicle. A vehicle
/// that stands beside drivable ground first drives out to it. Where there is no way, the 404 says why by its type, where,
/// and what would do: `/problems/route-outside`, `route-blocked`, `route-too-narrow`, `route-not-drivable`,
/// `route-no-access`, `route-cut-off` or `route-disconnected`.
#[utoipa::path(get, path = "/v1/maps/{mapId}/routes", tag = "fleet", operation_id = "getRoute",
    params(MapPath, RouteQuery),
    responses((status = 200, description = "The route",
        content((RouteView = "application/geo+json"), (String = "text/html")),
        headers(("Content-Crs" = String, description = "System of the coordinates"))),
        NotFound, NotAnalysed))]
pub async fn get(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<MapPath>,
    Query(query): Query<RouteQuery>,
    accept: Accept,
) -> Result<Response, Problem> {
    let context = app.context(&caller, path.map_id.0).await?;
    off_the_runtime(move || {
        let headers = [(header::CONTENT_TYPE, HeaderValue::from_static(GEO_JSON)), (CONTENT_CRS, query.crs.header())];
        Ok(page::answer_geojson(&accept, "Route", headers, answer(&context, &query)?))
    })
    .await
}

/// The GeoJSON of a route.
///
/// # Errors
/// A parameter that is wrong, or the reason why there is no route.
pub fn answer(context: &MapContext, query: &RouteQuery) -> Result<Vec<u8>, Problem> {
    if !(1..=MOST_ALTERNATIVES).contains(&query.alternatives) {
        let detail = format!("{} is outside 1 to {MOST_ALTERNATIVES}", query.alternatives);
        return Err(Problem::parameter("alternatives", detail));
    }
    let speeds = vehicle::speeds(query.speed_mps, query.acceleration_mps2, query.turn_rate_degps)?;
    let transform =
        query.crs.transform(context.record.georeference).map_err(|detail| Problem::parameter("crs", detail))?;
    let routes = find(context, query, &transform)?;
    Ok(RouteWriter { context, transform: &transform, speeds }.write(&routes))
}

/// The best route and the others, with the radius of the vehicle.
struct Found {
    radius: f64,
    routes: Vec<Route>,
}

fn find(context: &MapContext, query: &RouteQuery, transform: &Transform) -> Result<Found, Problem> {
    let footprint = Footprint::of(context, query.footprint_radius, query.footprint.as_ref())?;
    let radius = footprint.turning_radius();
    let preferences = vehicle::preferences(context, query.profile, &query.label_costs)?;
    let blocked = vehicle::blocked(context, &query.blocked_faces.0, &query.blocked_edges.0)?;
    let [from, to] = [&query.from, &query.to].map(|end| end.waypoint(context, transform));
    let (from, to) = (from?, to?);
    let router = context.router(radius, blocked.clone());
    let site = context.site();
    let routes = match footprint {
        _ if query.alternatives > 1 => router.alternatives(&site, &from, &to, &preferences, query.alternatives),
        Footprint::Disc(_) => router.route(&site, &from, &to, &preferences).map(|route| vec![route]),
        Footprint::Outline(outline) => {
            let passing = context.router(outline.passing_radius(), blocked);
            let routers = OutlineRouters { turning: &router, passing: &passing };
            routers.route(&site, &outline, &from, &to, &preferences).map(|route| vec![route])
        }
    };
    let routes = routes.map_err(|reason| no_route::problem(&reason, context, transform, radius))?;
    Ok(Found { radius, routes })
}

/// Writes routes as GeoJSON.
struct RouteWriter<'a> {
    context: &'a MapContext,
    transform: &'a Transform,
    speeds: SpeedProfile,
}

impl RouteWriter<'_> {
    fn write(&self, found: &Found) -> Vec<u8> {
        let [best, others @ ..] = found.routes.as_slice() else { return Vec::new() };
        let properties = RouteProperties {
            length_m: rounded(best.length),
            time_s: rounded(self.speeds.time(best)),
            footprint_radius_m: found.radius,
            clearance_m: rounded(best.clearance),
            faces: best.faces.iter().map(|face| face.0).collect(),
            edges: best.edges.iter().map(|edge| edge.0).collect(),
            goal_heading_deg: best.goal_heading.map(|heading| self.context.view().heading_degrees(heading)),
            instructions: self.instructions(best),
            alternatives: others.iter().map(|route| self.alternative(route)).collect(),
        };
        let points = best.path.iter().map(|&point| self.context.analysis.frame.to_map(point)).collect();
        let document = geojson::GeoJsonFeature {
            id: None,
            geometry: &Geometry::LineString(points),
            properties: &properties,
            members: &[],
        };
        geojson::document(&document, self.transform)
    }

    fn alternative(&self, route: &Route) -> AlternativeView {
        let frame = &self.context.analysis.frame;
        AlternativeView {
            length_m: rounded(route.length),
            time_s: rounded(self.speeds.time(route)),
            faces: route.faces.iter().map(|face| face.0).collect(),
            coordinates: route.path.iter().map(|&point| self.transform.forward(frame.to_map(point))).collect(),
        }
    }

    fn instructions(&self, route: &Route) -> Vec<InstructionView> {
        let steps = instructions(route);
        let step = |step: &routing::Instruction| {
            let (action, words) = words(step.action);
            let ahead = if step.length > 0.0 { format!(", drive {:.1} m", step.length) } else { String::new() };
            InstructionView {
                action,
                text: format!("{words}{}{ahead}", self.ground_of(step)),
                pose: self.pose(step.at, step.heading),
                length_m: rounded(step.length),
            }
        };
        steps.iter().map(step).collect()
    }

    /// Where a step leads along: ` in the corridor (place 12)`.
    fn ground_of(&self, step: &routing::Instruction) -> String {
        if step.length == 0.0 {
            return String::new();
        }
        let face = self.context.site().face_at(step.middle);
        let place = self.context.semantic.face_places.get(face.index()).copied().flatten();
        match place {
            Some(place) => format!(" in the {} (place {place})", self.context.semantic.label(face).name.to_lowercase()),
            None => String::new(),
        }
    }

    fn pose(&self, at: Point, heading: f64) -> Pose {
        let at = self.context.analysis.frame.to_map(at);
        Pose { x: rounded(at.x), y: rounded(at.y), heading_deg: self.context.view().heading_degrees(heading) }
    }
}

/// The word of an action, and what a person is told.
const fn words(action: routing::Action) -> (&'static str, &'static str) {
    match action {
        routing::Action::Depart => ("depart", "begin"),
        routing::Action::Left => ("left", "turn left"),
        routing::Action::Right => ("right", "turn right"),
        routing::Action::TurnAround => ("turn-around", "turn around"),
        routing::Action::Arrive => ("arrive", "arrive"),
    }
}

/// To a tenth of a millimetre.
fn rounded(value: f64) -> f64 {
    (value * 1e4).round() / 1e4
}
