//! The shapes of faces and of unions of faces.

use std::collections::HashSet;

use stillage_core::arrangement::{FaceId, HalfEdgeId, VertexId};
use stillage_core::geometry::polygon::simple_rings;

use super::geometry::Geometry;
use super::rings::polygons;
use super::view::AnalysedMap;

/// The shape of a face. A boundary that touches itself is cut there, so that the polygon is valid.
pub fn of_face(view: &AnalysedMap<'_>, face: FaceId) -> Geometry {
    let subdivision = &view.analysis.subdivision;
    let walk = |&start| subdivision.cycle(start).map(|half| subdivision.half_edge(half).origin).collect::<Vec<_>>();
    area(view, subdivision.cycles(face).iter().map(walk).flat_map(simple_rings))
}

/// The shape of a place, by its id: the union of its faces.
#[must_use]
pub fn place_shape(view: &AnalysedMap<'_>, place: u32) -> Geometry {
    let faces = &view.semantic.places[place as usize].faces;
    of_union(view, faces, |face| view.semantic.face_places[face.index()] == Some(place))
}

/// The union of faces: walks along the edges that have one of them on the left only.
pub fn of_union(view: &AnalysedMap<'_>, faces: &[FaceId], is_inside: impl Fn(FaceId) -> bool) -> Geometry {
    let subdivision = &view.analysis.subdivision;
    let is_boundary = |half: HalfEdgeId| !is_inside(subdivision.half_edge(half.twin()).face);
    let mut passed: HashSet<HalfEdgeId> = HashSet::new();
    let mut rings = Vec::new();
    for start in faces.iter().flat_map(|&face| subdivision.boundary(face)).filter(|&half| is_boundary(half)) {
        let mut walk = Vec::new();
        let mut half = start;
        while passed.insert(half) {
            walk.push(subdivision.half_edge(half).origin);
            half = subdivision.half_edge(half).next;
            // Turn about the vertex through the faces inside, until an edge leads out of them.
            while !is_boundary(half) {
                half = subdivision.half_edge(half.twin()).next;
            }
        }
        rings.extend(simple_rings(walk));
    }
    area(view, rings)
}

fn area(view: &AnalysedMap<'_>, rings: impl IntoIterator<Item = Vec<VertexId>>) -> Geometry {
    let subdivision = &view.analysis.subdivision;
    let points =
        |ring: Vec<VertexId>| ring.into_iter().map(|vertex| view.position(subdivision.position(vertex))).collect();
    Geometry::area(polygons(rings.into_iter().map(points).collect()))
}
