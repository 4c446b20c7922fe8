//! The second pass of the sweep: one beam of all measured cells of one tile, from the states at its border.

use std::ops::Range;

use super::directions::{Direction, PHASES, UNITS_PER_ROW};
use super::mask::Mask;
use super::sweep::{Lines, Sweep, TILE, mask_range};

/// Width of the vectors that read a plane: rows of a plane are filled up to a multiple of it.
const PLANE_ALIGNMENT: usize = 16;

/// A rectangle of the grid, and which of its cells are measured.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Tile {
    columns: Range<usize>,
    rows: Range<usize>,
    stride: usize,
}

impl Tile {
    pub(super) fn new(columns: Range<usize>, rows: Range<usize>, stride: usize) -> Self {
        Self { columns, rows, stride }
    }

    /// Columns with measured cells, ascending.
    #[must_use]
    pub fn measured_columns(&self) -> impl ExactSizeIterator<Item = usize> + use<> {
        on_lattice(&self.columns, self.stride)
    }

    /// Rows with measured cells, ascending.
    #[must_use]
    pub fn measured_rows(&self) -> impl ExactSizeIterator<Item = usize> + use<> {
        on_lattice(&self.rows, self.stride)
    }

    /// One past the last row.
    #[must_use]
    pub fn end_row(&self) -> usize {
        self.rows.end
    }

    /// Numbers from one row of a plane to the next: the measured columns, filled up to whole vectors.
    #[must_use]
    pub fn pitch(&self) -> usize {
        self.measured_columns().len().next_multiple_of(PLANE_ALIGNMENT)
    }

    /// Numbers in a plane.
    #[must_use]
    pub fn plane_length(&self) -> usize {
        self.pitch() * self.measured_rows().len()
    }
}

/// The multiples of the stride in a range.
fn on_lattice(range: &Range<usize>, stride: usize) -> std::iter::StepBy<Range<usize>> {
    (range.start.next_multiple_of(stride)..range.end).step_by(stride)
}

/// Working memory of [`Sweep::cast`], reused from beam to beam.
#[derive(Debug)]
pub struct TileScratch {
    lines: [Lines; PHASES],
    row: [u16; TILE],
}

impl Default for TileScratch {
    fn default() -> Self {
        Self { lines: std::array::from_fn(|_| Lines::between(0..0)), row: [0; TILE] }
    }
}

/// A tile in the frame of a sweep.
struct Window<'a> {
    mask: &'a Mask,
    direction: &'a Direction,
    columns: Range<isize>,
    rows: Range<usize>,
}

/// See [`Sweep::cast`].
pub(super) fn cast_tile(sweep: &Sweep, tile: &Tile, beam: usize, scratch: &mut TileScratch, plane: &mut [u16]) {
    if tile.plane_length() == 0 {
        return;
    }
    let direction = &sweep.directions[beam];
    let (columns, rows) = if direction.transposed { (&tile.rows, &tile.columns) } else { (&tile.columns, &tile.rows) };
    let window = Window {
        mask: &sweep.masks[usize::from(direction.transposed)],
        direction,
        columns: columns.start as isize..columns.end as isize,
        rows: rows.clone(),
    };
    window.load(&sweep.borders[beam], &mut scratch.lines);
    let first_measured = rows.start.next_multiple_of(tile.stride);
    for step in 0..rows.len() {
        let row = if direction.ascending { rows.end - 1 - step } else { rows.start + step };
        if row % tile.stride == 0 {
            let measured = &mut scratch.row[..columns.len()];
            window.read(row, &scratch.lines, measured);
            store(tile, direction.transposed, (row - first_measured) / tile.stride, measured, plane);
        }
        if step + 1 < rows.len() {
            window.cross(row, &mut scratch.lines);
        }
    }
}

/// Puts the lengths of one row of the sweep where its measured cells are in the plane.
fn store(tile: &Tile, transposed: bool, index: usize, lengths: &[u16], plane: &mut [u16]) {
    let pitch = tile.pitch();
    if transposed {
        let first = tile.rows.start.next_multiple_of(tile.stride) - tile.rows.start;
        let measured = lengths.iter().skip(first).step_by(tile.stride);
        for (row, &length) in plane.chunks_exact_mut(pitch).zip(measured) {
            row[index] = length;
        }
    } else {
        let row = &mut plane[index * pitch..(index + 1) * pitch];
        if tile.stride == 1 {
            row[..lengths.len()].copy_from_slice(lengths);
        } else {
            let first = tile.columns.start.next_multiple_of(tile.stride) - tile.columns.start;
            for (cell, &length) in row.iter_mut().zip(lengths.iter().skip(first).step_by(tile.stride)) {
                *cell = length;
            }
        }
    }
}

impl Window<'_> {
    /// The border behind the last row of the walk, towards which lines are carried.
    fn near_border(&self) -> usize {
        if self.direction.ascending { self.rows.start } else { self.rows.end }
    }

    /// The border at which the walk begins.
    fn far_border(&self) -> usize {
        if self.direction.ascending { self.rows.end } else { self.rows.start }
    }

    /// Lines that may be the nearest of a cell of the tile between a border and the near one.
    fn lines_from(&self, phase: usize, column: isize) -> Range<isize> {
        let near = self.direction.column(phase, self.near_border());
        self.columns.start - column.max(near) - 1..self.columns.end - column.min(near) + 1
    }

    /// Fetches the states at the far border; lines outside the grid, or at its end, are stopped.
    fn load(&self, borders: &[u16], lines: &mut [Lines; PHASES]) {
        let columns = self.mask.columns();
        let far = self.far_border();
        let kept = (far > 0 && far < self.mask.rows()).then(|| (far / TILE - 1) * PHASES * columns);
        for (phase, lines) in lines.iter_mut().enumerate() {
            let column = self.direction.column(phase, far);
            let numbers = self.lines_from(phase, column);
            lines.restart(numbers.clone());
            let Some(start) = kept else { continue };
            let inside = self.inside(&numbers, column);
            let start = start + phase * columns;
            let source = start + (inside.start + column) as usize..start + (inside.end + column) as usize;
            lines.slice_mut(inside).copy_from_slice(&borders[source]);
        }
    }

    /// The lines that are inside the grid where line 0 is in `column`; never none, for some are inside the tile.
    fn inside(&self, numbers: &Range<isize>, column: isize) -> Range<isize> {
        numbers.start.max(-column)..numbers.end.min(self.mask.columns() as isize - column)
    }

    /// Reads the beams of the cells of a row: half a row to the border ahead, then along the nearest line.
    fn read(&self, row: usize, lines: &[Lines; PHASES], lengths: &mut [u16]) {
        const HALF_ROW: u16 = UNITS_PER_ROW / 2;
        let (phase, line) = self.direction.nearest_lines(row);
        let crossing = self.direction.crossing(phase, row);
        let numbers = self.columns.start + line..self.columns.end + line;
        let left = mask_range(self.mask.row(row), numbers.start + crossing.exit, numbers.len());
        let border = crossing.border.saturating_sub(HALF_ROW);
        for ((length, &state), &left) in lengths.iter_mut().zip(lines[phase].slice(numbers)).zip(left) {
            *length = (state.saturating_add(HALF_ROW) & left) | (border & !left);
        }
    }

    /// Carries the lines that are still needed across a row.
    fn cross(&self, row: usize, lines: &mut [Lines; PHASES]) {
        for (phase, lines) in lines.iter_mut().enumerate() {
            let crossing = self.direction.crossing(phase, row);
            let numbers = self.inside(&self.lines_from(phase, crossing.entry), crossing.entry);
            lines.cross(numbers, self.mask.row(row), &crossing);
        }
    }
}
