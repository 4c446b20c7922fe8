//! What belongs to the site: everything but the unexplored ground that reaches the border of the map.
//!
//! Unknown cells behind goods and between racks lie in the site, those around the building do not. The ground outside is
//! filled in blocks of a quarter of a metre that hold no known cell, so that it does not leak in through gaps between
//! goods, nor is it stopped by single rays that leak out. Cost: O(cells).

use crate::grid::{Occupancy, OccupancyGrid};
use crate::segmentation::RegionMap;
use crate::watch::{Stopped, Watch};

/// Side of a block, metres: wider than the gaps between goods.
const BLOCK_M: f64 = 0.25;

/// The ground of a grid that lies in its site, by region.
pub(super) struct Site {
    width: usize,
    height: usize,
    /// Region of each cell, row-major; [`RegionMap::NONE`] outside the site and the regions.
    regions: Vec<u8>,
}

impl Site {
    pub(super) fn of(grid: &OccupancyGrid, regions: &RegionMap, watch: &Watch<'_>) -> Result<Self, Stopped> {
        let side = ((BLOCK_M / grid.resolution()).round() as usize).max(1);
        let columns = grid.width().div_ceil(side);
        let is_outside = outside(&known_blocks(grid, side, watch)?, columns);
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
    pub(super) fn holds(&self, column: i64, row: i64, region: u8) -> bool {
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

/// The blocks that nobody saw and that reach the border over others like them.
fn outside(is_known: &[bool], columns: usize) -> Vec<bool> {
    let rows = is_known.len().checked_div(columns).unwrap_or(0);
    let mut is_outside = vec![false; is_known.len()];
    let on_border = |block: &usize| {
        let (column, row) = (block % columns, block / columns);
        column == 0 || row == 0 || column + 1 == columns || row + 1 == rows
    };
    let mut open: Vec<usize> = (0..is_known.len()).filter(on_border).filter(|&block| !is_known[block]).collect();
    for &block in &open {
        is_outside[block] = true;
    }
    while let Some(block) = open.pop() {
        let (column, row) = (block % columns, block / columns);
        let left = (column > 0).then(|| block - 1);
        let right = (column + 1 < columns).then_some(block + 1);
        let below = (row > 0).then(|| block - columns);
        let above = (row + 1 < rows).then_some(block + columns);
        for next in [left, right, below, above].into_iter().flatten() {
            if !is_outside[next] && !is_known[next] {
                is_outside[next] = true;
                open.push(next);
            }
        }
    }
    is_outside
}
