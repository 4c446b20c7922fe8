//! Rows of equal marks: pallets one beside the other, the frames or the uprights between bays, the legs of pods, dashes.
//!
//! A person sees such rows at a glance, whatever the marks are: equal things in one line at a regular distance. Neither
//! aisles nor the size of a vehicle are needed to find them, and what lies between the marks may be as free as an aisle.
//!
//! | step | module | what comes out |
//! | --- | --- | --- |
//! | 1 | [`mark`] | things, and holes in things, no larger than a place |
//! | 2 | [`mark_line`] | equal marks in one line |
//! | 3 | [`pitch`], [`mark_lattice`], [`mark_run`] | the pitch that most lines have in common, and the runs of marks that keep it |
//! | 4 | [`faces`] | runs of thin marks as the front and the back of one row |
//! | 5 | [`marked_row`] | the borders between the places of each row |
//! | 6 | [`region_rows`], [`block`] | the rows of a region: those that explain most marks, and racks of few bays side by side |
//!
//! Limits: a scan shows equal things unequal, so goods in a scan are read by their shape
//! ([`crate::decomposition`]), and rows of marks are laid out only where these explain more.
//! Cost: O(cells + marks x pitches).

mod block;
mod faces;
mod mark;
mod mark_lattice;
mod mark_line;
mod mark_run;
mod marked_row;
mod pitch;
mod range;
mod region_rows;

#[cfg(test)]
mod tests;

use crate::grid::{Occupancy, OccupancyGrid};
use crate::segmentation::RegionMap;
use crate::watch::{Stopped, Watch};

use mark::GridParts;
pub(crate) use marked_row::MarkedRow;
use region_rows::RegionRows;

/// The rows of equal marks of a map.
#[derive(Debug, Clone, Default)]
pub(crate) struct MarkedRows {
    /// Rows of those regions where most marks stand in rows.
    pub rows: Vec<MarkedRow>,
    /// Share of the marks around these rows that stand in them; the least of all regions.
    pub explained: f64,
    /// Racks of few bays side by side, whatever else stands around them.
    pub blocks: Vec<MarkedRow>,
}

impl MarkedRows {
    /// Finds the rows of a map, region by region.
    ///
    /// # Errors
    /// [`Stopped`] when the watch says so.
    pub(crate) fn find(grid: &OccupancyGrid, regions: &RegionMap, watch: &Watch<'_>) -> Result<Self, Stopped> {
        let parts = GridParts::of(grid, watch)?;
        let mut found = Self { explained: 1.0, ..Self::default() };
        for (region, orientations) in (0_u8..).zip(regions.regions.iter().map(|region| &region.orientations)) {
            let Some(&angle) = orientations.first() else { continue };
            let RegionRows { rows, explained, blocks } =
                RegionRows::find(grid, &parts, regions, (region, angle), watch)?;
            if !rows.is_empty() {
                found.explained = found.explained.min(explained);
            }
            found.rows.extend(rows);
            found.blocks.extend(blocks);
        }
        Ok(found)
    }

    /// Distance from place to place of most rows, metres; 0 without rows.
    pub(crate) fn usual_pitch(&self) -> f64 {
        range::median(self.rows.iter().map(MarkedRow::pitch)).unwrap_or(0.0)
    }

    /// Number of places of the rows.
    pub(crate) fn place_count(&self) -> usize {
        self.rows.iter().map(MarkedRow::count).sum()
    }
}

/// The grid with rows as solid as they are to a vehicle.
pub(crate) fn filled(grid: &OccupancyGrid, rows: &[MarkedRow]) -> OccupancyGrid {
    let mut cells = grid.cells().to_vec();
    for (column, line) in rows.iter().flat_map(|row| grid.cells_within(&row.bounds())) {
        cells[line * grid.width() + column] = Occupancy::Occupied;
    }
    OccupancyGrid::new(grid.width(), grid.height(), *grid.frame(), cells)
}
