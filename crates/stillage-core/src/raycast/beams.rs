//! Which beams are cast from a cell, and what stops them.

use std::f64::consts::{FRAC_1_SQRT_2, TAU};

use crate::geometry::Vector;
use crate::grid::{Occupancy, OccupancyGrid};
use crate::spec::CategorizationOptions;

/// Which beams are cast, and what stops them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BeamOptions {
    /// Beams per cell, evenly around.
    pub beams: usize,
    /// Longest beam, metres; unlimited when absent.
    pub max_range_m: Option<f64>,
    /// Whether unknown cells stop beams.
    pub unknown_blocks: bool,
}

impl From<&CategorizationOptions> for BeamOptions {
    fn from(options: &CategorizationOptions) -> Self {
        Self { beams: options.beams, max_range_m: options.max_range_m, unknown_blocks: options.unknown_blocks }
    }
}

impl BeamOptions {
    /// The longest beam in cells; infinite when unlimited.
    pub(super) fn limit_in_cells(&self, resolution: f64) -> f64 {
        self.max_range_m.map_or(f64::INFINITY, |range| range / resolution)
    }

    /// Whether a cell lets beams through; cells outside the grid never do.
    pub(super) fn passes(&self, cell: Occupancy) -> bool {
        match cell {
            Occupancy::Free => true,
            Occupancy::Occupied => false,
            Occupancy::Unknown => !self.unknown_blocks,
        }
    }

    /// Whether the cell at a column and row lets beams through.
    pub(super) fn passes_at(&self, grid: &OccupancyGrid, column: i64, row: i64) -> bool {
        let inside = |index: i64, end: usize| usize::try_from(index).is_ok_and(|index| index < end);
        inside(column, grid.width()) && inside(row, grid.height()) && self.passes(grid.at(column, row))
    }
}

/// The unit vector of a beam; exact along the axes and the diagonals, where rounding would decide what the beam meets.
#[must_use]
pub fn beam_direction(beam: usize, beams: usize) -> Vector {
    let eighths = 8 * beam;
    if eighths.is_multiple_of(beams) {
        let diagonal = FRAC_1_SQRT_2;
        return match eighths / beams % 8 {
            0 => Vector::new(1.0, 0.0),
            1 => Vector::new(diagonal, diagonal),
            2 => Vector::new(0.0, 1.0),
            3 => Vector::new(-diagonal, diagonal),
            4 => Vector::new(-1.0, 0.0),
            5 => Vector::new(-diagonal, -diagonal),
            6 => Vector::new(0.0, -1.0),
            _ => Vector::new(diagonal, -diagonal),
        };
    }
    let angle = TAU * beam as f64 / beams as f64;
    Vector::new(angle.cos(), angle.sin())
}
