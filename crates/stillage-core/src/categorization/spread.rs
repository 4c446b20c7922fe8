//! Categories of the free cells that were not measured.

use std::collections::VecDeque;

use super::category_map::CategoryMap;
use crate::grid::{Occupancy, OccupancyGrid};
use crate::watch::{Stopped, Watch};

/// Cells between two checks of the stop flag.
const CELLS_PER_CHECK: usize = 1 << 16;

/// Gives every other free cell the category of the nearest measured one. Cost: O(cells).
pub(super) fn spread(
    grid: &OccupancyGrid,
    measured: &[u32],
    cells: &mut [u8],
    watch: &Watch<'_>,
) -> Result<(), Stopped> {
    let free = grid.count(Occupancy::Free);
    if free == measured.len() {
        return Ok(());
    }
    let is_free = |cell: usize| grid.cells()[cell] == Occupancy::Free;
    flood(grid.width(), measured, cells, is_free, watch)?;
    if grid
        .cells()
        .iter()
        .zip(&*cells)
        .all(|(&cell, &category)| cell != Occupancy::Free || category != CategoryMap::NONE)
    {
        return Ok(());
    }
    // Free cells without a way to a measured cell: the nearest one through other cells.
    let reached: Vec<u32> =
        (0..cells.len()).filter(|&cell| cells[cell] != CategoryMap::NONE).map(|cell| cell as u32).collect();
    flood(grid.width(), &reached, cells, |_| true, watch)?;
    for (category, _) in cells.iter_mut().zip(grid.cells()).filter(|(_, cell)| **cell != Occupancy::Free) {
        *category = CategoryMap::NONE;
    }
    Ok(())
}

/// Gives every cell that may be entered the category of the nearest source, in chessboard steps; of equally near
/// sources the first in breadth-first order.
fn flood(
    width: usize,
    sources: &[u32],
    cells: &mut [u8],
    enters: impl Fn(usize) -> bool,
    watch: &Watch<'_>,
) -> Result<(), Stopped> {
    let height = cells.len() / width;
    let mut queue: VecDeque<u32> = sources.iter().copied().collect();
    let mut steps = 0_usize;
    while let Some(cell) = queue.pop_front() {
        steps += 1;
        if steps.is_multiple_of(CELLS_PER_CHECK) {
            watch.check()?;
        }
        let cell = cell as usize;
        let (column, row) = (cell % width, cell / width);
        for near_row in row.saturating_sub(1)..height.min(row + 2) {
            for near_column in column.saturating_sub(1)..width.min(column + 2) {
                let near = near_row * width + near_column;
                if cells[near] == CategoryMap::NONE && enters(near) {
                    cells[near] = cells[cell];
                    queue.push_back(near as u32);
                }
            }
        }
    }
    Ok(())
}
