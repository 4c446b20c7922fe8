//! The known cells of each region: how many, and corners that enclose them.
//!
//! Cost: O(cells).

use super::region_map::RegionMap;
use crate::geometry::Point;
use crate::grid::{Occupancy, OccupancyGrid};
use crate::watch::{Stopped, Watch};

/// The known cells of a region.
#[derive(Clone, Default)]
pub(super) struct Outline {
    /// Number of known cells.
    pub(super) known: u64,
    /// Points with the same convex hull as the known cells, metres.
    pub(super) corners: Vec<Point>,
}

/// The outline of each of `count` regions.
pub(super) fn outlines(
    grid: &OccupancyGrid,
    map: &RegionMap,
    count: usize,
    watch: &Watch<'_>,
) -> Result<Vec<Outline>, Stopped> {
    let mut outlines = vec![Outline::default(); count];
    let resolution = grid.resolution();
    for row in 0..grid.height() {
        watch.check()?;
        let mut spans: Vec<Option<(usize, usize)>> = vec![None; count];
        let labels = &map.tiles[row / map.tile_cells * map.columns..][..map.columns];
        for (tile, (cells, &label)) in grid.row(row).chunks(map.tile_cells).zip(labels).enumerate() {
            let is_known = |cell: &Occupancy| *cell != Occupancy::Unknown;
            let (Some(first), Some(last)) = (cells.iter().position(is_known), cells.iter().rposition(is_known)) else {
                continue;
            };
            let region = usize::from(label);
            outlines[region].known += cells.iter().filter(|cell| is_known(cell)).count() as u64;
            let start = tile * map.tile_cells;
            let span = spans[region].get_or_insert((start + first, start + last));
            span.1 = start + last;
        }
        for (outline, span) in outlines.iter_mut().zip(spans) {
            let Some((first, last)) = span else { continue };
            for (column, row) in [(first, row), (last + 1, row), (first, row + 1), (last + 1, row + 1)] {
                outline.corners.push(Point::new(column as f64, row as f64) * resolution);
            }
        }
    }
    Ok(outlines)
}
