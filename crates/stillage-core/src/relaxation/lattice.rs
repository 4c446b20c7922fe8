//! Where the measured cells lie, row by row.

use std::ops::Range;

use rayon::prelude::*;

/// Rows that one task relaxes.
pub(super) const ROWS_PER_BLOCK: usize = 64;

/// The measured cells by row and column of the lattice they lie on.
#[derive(Debug)]
pub struct Lattice {
    /// Columns of the lattice.
    pub(super) columns: usize,
    /// Column of each measured cell.
    pub(super) of_cells: Vec<u32>,
    /// The measured cells of each row.
    pub(super) rows: Vec<Range<usize>>,
}

impl Lattice {
    /// The lattice of measured cells (row-major numbers, ascending) of a grid that is `width` cells wide: every
    /// `stride`-th column and row, or every column and row if a cell lies between those.
    #[must_use]
    pub fn new(cells: &[u32], width: usize, stride: usize) -> Self {
        let width = width.max(1);
        let place = |cell: u32| (cell as usize % width, cell as usize / width);
        let is_on = |&cell: &u32| {
            let (column, row) = place(cell);
            column.is_multiple_of(stride) && row.is_multiple_of(stride)
        };
        let stride = if cells.par_iter().all(is_on) { stride } else { 1 };
        let row_of = |cell: u32| place(cell).1 / stride;
        let height = cells.last().map_or(0, |&last| row_of(last) + 1);
        let mut rows = Vec::with_capacity(height);
        let mut start = 0;
        for row in 0..height {
            let end = start + cells[start..].partition_point(|&cell| row_of(cell) <= row);
            rows.push(start..end);
            start = end;
        }
        let of_cells = cells.iter().map(|&cell| (place(cell).0 / stride) as u32).collect();
        Self { columns: width.div_ceil(stride), of_cells, rows }
    }

    /// Splits what belongs to the cells, `count` each, into blocks of rows.
    pub(super) fn blocks<'a>(&self, mut values: &'a mut [u16], count: usize) -> Vec<(Range<usize>, &'a mut [u16])> {
        let mut blocks = Vec::new();
        for first in (0..self.rows.len()).step_by(ROWS_PER_BLOCK) {
            let rows = first..(first + ROWS_PER_BLOCK).min(self.rows.len());
            let cells = self.rows[rows.end - 1].end - self.rows[first].start;
            let (block, rest) = values.split_at_mut(cells * count);
            values = rest;
            blocks.push((rows, block));
        }
        blocks
    }
}
