//! The ground of the site: all of the map except the unexplored ground that reaches its border.
//!
//! Unknown cells behind goods and between racks belong to the site, those around the building do not. The ground
//! outside is found on a coarse grid, whose cells are known where any of their cells is: a square wider than a place is
//! moved in from beyond the border, over unknown coarse cells only, and what it covers is outside. So the outside does
//! not enter gaps between goods, nor goods before a wall that is seen only between them. Cost: O(cells).

use crate::components::{Components, Neighbours};
use crate::grid::{Occupancy, OccupancyGrid};
use crate::morphology;
use crate::segmentation::RegionMap;
use crate::watch::{Stopped, Watch};

/// Side of a coarse cell, metres: wider than the gaps between goods.
const COARSE_M: f64 = 0.25;
/// Side of the square that covers the ground outside, coarse cells: wider than a place.
const SQUARE: usize = 5;

/// The ground of a grid that lies in its site, by region.
pub(crate) struct SiteGround {
    width: usize,
    height: usize,
    /// Region of each cell, row-major; [`RegionMap::NONE`] outside the site and the regions.
    regions: Vec<u8>,
}

/// A grid in coarse cells, and which of these lie outside the site.
pub(crate) struct CoarseGrid {
    /// Cells along the side of a coarse cell.
    pub side: usize,
    /// Coarse cells in a row.
    pub columns: usize,
    /// By coarse cell, row-major.
    pub is_outside: Vec<bool>,
}

impl CoarseGrid {
    pub(crate) fn of(grid: &OccupancyGrid, watch: &Watch<'_>) -> Result<Self, Stopped> {
        let side = ((COARSE_M / grid.resolution()).round() as usize).max(1);
        let columns = grid.width().div_ceil(side);
        let is_outside = outside(&known_coarse_cells(grid, side, watch)?, columns, watch)?;
        Ok(Self { side, columns, is_outside })
    }
}

impl SiteGround {
    pub(crate) fn of(grid: &OccupancyGrid, regions: &RegionMap, watch: &Watch<'_>) -> Result<Self, Stopped> {
        let CoarseGrid { side, columns, is_outside } = CoarseGrid::of(grid, watch)?;
        let mut site =
            Self { width: grid.width(), height: grid.height(), regions: vec![RegionMap::NONE; grid.cells().len()] };
        for (row, line) in site.regions.chunks_exact_mut(site.width.max(1)).enumerate() {
            watch.check()?;
            let outside = &is_outside[row / side * columns..][..columns];
            for (coarse, cells) in line.chunks_mut(side).enumerate().filter(|&(coarse, _)| !outside[coarse]) {
                for (column, cell) in (coarse * side..).zip(cells) {
                    *cell = regions.region_of_cell(column, row).unwrap_or(RegionMap::NONE);
                }
            }
        }
        Ok(site)
    }

    /// Whether a cell of the grid lies in the site and in a region.
    pub(crate) fn holds(&self, column: i64, row: i64, region: u8) -> bool {
        (0..self.width as i64).contains(&column)
            && (0..self.height as i64).contains(&row)
            && self.regions[row as usize * self.width + column as usize] == region
    }
}

/// Whether any cell of each coarse cell is known, row-major.
fn known_coarse_cells(grid: &OccupancyGrid, side: usize, watch: &Watch<'_>) -> Result<Vec<bool>, Stopped> {
    let (columns, rows) = (grid.width().div_ceil(side), grid.height().div_ceil(side));
    let mut is_known = vec![false; columns * rows];
    for row in 0..grid.height() {
        watch.check()?;
        let known = &mut is_known[row / side * columns..][..columns];
        for (cells, is_known) in grid.row(row).chunks(side).zip(known) {
            *is_known |= cells.iter().any(|&cell| cell != Occupancy::Unknown);
        }
    }
    Ok(is_known)
}

/// The unknown coarse cells that the square covers when it moves in from beyond the border.
fn outside(is_known: &[bool], columns: usize, watch: &Watch<'_>) -> Result<Vec<bool>, Stopped> {
    let rows = is_known.len().checked_div(columns).unwrap_or(0);
    // Beyond the border all coarse cells are unknown.
    let [across, down] = [columns, rows].map(|side| side + 2 * SQUARE);
    let coarse_cell = |padded: usize| {
        let (column, row) = ((padded % across).wrapping_sub(SQUARE), (padded / across).wrapping_sub(SQUARE));
        (column < columns && row < rows).then(|| row * columns + column)
    };
    let is_unknown = |padded: usize| coarse_cell(padded).is_none_or(|cell| !is_known[cell]);
    let fits = morphology::fitting_squares([across, down], SQUARE, is_unknown, watch)?;
    let first = (SQUARE - 1) * (across + 1);
    let mut is_reached = vec![false; fits.len()];
    let connected = Components::of([across, fits.len()], Neighbours::Four, |square| fits[square], watch)?;
    if let Some(around) = connected.iter().find(|squares| squares.first() == first) {
        around.cells().for_each(|square| is_reached[square] = true);
    }
    let mut is_outside = vec![false; is_known.len()];
    let mark = |padded: usize| {
        if let Some(cell) = coarse_cell(padded) {
            is_outside[cell] = true;
        }
    };
    morphology::mark_covered(&is_reached, across, SQUARE, mark, watch)?;
    Ok(is_outside)
}
