//! Which cells let beams through, laid out for a sweep along rows or along columns.

use rayon::prelude::*;

use super::BeamOptions;
use crate::grid::OccupancyGrid;

/// Side of the blocks in which a mask is transposed: both sides of a block stay in the first cache.
const TRANSPOSE_BLOCK: usize = 32;

/// All bits set where beams pass, none where they stop. One column on either side stops every beam.
#[derive(Debug)]
pub(super) struct Mask {
    columns: usize,
    rows: usize,
    cells: Vec<u16>,
}

impl Mask {
    /// The mask of a grid, row by row.
    pub(super) fn of_grid(grid: &OccupancyGrid, options: &BeamOptions) -> Self {
        let mut mask = Self::blocked(grid.width(), grid.height());
        let pitch = mask.pitch();
        mask.cells.par_chunks_mut(pitch).enumerate().for_each(|(row, cells)| {
            for (cell, &occupancy) in cells[1..].iter_mut().zip(grid.row(row)) {
                *cell = if options.passes(occupancy) { u16::MAX } else { 0 };
            }
        });
        mask
    }

    /// The same cells with columns and rows exchanged.
    pub(super) fn transposed(&self) -> Self {
        let mut turned = Self::blocked(self.rows, self.columns);
        let pitch = turned.pitch();
        turned.cells.par_chunks_mut(pitch * TRANSPOSE_BLOCK).enumerate().for_each(|(block, rows)| {
            let first = block * TRANSPOSE_BLOCK;
            for source_row in 0..self.rows {
                let source = &self.row(source_row)[1 + first..];
                for (row, &cell) in rows.chunks_mut(pitch).zip(source) {
                    row[1 + source_row] = cell;
                }
            }
        });
        turned
    }

    /// A mask that stops every beam.
    fn blocked(columns: usize, rows: usize) -> Self {
        Self { columns, rows, cells: vec![0; (columns + 2) * rows] }
    }

    fn pitch(&self) -> usize {
        self.columns + 2
    }

    pub(super) fn columns(&self) -> usize {
        self.columns
    }

    pub(super) fn rows(&self) -> usize {
        self.rows
    }

    /// The cells of a row; column `c` is at index `c + 1`.
    pub(super) fn row(&self, row: usize) -> &[u16] {
        &self.cells[row * self.pitch()..(row + 1) * self.pitch()]
    }
}
