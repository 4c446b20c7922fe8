//! Routes between two places of a map.

use std::sync::Arc;

use axum::extract::State;
use axum::http::header;
use axum::response::{IntoResponse, Response};
use serde::{Deserialize, Serialize};
use stillage_core::Point;
use stillage_core::arrangement::FaceId;
use stillage_core::routing::{self, Waypoint};
use utoipa::{IntoParams, ToSchema};

use crate::app::{App, Caller, MapContext};
use crate::blocking::off_the_runtime;
use crate::coordinates::Transform;
use crate::features::Geometry;
use crate::formats::geojson;
use crate::http::docs::refusals::{NotAnalysed, NotFound};
use crate::http::extract::crs::CrsName;
use crate::http::extract::{MapPath, Path, Query};
use crate::http::links::GEO_JSON;
use crate::http::ogc::items::CONTENT_CRS;
use crate::http::problem::Problem;

/// From where to where.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub struct RouteQuery {
    /// Where it begins: `x,y` in the coordinates of `crs`, `face:ID`, or `location:CODE`.
    #[param(value_type = String, pattern = "^(face:[0-9]{1,9}|location:.+|-?[0-9]{1,9}([.][0-9]+)?,-?[0-9]{1,9}([.][0-9]+)?)$", example = "face:3")]
    from: End,
    /// Where it ends, likewise. At a location a route ends before the location's access edge.
    #[param(value_type = String, pattern = "^(face:[0-9]{1,9}|location:.+|-?[0-9]{1,9}([.][0-9]+)?,-?[0-9]{1,9}([.][0-9]+)?)$", example = "location:01-002")]
    to: End,
    /// System of the coordinates, of `from` and `to` and of the answer alike. CRS84 (longitude, latitude) when absent,
    /// as everywhere; `EPSG:3857` for the metres of the map frame (of a map without georeference).
    #[serde(default)]
    #[param(value_type = Option<CrsName>)]
    crs: CrsName,
}

/// An end of a route as a parameter.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(try_from = "String")]
enum End {
    Position([f64; 2]),
    Face(u32),
    Location(String),
}

impl TryFrom<String> for End {
    type Error = &'static str;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        if let Some(code) = text.strip_prefix("location:") {
            return Ok(Self::Location(code.to_owned()));
        }
        if let Some(face) = text.strip_prefix("face:") {
            return face.parse().map(Self::Face).map_err(|_| "must name a face by its number, like face:3");
        }
        let number = |part: &str| part.trim().parse::<f64>().ok().filter(|number| number.is_finite());
        let position = text.split_once(',').and_then(|(x, y)| Some([number(x)?, number(y)?]));
        position.map(Self::Position).ok_or("must be x,y or face:ID or location:CODE")
    }
}

impl End {
    /// The waypoint in the map.
    fn waypoint(&self, context: &MapContext, transform: &Transform) -> Result<Waypoint, Problem> {
        match self {
            Self::Position(position) => {
                let in_map = transform.inverse(*position);
                Ok(Waypoint::Point(context.analysis.frame.to_grid(in_map)))
            }
            Self::Face(face) if (1..context.analysis.subdivision.face_count()).contains(&(*face as usize)) => {
                Ok(Waypoint::Face(FaceId(*face)))
            }
            Self::Face(face) => Err(Problem::not_found(format!("there is no face {face}"))),
            Self::Location(code) => {
                let location = context.layout.locations.iter().find(|location| location.code == *code);
                let missing = || Problem::not_found(format!("there is no location {code}"));
                location.cloned().map(|location| Waypoint::Location(Box::new(location))).ok_or_else(missing)
            }
        }
    }
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
    /// Faces crossed, in order.
    faces: Vec<u32>,
    /// Edges crossed between them, in order.
    edges: Vec<u32>,
}

/// Find a route
///
/// The shortest way over connected links between drivable places, on free cells. Where there is none, the 404 says why
/// by its type: `/problems/route-outside`, `route-not-drivable`, `route-blocked`, `route-no-access`,
/// `route-disconnected` or `route-obstructed`.
#[utoipa::path(get, path = "/v1/maps/{mapId}/routes", tag = "fleet", operation_id = "getRoute",
    params(MapPath, RouteQuery),
    responses((status = 200, description = "The route", body = RouteView, content_type = "application/geo+json",
        headers(("Content-Crs" = String, description = "System of the coordinates"))),
        NotFound, NotAnalysed))]
pub async fn get(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<MapPath>,
    Query(query): Query<RouteQuery>,
) -> Result<Response, Problem> {
    let context = app.context(&caller, path.map_id.0).await?;
    off_the_runtime(move || {
        let transform = Transform::new(query.crs.0, context.record.georeference);
        let [from, to] = [&query.from, &query.to].map(|end| end.waypoint(&context, &transform));
        let route = routing::route(context.site(), &from?, &to?)?;
        let headers =
            [(header::CONTENT_TYPE, GEO_JSON.parse().expect("is a header")), (CONTENT_CRS, query.crs.header())];
        Ok((headers, write(&context, &transform, &route)).into_response())
    })
    .await
}

fn write(context: &MapContext, transform: &Transform, route: &routing::Route) -> Vec<u8> {
    let mut points: Vec<Point> = route.path.iter().map(|&point| context.analysis.frame.to_map(point)).collect();
    // A way from a place to itself is still a line for GeoJSON.
    if let [only] = points[..] {
        points.push(only);
    }
    let properties = RouteProperties {
        length_m: route.length,
        faces: route.faces.iter().map(|face| face.0).collect(),
        edges: route.edges.iter().map(|edge| edge.0).collect(),
    };
    let document = geojson::GeoJsonFeature {
        id: None,
        geometry: &Geometry::LineString(points),
        properties: &properties,
        members: &[],
    };
    geojson::document(&document, transform)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_are_positions_faces_or_locations() {
        let end = |text: &str| End::try_from(text.to_owned()).ok();
        assert_eq!(end("1.5,-2"), Some(End::Position([1.5, -2.0])));
        assert_eq!(end("face:3"), Some(End::Face(3)));
        assert_eq!(end("location:01-002"), Some(End::Location("01-002".to_owned())));
        for wrong in ["", "1", "1,2,3", "x,y", "NaN,0", "face:x", "face:-1", "place:3"] {
            assert_eq!(end(wrong), None, "{wrong}");
        }
    }
}
