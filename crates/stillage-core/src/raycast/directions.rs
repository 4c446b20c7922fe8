//! The digital lines of one beam direction.
//!
//! A direction is swept across the *rows* of a mask: grid rows for beams steeper than 45 degrees, grid columns (rows of
//! the transposed mask) for the others, so a line moves by at most one column per row. With cells `[c, c + 1)` and rows
//! `[r, r + 1)`, the lines are `x(y) = slope y + i + p / 4` for integers `i` and phases `p` in 0..4. Neighbouring lines
//! are a quarter of a column apart, so some line passes within an eighth of a column of every cell's centre. Positions
//! are in fixed point: crossings are exact and the same on every machine.

use super::beams::beam_direction;

/// Lines per column. Measured on a synthetic warehouse of 20 million cells:
///
/// | lines per column | beams within two cells of the exact ones |
/// | --- | --- |
/// | 1 | 92.9 % |
/// | 2 | 96.7 % |
/// | 4 | 98.4 % |
pub(super) const PHASES: usize = 4;

/// Units of length per row. A `u16` then holds beams of up to 16,383 rows; longer ones are cut there.
pub(super) const UNITS_PER_ROW: u16 = 4;

/// Binary digits after the point of slopes and positions: over 2^20 rows a line is off by at most 2^-12 of a column.
const FRACTION_BITS: u32 = 32;

/// One beam direction in the frame of its sweep.
#[derive(Debug, Clone, Copy)]
pub(super) struct Direction {
    /// Whether the rows of the sweep are the columns of the grid.
    pub(super) transposed: bool,
    /// Whether the beam runs towards higher rows of the sweep.
    pub(super) ascending: bool,
    /// Columns per row, fixed point.
    slope: i64,
    /// Units of length per step of the fixed-point column; infinite where the slope is 0.
    units_per_column: f64,
    /// Length of a unit along the beam, in cells.
    pub(super) unit: f32,
}

/// What lines of one phase do within one row.
#[derive(Debug, Clone, Copy)]
pub(super) struct RowCrossing {
    /// Column in which line 0 enters the row, going along the beam.
    pub(super) entry: isize,
    /// Column in which line 0 leaves the row.
    pub(super) exit: isize,
    /// Units from the entry into the row to the border between the two columns.
    pub(super) border: u16,
}

impl Direction {
    /// The direction of a beam.
    pub(super) fn new(beam: usize, beams: usize) -> Self {
        let beam = beam_direction(beam, beams);
        let transposed = beam.x.abs() > beam.y.abs();
        let (along, across) = if transposed { (beam.x, beam.y) } else { (beam.y, beam.x) };
        let slope = across / along;
        let length_per_row = (1.0 + slope * slope).sqrt();
        let slope = (slope * (1_u64 << FRACTION_BITS) as f64).round();
        Self {
            transposed,
            ascending: along > 0.0,
            slope: slope as i64,
            units_per_column: f64::from(UNITS_PER_ROW) / slope,
            unit: (length_per_row / f64::from(UNITS_PER_ROW)) as f32,
        }
    }

    /// Column of line 0 of a phase at the border below a row.
    #[inline(always)]
    pub(super) fn column(&self, phase: usize, border: usize) -> isize {
        (self.position(phase, border) >> FRACTION_BITS) as isize
    }

    /// Position of line 0 of a phase at the border below a row, fixed point.
    #[inline(always)]
    fn position(&self, phase: usize, border: usize) -> i64 {
        self.slope * border as i64 + phase_offset(phase)
    }

    /// How lines of a phase cross a row.
    #[inline(always)]
    pub(super) fn crossing(&self, phase: usize, row: usize) -> RowCrossing {
        let (below, above) = (self.column(phase, row), self.column(phase, row + 1));
        let (entry, exit) = if self.ascending { (below, above) } else { (above, below) };
        let border = if below == above { 0 } else { self.border(phase, row, below.max(above)) };
        RowCrossing { entry, exit, border }
    }

    /// Units from the entry into a row to the place where line 0 crosses into or out of `column`.
    #[inline(always)]
    fn border(&self, phase: usize, row: usize, column: isize) -> u16 {
        let way = ((column as i64) << FRACTION_BITS) - self.position(phase, row);
        let units = way as f64 * self.units_per_column;
        let from_entry = if self.ascending { units } else { f64::from(UNITS_PER_ROW) - units };
        // A cast rounds down, and gives 0 for a negative number.
        ((from_entry + 0.5) as u16).min(UNITS_PER_ROW)
    }

    /// The lines nearest to the cell centres of a row: their phase, and the number of the line of column 0.
    #[inline(always)]
    pub(super) fn nearest_lines(&self, row: usize) -> (usize, isize) {
        let eighth = 1_i64 << (FRACTION_BITS - 3);
        // The line through the centre of column 0 starts half a column up, and is rounded to the nearest quarter.
        let start = 4 * eighth - (self.slope * (2 * row as i64 + 1)).div_euclid(2) + eighth;
        let quarters = start >> (FRACTION_BITS - 2);
        (quarters.rem_euclid(PHASES as i64) as usize, quarters.div_euclid(PHASES as i64) as isize)
    }
}

/// Where line 0 of a phase starts, fixed point.
#[inline(always)]
fn phase_offset(phase: usize) -> i64 {
    (phase as i64) << (FRACTION_BITS - 2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn some_line_passes_within_an_eighth_of_every_center() {
        for beam in 0..360 {
            let direction = Direction::new(beam, 360);
            for row in [0, 1, 2, 17, 4_095] {
                let (phase, line) = direction.nearest_lines(row);
                let middle = (direction.position(phase, row) + direction.position(phase, row + 1)) as f64 / 2.0;
                let column = line as f64 + middle / (1_u64 << FRACTION_BITS) as f64;
                assert!((column - 0.5).abs() <= 0.125 + 1e-6, "beam {beam}, row {row}: {column}");
            }
        }
    }

    #[test]
    fn lines_leave_a_row_where_they_enter_the_next() {
        for beam in 0..360 {
            let direction = Direction::new(beam, 360);
            for (row, phase) in [(0, 0), (5, 1), (100, 2), (1_000, 3)] {
                let (here, above) = (direction.crossing(phase, row), direction.crossing(phase, row + 1));
                let (leaves, enters) =
                    if direction.ascending { (here.exit, above.entry) } else { (above.exit, here.entry) };
                assert_eq!(leaves, enters);
                assert!((here.exit - here.entry).abs() <= 1);
            }
        }
    }
}
