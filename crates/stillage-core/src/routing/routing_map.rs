//! What routing reads of a map.

use crate::analysis::Analysis;
use crate::arrangement::CellFaces;
use crate::geometry::Bounds;
use crate::grid::{CellBounds, OccupancyGrid};
use crate::semantics::SemanticMap;

/// Everything routing needs of a map.
#[derive(Debug, Clone, Copy)]
pub struct RoutingMap<'a> {
    /// The cells.
    pub grid: &'a OccupancyGrid,
    /// The face of every cell.
    pub cells: &'a CellFaces,
    /// The geometric level.
    pub analysis: &'a Analysis,
    /// The human level.
    pub semantic: &'a SemanticMap,
}

impl RoutingMap<'_> {
    /// The rectangle of cells around some faces, given by face id. O(edges of the faces).
    pub(super) fn window_of(&self, members: &[bool]) -> CellBounds {
        let subdivision = &self.analysis.subdivision;
        let corners = subdivision.faces().filter(|face| members[face.index()]).flat_map(|face| {
            subdivision.boundary(face).map(|half| subdivision.position(subdivision.half_edge(half).origin))
        });
        let Bounds { low, high } = Bounds::around(&corners.collect::<Vec<_>>());
        let cells = |axis: usize, count: usize| {
            // Casts of negative and infinite numbers saturate.
            let first = (low[axis] / self.grid.resolution()).floor() as usize;
            let end = (high[axis] / self.grid.resolution()).ceil() as usize;
            first.min(count)..end.min(count)
        };
        CellBounds { columns: cells(0, self.grid.width()), rows: cells(1, self.grid.height()) }
    }
}
