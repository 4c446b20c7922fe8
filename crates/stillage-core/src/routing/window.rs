//! Windows of a map.

use crate::geometry::Bounds;
use crate::grid::CellBounds;
use crate::site_map::SiteMap;

/// The rectangle of cells around some faces, given by face id. O(edges of the faces).
pub(super) fn window_of(map: &SiteMap<'_>, members: &[bool]) -> CellBounds {
    let subdivision = &map.analysis.subdivision;
    let corners = subdivision.faces().filter(|face| members[face.index()]).flat_map(|face| {
        subdivision.boundary(face).map(|half| subdivision.position(subdivision.half_edge(half).origin))
    });
    let Bounds { low, high } = Bounds::around(&corners.collect::<Vec<_>>());
    let cells = |axis: usize, count: usize| {
        // Casts of negative and infinite numbers saturate.
        let first = (low[axis] / map.grid.resolution()).floor() as usize;
        let end = (high[axis] / map.grid.resolution()).ceil() as usize;
        first.min(count)..end.min(count)
    };
    CellBounds { columns: cells(0, map.grid.width()), rows: cells(1, map.grid.height()) }
}
