//! Which cells let beams through, laid out for a sweep along rows or along columns.

use rayon::prelude::*;

use super::beams::BeamOptions;
use super::tile::TILE;
use crate::grid::OccupancyGrid;

/// Lines that are moved across a row at a time: a multiple of every SIMD width.
pub(super) const LINES_PER_STEP: usize = 32;

/// Side of the blocks in which a mask is transposed, cells: source and target of a block stay in the first-level cache.
const TRANSPOSE_BLOCK: usize = 32;

/// Columns on either side of the grid that stop every beam: the lines a tile needs are at most the side of a tile away
/// from it, and are moved in whole steps.
const MARGIN: usize = TILE + 2 * LINES_PER_STEP;

/// For each cell all bits set where beams pass, none where they stop.
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
            for (cell, &occupancy) in cells[MARGIN..].iter_mut().zip(grid.row(row)) {
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
                let source = self.from(source_row, first as isize);
                for (row, &cell) in rows.chunks_mut(pitch).zip(source) {
                    row[MARGIN + source_row] = cell;
                }
            }
        });
        turned
    }

    /// A mask that stops every beam.
    fn blocked(columns: usize, rows: usize) -> Self {
        Self { columns, rows, cells: vec![0; (columns + 2 * MARGIN) * rows] }
    }

    /// Numbers from one row to the next.
    fn pitch(&self) -> usize {
        self.columns + 2 * MARGIN
    }

    pub(super) fn columns(&self) -> usize {
        self.columns
    }

    pub(super) fn rows(&self) -> usize {
        self.rows
    }

    /// The cells of a row from a column on, to the end of the margin; the column may be in the other margin.
    #[inline(always)]
    pub(super) fn from(&self, row: usize, column: isize) -> &[u16] {
        let start = row * self.pitch() + (column + MARGIN as isize) as usize;
        &self.cells[start..(row + 1) * self.pitch()]
    }
}
