//! What belongs to the site: everything but the unexplored ground that reaches the border of the map.
//!
//! Unknown cells behind goods and between racks lie in the site, those around the building do not. The ground outside is
//! filled in blocks of a quarter of a metre that hold no known cell, by a square wider than a place: so it does not leak
//! in through gaps between goods, nor into goods before a wall that shows only between them. Cost: O(cells).

use crate::components::{Components, Neighbours};
use crate::grid::{Occupancy, OccupancyGrid};
use crate::morphology;
use crate::segmentation::RegionMap;
use crate::watch::{Stopped, Watch};

/// Side of a block, metres: wider than the gaps between goods.
const BLOCK_M: f64 = 0.25;
/// Side of the square that fills the ground outside, blocks: wider than a place.
const SQUARE: usize = 5;

/// The ground of a grid that lies in its site, by region.
pub(crate) struct SiteGround {
    width: usize,
    height: usize,
    /// Region of each cell, row-major; [`RegionMap::NONE`] outside the site and the regions.
    regions: Vec<u8>,
}

/// A grid in square blocks, and which of them lie outside the site.
pub(crate) struct CoarseGrid {
    /// Cells along the side of a block.
    pub side: usize,
    /// CoarseGrid of a row.
    pub columns: usize,
    /// Row-major.
    pub is_outside: Vec<bool>,
}

impl CoarseGrid {
    pub(crate) fn of(grid: &OccupancyGrid, watch: &Watch<'_>) -> Result<Self, Stopped> {
        let side = ((BLOCK_M / grid.resolution()).round() as usize).max(1);
        let columns = grid.width().div_ceil(side);
        let is_outside = outside(&known_blocks(grid, side, watch)?, columns, watch)?;
        Ok(Self { side, columns, is_outside })
    }
}

impl SiteGround {
    pub(crate) fn of(grid: &OccupancyGrid, regions: &RegionMap, watch: &Watch<'_>) -> Result<Self, Stopped> {
        let CoarseGrid { side, columns, is_outside } = CoarseGrid::of(grid, watch)?;
        let mut site =
            Self { width: grid.width(), height: grid.height(), regions: vec![RegionMap::NONE; grid.cells().len()] };
        for (row, line) in site.regions.chunks_exact_mut(site.width.max(1)).enumerate() {
            watch.check()?;
            let blocks = &is_outside[row / side * columns..][..columns];
            for (block, cells) in line.chunks_mut(side).enumerate().filter(|&(block, _)| !blocks[block]) {
                for (column, cell) in (block * side..).zip(cells) {
                    *cell = regions.region_of_cell(column, row).unwrap_or(RegionMap::NONE);
                }
            }
        }
        Ok(site)
    }

    /// Whether a cell of the grid lies in the site and in a region.
    pub(crate) fn holds(&self, column: i64, row: i64, region: u8) -> bool {
        (0..self.width as i64).contains(&column)
            && (0..self.height as i64).contains(&row)
            && self.regions[row as usize * self.width + column as usize] == region
    }
}

/// Whether somebody saw a cell of each block, row-major.
fn known_blocks(grid: &OccupancyGrid, side: usize, watch: &Watch<'_>) -> Result<Vec<bool>, Stopped> {
    let (columns, rows) = (grid.width().div_ceil(side), grid.height().div_ceil(side));
    let mut is_known = vec![false; columns * rows];
    for row in 0..grid.height() {
        watch.check()?;
        let blocks = &mut is_known[row / side * columns..][..columns];
        for (cells, is_known) in grid.row(row).chunks(side).zip(blocks) {
            *is_known |= cells.iter().any(|&cell| cell != Occupancy::Unknown);
        }
    }
    Ok(is_known)
}

/// The blocks that nobody saw and that the square covers on its way in from beyond the border.
fn outside(is_known: &[bool], columns: usize, watch: &Watch<'_>) -> Result<Vec<bool>, Stopped> {
    let rows = is_known.len().checked_div(columns).unwrap_or(0);
    // Nobody saw what is beyond the border.
    let [across, down] = [columns, rows].map(|side| side + 2 * SQUARE);
    let block = |padded: usize| {
        let (column, row) = ((padded % across).wrapping_sub(SQUARE), (padded / across).wrapping_sub(SQUARE));
        (column < columns && row < rows).then(|| row * columns + column)
    };
    let is_unseen = |padded: usize| block(padded).is_none_or(|block| !is_known[block]);
    let fits = morphology::squares([across, down], SQUARE, is_unseen, watch)?;
    let first = (SQUARE - 1) * (across + 1);
    let mut is_reached = vec![false; fits.len()];
    let connected = Components::of([across, fits.len()], Neighbours::Four, |square| fits[square], watch)?;
    if let Some(around) = connected.iter().find(|squares| squares.first() == first) {
        around.cells().for_each(|square| is_reached[square] = true);
    }
    let mut is_outside = vec![false; is_known.len()];
    let mark = |padded: usize| {
        if let Some(block) = block(padded) {
            is_outside[block] = true;
        }
    };
    morphology::cover(&is_reached, across, SQUARE, mark, watch)?;
    Ok(is_outside)
}
