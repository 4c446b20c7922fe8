//! Whether a graph can be driven. Cost: O(cells along the lanes).

use rayon::prelude::*;

use super::components::GraphComponent;
use super::lane_network::LaneNetwork;
use crate::graph::Lane;
use crate::routing::Router;
use crate::site_map::SiteMap;

/// Clearances are compared to within this, metres: above the rounding of sums, far below a cell.
const ROUNDING_M: f64 = 1e-9;

/// Whether a graph can be driven. All but the count are `None` for a graph without nodes (true there).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ValidationFigures {
    /// Every lane keeps the vehicle's radius from obstacles all along: in every cell that it crosses (`collision_free`, which
    /// looks at the straight line between the nodes).
    pub collision_free: Option<bool>,
    /// Every node keeps it, too (`node_validity`).
    pub node_validity: Option<bool>,
    /// All nodes are joined (`connectivity`).
    pub connectivity: Option<bool>,
    /// Components of nodes that are joined (`num_subgraphs`).
    pub subgraphs: usize,
    /// Every lane is longer than nothing and no longer than the diagonal of the map (`edge_length_validity`).
    pub edge_length_validity: Option<bool>,
}

pub(super) fn validation(
    map: &SiteMap<'_>,
    router: &Router,
    network: &LaneNetwork<'_>,
    components: &[GraphComponent],
) -> ValidationFigures {
    let has_room = |clearance: f64| clearance > 0.0 && clearance + ROUNDING_M >= router.radius();
    let diagonal = (map.grid.width() as f64).hypot(map.grid.height() as f64) * map.grid.resolution();
    let when_any = |holds: &dyn Fn() -> bool| (network.len() > 0).then(holds);
    let lanes = &network.graph.lanes;
    ValidationFigures {
        collision_free: when_any(&|| lanes.par_iter().all(|lane| has_room(router.clearance_along(map, &lane.path)))),
        node_validity: when_any(&|| network.graph.nodes.iter().all(|node| has_room(map.clearance.at(node.position)))),
        connectivity: when_any(&|| components.len() == 1),
        subgraphs: components.len(),
        edge_length_validity: when_any(&|| {
            lanes.iter().map(Lane::length).all(|length| length > 0.0 && length <= diagonal)
        }),
    }
}
