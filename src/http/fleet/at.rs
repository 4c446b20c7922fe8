//! Where a pose is.

use std::sync::Arc;

use axum::extract::State;
use axum::response::Response;
use serde::{Deserialize, Serialize};
use stillage_core::whereabouts::{AislePosition, NearestLocation, Whereabouts, whereabouts};
use stillage_core::{Occupancy, Point};
use utoipa::{IntoParams, ToSchema};

use super::outside;
use super::vehicle::Numbers;
use crate::app::{App, Caller, MapContext};
use crate::coordinates::Transform;
use crate::features::{Naming, rounded, words};
use crate::http::docs::refusals::{NotAnalysed, NotFound};
use crate::http::extract::conditional::{EntityTag, IfNoneMatch};
use crate::http::extract::crs::CrsName;
use crate::http::extract::negotiation::Accept;
use crate::http::extract::{MapPath, Path, Query};
use crate::http::page;
use crate::http::problem::Problem;

/// A pose.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub struct PoseQuery {
    /// x and y in the coordinates of `crs`.
    #[param(value_type = String, pattern = "^-?[0-9]{1,9}([.][0-9]+)?,-?[0-9]{1,9}([.][0-9]+)?$", example = "0.00001,0.00002")]
    point: Numbers,
    /// Where it looks, degrees counter-clockwise from the x axis of the map frame.
    #[param(minimum = -360, maximum = 360)]
    heading: Option<f64>,
    /// System of the coordinates. CRS84 (longitude, latitude) when absent, as everywhere; `EPSG:3857` for the metres of the
    /// map frame (of a map without georeference).
    #[serde(default)]
    #[param(value_type = Option<CrsName>)]
    crs: CrsName,
}

/// Where a pose is.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Whereabouts)]
#[serde(rename_all = "camelCase")]
pub struct AtView {
    /// x and y, metres of the map frame.
    position: [f64; 2],
    /// What the cell under it shows: `free`, `occupied` or `unknown`.
    #[schema(example = "free")]
    ground: &'static str,
    /// What people call it: the name of the location it is in, else of its place, else of its aisle.
    name: Option<String>,
    /// The face; null outside the decomposed part of the map.
    face: Option<AtFace>,
    /// The place of that face.
    place: Option<AtPlace>,
    /// The aisle it is in.
    aisle: Option<AtAisle>,
    /// The nearest location; null in a map without locations.
    location: Option<AtLocation>,
}

/// The face at a pose.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "camelCase")]
pub struct AtFace {
    id: u32,
    /// Its category.
    category: u8,
    /// Id of its label.
    #[schema(example = "co")]
    label: String,
    /// Name of its label.
    #[schema(example = "corridor")]
    label_name: String,
    /// What its label is for.
    functionality: Vec<&'static str>,
    /// How sure the label is, 0 to 1.
    confidence: f64,
    /// Id of its region.
    region: u8,
}

/// The place at a pose.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "camelCase")]
pub struct AtPlace {
    id: u32,
    /// Its name.
    name: Option<String>,
    /// Its groups.
    groups: Vec<String>,
    /// Id of its label.
    #[schema(example = "co")]
    label: String,
    /// Number of the room it is, if walls bound it.
    room: Option<u32>,
}

/// The aisle at a pose.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "camelCase")]
pub struct AtAisle {
    id: u32,
    /// Its name.
    name: Option<String>,
    /// Where it points, degrees counter-clockwise from the x axis of the map frame.
    heading_deg: f64,
    /// Distance from its start, metres.
    from_start_m: f64,
    /// Whether the pose looks `along` the aisle or `against` it; null without a heading.
    direction: Option<&'static str>,
    /// Code of the location to the left of the heading.
    left: Option<String>,
    /// Code of the location to the right of the heading.
    right: Option<String>,
}

/// The location nearest to a pose.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "camelCase")]
pub struct AtLocation {
    #[schema(example = "03-012")]
    code: String,
    /// Its name.
    name: Option<String>,
    /// Distance from its border, metres; 0 inside.
    distance_m: f64,
    /// Its side of its aisle: `left` or `right`.
    side: Option<&'static str>,
}

/// Where is this pose?
///
/// The ground under it, its face, place and aisle, with the bays to its left and right if it has a heading, and the nearest
/// location. Whatever the ground, what there is to say is said; a point outside the map is a 404 that names the nearest one.
#[utoipa::path(get, path = "/v1/maps/{mapId}/at", tag = "fleet", operation_id = "locatePose", params(MapPath, PoseQuery),
    responses((status = 200, description = "Where it is",
        content((AtView = "application/json"), (String = "text/html")),
        headers(("ETag" = String, description = "Changes with the map, its analysis, its labels and its names"))),
        NotFound, NotAnalysed))]
pub async fn get(
    State(app): State<Arc<App>>,
    caller: Caller,
    Path(path): Path<MapPath>,
    Query(query): Query<PoseQuery>,
    accept: Accept,
    if_none_match: IfNoneMatch,
) -> Result<Response, Problem> {
    let &[x, y] = query.point.0.as_slice() else {
        return Err(Problem::parameter("point", "must be x,y"));
    };
    if query.heading.is_some_and(|heading| !(-360.0..=360.0).contains(&heading)) {
        return Err(Problem::parameter("heading", "must be degrees from -360 to 360"));
    }
    let context = app.context(&caller, path.map_id.0).await?;
    let transform =
        query.crs.transform(context.record.georeference).map_err(|detail| Problem::parameter("crs", detail))?;
    // Microseconds to a millisecond: no thread of its own.
    let view = locate(&context, &transform, [x, y], query.heading)?;
    let tag = EntityTag::of_map(&page::kind("at", &accept), &context);
    Ok(tag.answer(&if_none_match, || page::answer(&accept, "Where a pose is", &view)))
}

fn locate(context: &MapContext, transform: &Transform, at: [f64; 2], heading: Option<f64>) -> Result<AtView, Problem> {
    let frame = &context.analysis.frame;
    let position = transform.inverse(at);
    let point = frame.to_grid(position);
    let heading = heading.map(|degrees| degrees.to_radians() - frame.angle_to_map(0.0));
    let found = whereabouts(&context.site(), &context.layout, point, heading);
    let found = found.ok_or_else(|| outside::refusal(context, transform, at))?;
    Ok(AtView::new(context, &found, position))
}

impl AtView {
    fn new(context: &MapContext, found: &Whereabouts, position: Point) -> Self {
        let Whereabouts { ground, face, place, aisle, location } = *found;
        let names = &context.names;
        let place_naming = place.map(|place| names.place(place as usize)).unwrap_or_default();
        let aisle_naming = aisle.map(|aisle| names.aisle(aisle.aisle)).unwrap_or_default();
        let inside = location.filter(|nearest| nearest.distance == 0.0);
        let name = inside.and_then(|nearest| names.location(nearest.location).name);
        let face_view = |face: stillage_core::arrangement::FaceId| {
            let (label, annotation) = (context.semantic.label(face), &context.analysis.faces[face.index()]);
            AtFace {
                id: face.0,
                category: annotation.category,
                label: label.id.clone(),
                label_name: label.name.clone(),
                functionality: label.functionality.iter().copied().map(words::functionality).collect(),
                confidence: rounded(context.semantic.confidences[face.index()]),
                region: annotation.region,
            }
        };
        let place_view = |id: u32| {
            let place = &context.semantic.places[id as usize];
            let label = context.semantic.rule_set.label(place.label).id.clone();
            let Naming { name, groups } = place_naming.clone();
            AtPlace { id, name, groups, label, room: place.room }
        };
        Self {
            position: [rounded(position.x), rounded(position.y)],
            ground: match ground {
                Occupancy::Free => "free",
                Occupancy::Occupied => "occupied",
                Occupancy::Unknown => "unknown",
            },
            name: name.or_else(|| place_naming.name.clone()).or_else(|| aisle_naming.name.clone()),
            face: face.map(face_view),
            place: place.map(place_view),
            aisle: aisle.map(|aisle| aisle_view(context, aisle, aisle_naming)),
            location: location.map(|nearest| location_view(context, nearest)),
        }
    }
}

fn aisle_view(context: &MapContext, position: AislePosition, naming: Naming) -> AtAisle {
    let aisle = &context.layout.aisles[position.aisle];
    let code = |location: Option<usize>| location.map(|index| context.layout.locations[index].code.clone());
    AtAisle {
        id: aisle.number,
        name: naming.name,
        heading_deg: context.view().heading_degrees(aisle.heading()),
        from_start_m: rounded(position.from_start),
        direction: position.is_along.map(|is_along| if is_along { "along" } else { "against" }),
        left: code(position.left),
        right: code(position.right),
    }
}

fn location_view(context: &MapContext, nearest: NearestLocation) -> AtLocation {
    let location = &context.layout.locations[nearest.location];
    AtLocation {
        code: location.code.clone(),
        name: context.names.location(nearest.location).name,
        distance_m: rounded(nearest.distance),
        side: location.side.map(words::side),
    }
}
