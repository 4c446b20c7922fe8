//! What belongs together: drivable faces by their links, and the nodes of the graph by their lanes.
//!
//! Faces that belong together by their labels may be kept apart by obstacles, or by the width of the vehicle: then the
//! graph has more components than the faces. Cost: O(edges + lanes).

use std::collections::BTreeMap;

use super::lane_network::LaneNetwork;
use crate::arrangement::FaceId;
use crate::geometry::DisjointSets;
use crate::layout::Layout;
use crate::site_map::SiteMap;

/// Drivable faces that drivable links join.
#[derive(Debug, Clone, PartialEq)]
pub struct FaceComponent {
    /// Its faces, ascending.
    pub faces: Vec<FaceId>,
    /// Area, square metres.
    pub area: f64,
    /// How many locations are reached from it.
    pub locations: usize,
}

/// Nodes of the graph that lanes join, whatever their direction.
#[derive(Debug, Clone, PartialEq)]
pub struct GraphComponent {
    /// Its nodes, ascending.
    pub nodes: Vec<usize>,
    /// How many pairs of them lanes join.
    pub pairs: usize,
    /// Length of the lanes, each pair once, metres.
    pub length: f64,
    /// How many of its nodes serve locations.
    pub approaches: usize,
}

/// The components of the drivable faces, the largest area first.
pub(super) fn of_faces(map: &SiteMap<'_>, layout: &Layout) -> Vec<FaceComponent> {
    let subdivision = &map.analysis.subdivision;
    let mut sets = DisjointSets::new(subdivision.face_count());
    for edge in subdivision.edges() {
        let [left, right] = subdivision.sides(edge);
        if left != FaceId::OUTER && right != FaceId::OUTER && map.semantic.is_drivable_link(edge, [left, right]) {
            sets.join(left.index(), right.index());
        }
    }
    let mut served: BTreeMap<FaceId, usize> = BTreeMap::new();
    for face in layout.locations.iter().filter_map(|location| location.access_from) {
        *served.entry(face).or_default() += 1;
    }
    let mut found: BTreeMap<usize, FaceComponent> = BTreeMap::new();
    for face in subdivision.faces().filter(|&face| map.is_drivable(face)) {
        let component = found.entry(sets.find(face.index())).or_insert_with(|| FaceComponent {
            faces: Vec::new(),
            area: 0.0,
            locations: 0,
        });
        component.faces.push(face);
        component.area += map.analysis.faces[face.index()].area;
        component.locations += served.get(&face).copied().unwrap_or(0);
    }
    let mut components: Vec<FaceComponent> = found.into_values().collect();
    components.sort_by(|one, other| other.area.total_cmp(&one.area).then(one.faces[0].cmp(&other.faces[0])));
    components
}

/// The components of the graph: first the one that serves the most locations, or else has the most nodes.
pub(super) fn of_graph(network: &LaneNetwork<'_>) -> Vec<GraphComponent> {
    let mut sets = DisjointSets::new(network.len());
    for (node, other) in network.pairs() {
        sets.join(node, other.node);
    }
    let mut found: BTreeMap<usize, GraphComponent> = BTreeMap::new();
    for node in 0..network.len() {
        let component = found.entry(sets.find(node)).or_insert_with(|| GraphComponent {
            nodes: Vec::new(),
            pairs: 0,
            length: 0.0,
            approaches: 0,
        });
        component.nodes.push(node);
        component.approaches += usize::from(network.node(node).location.is_some());
    }
    for (node, other) in network.pairs() {
        if let Some(component) = found.get_mut(&sets.find(node)) {
            component.pairs += 1;
            component.length += network.lane(other.lane).length();
        }
    }
    let mut components: Vec<GraphComponent> = found.into_values().collect();
    components.sort_by(|one, other| {
        let rank = |component: &GraphComponent| (component.approaches, component.nodes.len());
        rank(other).cmp(&rank(one)).then(one.nodes[0].cmp(&other.nodes[0]))
    });
    components
}
