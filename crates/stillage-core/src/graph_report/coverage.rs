//! How well a graph covers the free ground.
//!
//! Cost: O(cells). Memory: 8 bytes per cell.

use rayon::prelude::*;

use super::lane_network::LaneNetwork;
use crate::components::{Component, Components, Neighbours};
use crate::distance_transform::DistanceTransform;
use crate::grid::Occupancy;
use crate::site_map::SiteMap;
use crate::watch::{Stopped, Watch};

/// How well a graph covers the free ground.
///
/// Free ground are the free cells; those that touch, by a side or a corner, are one piece. A piece is covered when a node
/// lies in it. Distances are those as the crow flies, also across obstacles, over the cells of covered pieces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CoverageFigures {
    /// Share of the free ground that is covered, 0 to 1 (`free_space_coverage`).
    pub free_space_coverage: f64,
    /// Mean distance from a covered cell to the nearest node, metres; `None` where nothing is covered
    /// (`average_distance_to_node`, in pixels there).
    pub average_distance_to_node: Option<f64>,
    /// Largest such distance, metres (`max_distance_to_node`, in pixels there).
    pub max_distance_to_node: Option<f64>,
    /// Covered share over the number of nodes: how much one node is worth; 0 without nodes (`coverage_efficiency`).
    pub coverage_efficiency: f64,
}

pub(super) fn coverage(
    map: &SiteMap<'_>,
    network: &LaneNetwork<'_>,
    watch: &Watch<'_>,
) -> Result<CoverageFigures, Stopped> {
    let (width, cells) = (map.grid.width(), map.grid.cells());
    let mut has_node = vec![false; cells.len()];
    for node in &network.graph.nodes {
        if let Some((column, row)) = map.grid.cell_at(node.position) {
            has_node[row * width + column] = true;
        }
    }
    let is_free = |cell: usize| cells[cell] == Occupancy::Free;
    let pieces = Components::of([width, cells.len()], Neighbours::Eight, is_free, watch)?;
    let pieces: Vec<Component<'_>> = pieces.iter().collect();
    let free: usize = pieces.iter().map(Component::len).sum();
    let covered: Vec<Component<'_>> =
        pieces.into_par_iter().filter(|piece| piece.cells().any(|cell| has_node[cell])).collect();
    let count: usize = covered.iter().map(Component::len).sum();
    let share = count as f64 / free.max(1) as f64;
    let nearest = DistanceTransform::of(width, cells.len(), |cell| has_node[cell], watch)?;
    let distance = |cell: usize| f64::from(nearest.squared[cell]).sqrt();
    // Sums of pieces, each in its own order, so that no thread changes a bit.
    let sums: Vec<(f64, f64)> = covered
        .par_iter()
        .map(|piece| piece.cells().map(distance).fold((0.0, 0.0), |(sum, max), far| (sum + far, f64::max(max, far))))
        .collect();
    let (sum, max) = sums.into_iter().fold((0.0, 0.0), |all, one| (all.0 + one.0, f64::max(all.1, one.1)));
    let metres = |value: f64| (count > 0).then(|| value * map.grid.resolution());
    Ok(CoverageFigures {
        free_space_coverage: share,
        average_distance_to_node: metres(sum / count.max(1) as f64),
        max_distance_to_node: metres(max),
        coverage_efficiency: share / network.len().max(1) as f64,
    })
}
