//! What belongs to the site: everything but the unexplored ground that reaches the border of the map.
//!
//! Unknown cells behind goods and between racks lie in the site, those around the building do not. The ground outside is
//! filled in blocks of a quarter of a metre that hold no known cell, so that it does not leak in through gaps between
//! goods, nor is it stopped by single rays that leak out. Cost: O(cells).

use crate::grid::{Occupancy, OccupancyGrid};
use crate::watch::{Stopped, Watch};

/// Side of a block, metres: wider than the gaps between goods.
const BLOCK_M: f64 = 0.25;

/// The ground of a grid that lies in its site.
pub(super) struct Site {
    side: usize,
    columns: usize,
    is_outside: Vec<bool>,
}

impl Site {
    pub(super) fn of(grid: &OccupancyGrid, watch: &Watch<'_>) -> Result<Self, Stopped> {
        let side = ((BLOCK_M / grid.resolution()).round() as usize).max(1);
        let (columns, rows) = (grid.width().div_ceil(side), grid.height().div_ceil(side));
        let mut known = vec![0_usize; columns * rows];
        for row in 0..grid.height() {
            watch.check()?;
            for (column, &cell) in grid.row(row).iter().enumerate() {
                known[row / side * columns + column / side] += usize::from(cell != Occupancy::Unknown);
            }
        }
        let is_open = |block: usize| known[block] == 0;
        let mut is_outside = vec![false; columns * rows];
        let on_border = |block: &usize| {
            let (column, row) = (block % columns, block / columns);
            column == 0 || row == 0 || column + 1 == columns || row + 1 == rows
        };
        let mut open: Vec<usize> = (0..columns * rows).filter(on_border).filter(|&block| is_open(block)).collect();
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
                if !is_outside[next] && is_open(next) {
                    is_outside[next] = true;
                    open.push(next);
                }
            }
        }
        Ok(Self { side, columns, is_outside })
    }

    /// Whether a cell of the grid lies in the site.
    pub(super) fn holds(&self, column: usize, row: usize) -> bool {
        !self.is_outside[row / self.side * self.columns + column / self.side]
    }
}
