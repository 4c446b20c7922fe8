//! A copy of a rectangle of a frame, turned so that its rows run along the rows of places.

use std::ops::Range;

use super::cell::Cell;

/// A copy of a rectangle of a frame, with rows of cells along the rows of places.
pub(crate) struct Patch {
    pub width: usize,
    pub height: usize,
    pub cells: Vec<Cell>,
}

impl Patch {
    pub fn row(&self, row: usize) -> &[Cell] {
        &self.cells[row * self.width..(row + 1) * self.width]
    }

    /// The same columns in another order.
    pub fn in_order(&self, columns: &[usize]) -> Self {
        let cells = (0..self.height).flat_map(|line| columns.iter().map(move |&column| self.row(line)[column]));
        Self { width: columns.len(), height: self.height, cells: cells.collect() }
    }

    /// Share of the columns with a known cell in any of some rows.
    pub fn known_share(&self, rows: Range<usize>) -> f64 {
        let is_known = |column: &usize| rows.clone().any(|row| !self.row(row)[*column].is_unknown());
        (0..self.width).filter(is_known).count() as f64 / self.width.max(1) as f64
    }

    /// Share of the columns with an occupied cell in any of some rows.
    pub fn occupied_share(&self, rows: Range<usize>) -> f64 {
        let is_occupied = |column: &usize| rows.clone().any(|row| self.row(row)[*column].is_occupied());
        (0..self.width).filter(is_occupied).count() as f64 / self.width.max(1) as f64
    }
}
