//! Tiles: the rectangles of the grid whose beams are cast together, and the planes that hold them.

use std::ops::Range;

/// Side of a tile, cells. The planes and sums of a tile take 1.4 MB, about a second-level cache, and grow with the
/// square of the side; the states at the borders of all tiles shrink with it.
pub(super) const TILE: usize = 128;

/// Numbers from one row of a plane to the next.
pub const PLANE_PITCH: usize = TILE;

/// Numbers in a plane.
pub const PLANE_LENGTH: usize = TILE * PLANE_PITCH;

/// A rectangle of the grid, and which of its cells are measured.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Tile {
    pub(super) columns: Range<usize>,
    pub(super) rows: Range<usize>,
    /// Every how many columns and rows a cell is measured.
    pub(super) stride: usize,
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
}

/// The multiples of the stride in a range.
fn on_lattice(range: &Range<usize>, stride: usize) -> std::iter::StepBy<Range<usize>> {
    (range.start.next_multiple_of(stride)..range.end).step_by(stride)
}
