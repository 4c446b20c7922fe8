//! The rows of a grid on the lattice of a stride.

use crate::grid::{Occupancy, OccupancyGrid};

/// Whether some free cell is on the lattice of a stride.
pub(super) fn has_measured_cells(grid: &OccupancyGrid, stride: usize) -> bool {
    measured_rows(grid, stride).any(|(_, row)| row.iter().step_by(stride).any(|&cell| cell == Occupancy::Free))
}

/// The rows on the lattice of a stride, each with the index of its first cell.
pub(super) fn measured_rows(grid: &OccupancyGrid, stride: usize) -> impl Iterator<Item = (usize, &[Occupancy])> {
    (0..grid.height()).step_by(stride).map(|row| (row * grid.width(), grid.row(row)))
}
