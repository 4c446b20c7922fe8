//! The second pass of the sweep: one beam of all measured cells of one tile, from the states at its border.

use std::ops::Range;

use super::directions::{Direction, PHASES, UNITS_PER_ROW};
use super::lines::Lines;
use super::mask::{LINES_PER_STEP, Mask};
use super::tile::{PLANE_PITCH, TILE, Tile};

/// Working memory for casting the beams of a tile, reused from beam to beam.
#[derive(Debug)]
pub struct TileScratch {
    lines: [Lines; PHASES],
    /// A row with all its cells, where only some are measured.
    row: [u16; TILE],
}

impl Default for TileScratch {
    fn default() -> Self {
        Self { lines: std::array::from_fn(|_| Lines::between(0..0)), row: [0; TILE] }
    }
}

/// A tile in the frame of the sweep of one direction.
pub(super) struct SweptTile<'a> {
    mask: &'a Mask,
    direction: &'a Direction,
    columns: Range<isize>,
    rows: Range<usize>,
    stride: usize,
}

impl<'a> SweptTile<'a> {
    #[inline(always)]
    pub(super) fn new(tile: &Tile, mask: &'a Mask, direction: &'a Direction) -> Self {
        let (columns, rows) =
            if direction.transposed { (&tile.rows, &tile.columns) } else { (&tile.columns, &tile.rows) };
        let columns = columns.start as isize..columns.end as isize;
        Self { mask, direction, columns, rows: rows.clone(), stride: tile.stride }
    }

    /// Casts the beams of the measured cells into a plane, from the states at the borders between tiles.
    #[inline(always)]
    pub(super) fn cast(&self, borders: &[u16], scratch: &mut TileScratch, plane: &mut [u16]) {
        let Self { direction, columns, rows, stride, .. } = self;
        let stride = *stride;
        self.load(borders, &mut scratch.lines);
        let first_measured = rows.start.next_multiple_of(stride);
        for step in 0..rows.len() {
            let row = if direction.ascending { rows.end - 1 - step } else { rows.start + step };
            if row % stride == 0 {
                let start = (row - first_measured) / stride * PLANE_PITCH;
                let lengths = plane[start..].first_chunk_mut().expect("a plane has a row for every row of a tile");
                if stride == 1 {
                    self.read(row, &scratch.lines, lengths);
                } else {
                    self.read(row, &scratch.lines, &mut scratch.row);
                    let start = columns.start as usize;
                    let first = start.next_multiple_of(stride) - start;
                    let measured = scratch.row[..columns.len()].iter().skip(first).step_by(stride);
                    lengths.iter_mut().zip(measured).for_each(|(length, &measured)| *length = measured);
                }
            }
            if step + 1 < rows.len() {
                self.cross(row, &mut scratch.lines);
            }
        }
    }

    /// The border behind the last row of the walk, towards which lines move.
    fn near_border(&self) -> usize {
        if self.direction.ascending { self.rows.start } else { self.rows.end }
    }

    /// The border at which the walk begins.
    fn far_border(&self) -> usize {
        if self.direction.ascending { self.rows.end } else { self.rows.start }
    }

    /// Lines that may be the nearest of a cell of the tile between a border and the near one.
    #[inline(always)]
    fn lines_from(&self, phase: usize, column: isize) -> Range<isize> {
        let near = self.direction.column(phase, self.near_border());
        self.columns.start - column.max(near) - 1..self.columns.end - column.min(near) + 1
    }

    /// Loads the states at the far border; they are 0 outside the grid and at its end.
    #[inline(always)]
    fn load(&self, borders: &[u16], lines: &mut [Lines; PHASES]) {
        let columns = self.mask.columns();
        let far = self.far_border();
        let kept = (far > 0 && far < self.mask.rows()).then(|| (far / TILE - 1) * PHASES * columns);
        for (phase, lines) in lines.iter_mut().enumerate() {
            let column = self.direction.column(phase, far);
            let numbers = self.lines_from(phase, column);
            lines.restart(numbers.start..numbers.end + (TILE + LINES_PER_STEP) as isize);
            let inside = numbers.start.max(-column)..numbers.end.min(columns as isize - column);
            if kept.is_none() || inside != numbers {
                lines.states_from_mut(numbers.start).fill(0);
            }
            let Some(start) = kept else { continue };
            let start = start + phase * columns;
            let states = &borders[start + (inside.start + column) as usize..start + (inside.end + column) as usize];
            lines.states_from_mut(inside.start)[..states.len()].copy_from_slice(states);
        }
    }

    /// Reads the beams of the cells of a row: half a row to the border ahead, then along the nearest line. Numbers
    /// beyond the tile are arbitrary.
    #[inline(always)]
    fn read(&self, row: usize, lines: &[Lines; PHASES], lengths: &mut [u16; TILE]) {
        const HALF_ROW: u16 = UNITS_PER_ROW / 2;
        let (phase, line) = self.direction.nearest_lines(row);
        let crossing = self.direction.crossing(phase, row);
        let number = self.columns.start + line;
        let states: &[u16; TILE] =
            lines[phase].states_from(number).first_chunk().expect("lines are kept for a whole tile");
        let left: &[u16; TILE] =
            self.mask.from(row, number + crossing.exit).first_chunk().expect("the margin is wider than a tile");
        let border = crossing.border.saturating_sub(HALF_ROW);
        for ((length, &state), &left) in lengths.iter_mut().zip(states).zip(left) {
            *length = (state.saturating_add(HALF_ROW) & left) | (border & !left);
        }
    }

    /// Moves the lines that are still needed across a row.
    #[inline(always)]
    fn cross(&self, row: usize, lines: &mut [Lines; PHASES]) {
        for (phase, lines) in lines.iter_mut().enumerate() {
            let crossing = self.direction.crossing(phase, row);
            lines.cross(&self.lines_from(phase, crossing.entry), self.mask, row, &crossing);
        }
    }
}
