//! Places, the doors between them, and storage locations: the human level.

use std::collections::HashSet;

use serde_json::{Map, Value, json};
use stillage_core::arrangement::{FaceId, HalfEdgeId};
use stillage_core::layout::{ApproachPose, Location};
use stillage_core::rooms::Door;
use stillage_core::semantics::Place;

use super::feature::{Feature, FeatureId, Geometry};
use super::rings::{polygons, simple_rings};
use super::subdivision::{
    face_geometry, has_link, heading_value, label_values, map_position, number_id, position_value, properties,
};
use super::{MapView, rounded};

pub(super) fn places(view: &MapView<'_>) -> Vec<Feature> {
    let feature = |(index, place): (usize, &Place)| {
        let [label, label_name, functionality] = label_values(view, place.label);
        let faces: Vec<u32> = place.faces.iter().map(|face| face.0).collect();
        let properties = properties([
            ("id", json!(index)),
            ("label", label),
            ("labelName", label_name),
            ("functionality", functionality),
            ("areaM2", json!(rounded(place.area))),
            ("room", json!(place.room)),
            ("faces", json!(faces)),
        ]);
        Feature::new(number_id(index), place_geometry(view, index as u32, place), properties)
    };
    view.semantic.places.iter().enumerate().map(feature).collect()
}

/// Doors run from jamb to jamb.
pub(super) fn doors(view: &MapView<'_>) -> Vec<Feature> {
    let place = |face: FaceId| view.semantic.face_places[face.index()];
    let feature = |(index, door): (usize, &Door)| {
        let [from, to] = door.faces.map(place);
        let links: Vec<u32> = door.edges.iter().filter(|&&edge| has_link(view, edge)).map(|edge| edge.0).collect();
        let properties = properties([
            ("id", json!(index)),
            ("widthM", json!(rounded(door.width()))),
            ("from", json!(from)),
            ("to", json!(to)),
            ("links", json!(links)),
        ]);
        let path = door.ends.map(|end| map_position(view, end)).to_vec();
        Feature::new(number_id(index), Geometry::LineString(path), properties)
    };
    view.analysis.rooms.doors.iter().enumerate().map(feature).collect()
}

/// The union of the faces of a place: the edges that have it on the left only, walked around.
fn place_geometry(view: &MapView<'_>, index: u32, place: &Place) -> Geometry {
    let subdivision = &view.analysis.subdivision;
    let is_boundary = |half: HalfEdgeId| {
        let beyond = subdivision.half_edge(half.twin()).face;
        view.semantic.face_places[beyond.index()] != Some(index)
    };
    let mut passed: HashSet<HalfEdgeId> = HashSet::new();
    let mut rings = Vec::new();
    for start in place.faces.iter().flat_map(|&face| subdivision.boundary(face)).filter(|&half| is_boundary(half)) {
        let mut walk = Vec::new();
        let mut half = start;
        while passed.insert(half) {
            walk.push(subdivision.half_edge(half).origin);
            half = subdivision.half_edge(half).next;
            // Turn about the vertex through the faces of the place, until an edge leads out of it.
            while !is_boundary(half) {
                half = subdivision.half_edge(half.twin()).next;
            }
        }
        rings.extend(simple_rings(walk));
    }
    let points =
        |ring: Vec<_>| ring.into_iter().map(|vertex| map_position(view, subdivision.position(vertex))).collect();
    Geometry::area(polygons(rings.into_iter().map(points).collect()))
}

pub(super) fn locations(view: &MapView<'_>) -> Vec<Feature> {
    let feature = |location: &Location| {
        let id = FeatureId::Text(location.code.clone());
        Feature::new(id, face_geometry(view, location.face), location_properties(view, location))
    };
    view.locations.iter().map(feature).collect()
}

/// What is known of a location, as it stands in its feature and in the table of locations.
pub(super) fn location_properties(view: &MapView<'_>, location: &Location) -> Map<String, Value> {
    let [label, label_name, _] = label_values(view, location.label);
    let edges: Vec<u32> = location.access_edges.iter().map(|edge| edge.0).collect();
    let approach = |pose: ApproachPose| {
        let position = map_position(view, pose.position);
        json!({
            "x": rounded(position.x),
            "y": rounded(position.y),
            "headingDeg": heading_value(view, pose.heading),
        })
    };
    properties([
        ("code", json!(location.code)),
        ("face", json!(location.face.0)),
        ("label", label),
        ("labelName", label_name),
        ("aisle", json!(location.aisle)),
        ("bay", json!(location.bay)),
        ("side", json!(location.side)),
        ("centre", position_value(view, location.center)),
        ("widthM", json!(rounded(location.width))),
        ("depthM", json!(rounded(location.depth))),
        ("headingDeg", heading_value(view, location.heading)),
        ("occupancy", json!(location.occupancy)),
        ("accessEdges", json!(edges)),
        ("accessFrom", json!(location.access_from.map(|face| face.0))),
        ("approach", json!(location.approach.map(approach))),
    ])
}
