//! Faces, edges and vertices of the subdivision; nodes and links of its dual.

use serde_json::{Map, Value, json};
use stillage_core::Point;
use stillage_core::annotation::Evidence;
use stillage_core::arrangement::{EdgeId, EdgeSource, FaceId, Subdivision};
use stillage_core::semantics::Functionality;

use super::feature::{Feature, FeatureId, Geometry};
use super::rings::{polygons, simple_rings};
use super::{MapView, heading_degrees, orientation_degrees, rounded};

/// The properties of a feature from a list of names and values.
pub(super) fn properties<const N: usize>(entries: [(&str, Value); N]) -> Map<String, Value> {
    entries.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

pub(super) fn number_id(index: usize) -> FeatureId {
    FeatureId::Number(index as u64)
}

const fn evidence(evidence: Evidence) -> &'static str {
    match evidence {
        Evidence::Observed => "observed",
        Evidence::Interpolated => "interpolated",
    }
}

/// The shape of a face. A boundary that touches itself is cut there, so that the polygon is valid.
pub(super) fn face_geometry(view: &MapView<'_>, face: FaceId) -> Geometry {
    let subdivision = &view.analysis.subdivision;
    let walk = |&start| subdivision.cycle(start).map(|half| subdivision.half_edge(half).origin).collect::<Vec<_>>();
    let rings = subdivision.cycles(face).iter().map(walk).flat_map(simple_rings);
    let points =
        |ring: Vec<_>| ring.into_iter().map(|vertex| map_position(view, subdivision.position(vertex))).collect();
    Geometry::area(polygons(rings.map(points).collect()))
}

pub(super) fn map_position(view: &MapView<'_>, point: Point) -> Point {
    view.analysis.frame.to_map(point)
}

/// The edges around a face, ascending, each once.
fn face_edges(subdivision: &Subdivision, face: FaceId) -> Vec<u32> {
    let mut edges: Vec<u32> = subdivision.boundary(face).map(|half| half.edge().0).collect();
    edges.sort_unstable();
    edges.dedup();
    edges
}

/// What a label says of a place: its id, its name and what it is for.
pub(super) fn label_values(view: &MapView<'_>, label: stillage_core::semantics::LabelId) -> [Value; 3] {
    let label = view.semantic.rule_set.label(label);
    let words: Vec<&Functionality> = label.functionality.iter().collect();
    [json!(label.id), json!(label.name), json!(words)]
}

pub(super) fn faces(view: &MapView<'_>) -> Vec<Feature> {
    let subdivision = &view.analysis.subdivision;
    let mut codes = vec![None; subdivision.face_count()];
    for location in view.locations {
        codes[location.face.index()] = Some(location.code.as_str());
    }
    subdivision
        .faces()
        .map(|face| {
            let annotation = &view.analysis.faces[face.index()];
            let [label, label_name, functionality] = label_values(view, view.semantic.labels[face.index()]);
            let numbers = |shares: &[f32]| shares.iter().map(|&share| rounded(f64::from(share))).collect::<Vec<f64>>();
            let membership = annotation.membership.as_deref().map(numbers);
            let properties = properties([
                ("id", json!(face.0)),
                ("category", json!(annotation.category)),
                ("categoryShares", json!(numbers(&annotation.category_shares))),
                ("membership", json!(membership)),
                ("label", label),
                ("labelName", label_name),
                ("functionality", functionality),
                ("confidence", json!(rounded(view.semantic.confidences[face.index()]))),
                ("evidence", json!(evidence(annotation.evidence))),
                ("areaM2", json!(rounded(annotation.area))),
                ("lengthM", json!(rounded(annotation.extent[0]))),
                ("widthM", json!(rounded(annotation.extent[1]))),
                ("orientation", json!(orientation_degrees(view, annotation.heading))),
                ("elongation", json!(rounded(annotation.elongation))),
                ("freeFraction", json!(rounded(annotation.free_fraction))),
                ("occupiedFraction", json!(rounded(annotation.occupied_fraction))),
                ("unknownFraction", json!(rounded(annotation.unknown_fraction))),
                ("region", json!(annotation.region)),
                ("edges", json!(face_edges(subdivision, face))),
                ("place", json!(view.semantic.face_places[face.index()])),
                ("location", json!(codes[face.index()])),
            ]);
            Feature::new(number_id(face.index()), face_geometry(view, face), properties)
        })
        .collect()
}

/// The id of a face, `null` for the unbounded one.
fn side(face: FaceId) -> Value {
    if face == FaceId::OUTER { Value::Null } else { json!(face.0) }
}

pub(super) fn edges(view: &MapView<'_>) -> Vec<Feature> {
    let subdivision = &view.analysis.subdivision;
    subdivision
        .edges()
        .map(|edge| {
            let annotation = &view.analysis.edges[edge.index()];
            let [start, end] = subdivision.segment(edge);
            let along = end - start;
            let [left, right] = subdivision.sides(edge);
            let line = match subdivision.source(edge) {
                EdgeSource::Boundary => None,
                EdgeSource::Line(line) => Some(line),
            };
            let properties = properties([
                ("id", json!(edge.0)),
                ("faceLeft", side(left)),
                ("faceRight", side(right)),
                ("cogency", json!(view.semantic.cogency[edge.index()])),
                ("lengthM", json!(rounded(along.norm()))),
                ("support", json!(rounded(annotation.support))),
                ("open", json!(rounded(annotation.open))),
                ("confidence", json!(rounded(annotation.confidence))),
                ("evidence", json!(evidence(annotation.evidence))),
                ("disagreement", json!(view.semantic.disagreements[edge.index()])),
                ("link", json!(has_link(view, edge).then_some(edge.0))),
                ("orientation", json!(orientation_degrees(view, along.y.atan2(along.x)))),
                ("line", json!(line)),
            ]);
            let path = vec![map_position(view, start), map_position(view, end)];
            Feature::new(number_id(edge.index()), Geometry::LineString(path), properties)
        })
        .collect()
}

/// Whether an edge has a dual: edges on the outer boundary have none.
pub(super) fn has_link(view: &MapView<'_>, edge: EdgeId) -> bool {
    view.semantic.connectivity[edge.index()].is_some()
}

pub(super) fn vertices(view: &MapView<'_>) -> Vec<Feature> {
    let subdivision = &view.analysis.subdivision;
    let mut edges = vec![Vec::new(); subdivision.vertex_count()];
    for edge in subdivision.edges() {
        for vertex in subdivision.ends(edge) {
            edges[vertex.index()].push(edge.0);
        }
    }
    subdivision
        .vertices()
        .map(|vertex| {
            let properties = properties([("id", json!(vertex.0)), ("edges", json!(edges[vertex.index()]))]);
            let position = map_position(view, subdivision.position(vertex));
            Feature::new(number_id(vertex.index()), Geometry::Point(position), properties)
        })
        .collect()
}

pub(super) fn nodes(view: &MapView<'_>) -> Vec<Feature> {
    let graph = &view.analysis.graph;
    view.analysis
        .subdivision
        .faces()
        .map(|face| {
            let properties = properties([
                ("id", json!(face.0)),
                ("face", json!(face.0)),
                ("label", json!(view.semantic.label(face).id)),
                ("degree", json!(graph.links(face).len())),
            ]);
            let position = map_position(view, graph.position(face));
            Feature::new(number_id(face.index()), Geometry::Point(position), properties)
        })
        .collect()
}

/// Links run from node to node through the middle of their edge.
pub(super) fn links(view: &MapView<'_>) -> Vec<Feature> {
    let (subdivision, graph) = (&view.analysis.subdivision, &view.analysis.graph);
    subdivision
        .edges()
        .filter(|&edge| has_link(view, edge))
        .map(|edge| {
            let sides = subdivision.sides(edge);
            let [from, to] = sides;
            let properties = properties([
                ("id", json!(edge.0)),
                ("from", json!(from.0)),
                ("to", json!(to.0)),
                ("connectivity", json!(view.semantic.connectivity[edge.index()])),
                ("drivable", json!(view.semantic.is_drivable_link(edge, sides))),
                ("edge", json!(edge.0)),
            ]);
            let [start, end] = subdivision.segment(edge);
            let path = [graph.position(from), nalgebra::center(&start, &end), graph.position(to)];
            let path = path.map(|point| map_position(view, point)).to_vec();
            Feature::new(number_id(edge.index()), Geometry::LineString(path), properties)
        })
        .collect()
}

/// A position among the properties.
pub(super) fn position_value(view: &MapView<'_>, point: Point) -> Value {
    let point = map_position(view, point);
    json!([rounded(point.x), rounded(point.y)])
}

/// A heading among the properties.
pub(super) fn heading_value(view: &MapView<'_>, angle: f64) -> Value {
    json!(heading_degrees(view, angle))
}
