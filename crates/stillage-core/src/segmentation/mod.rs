//! Texture regions by Gabor energy. (to be written; becomes a folder)
use crate::geometry::OrientedBox;
use crate::grid::OccupancyGrid;
use crate::orientation::Orientations;
use crate::spec::AnalysisOptions;
use crate::watch::{Stopped, Watch};
use serde::{Deserialize, Serialize};

/// A partition of the known part of the map into regions, in whole tiles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RegionMap {
    /// Side of a tile, cells.
    pub tile_cells: usize,
    /// Tile columns; tile (0, 0) starts at cell (0, 0).
    pub columns: usize,
    /// Tile rows.
    pub rows: usize,
    /// Region of each tile, row-major, lowest row first; [`RegionMap::NONE`] outside the known part of the map.
    pub tiles: Vec<u8>,
    /// The regions, by id.
    pub regions: Vec<Region>,
}

/// A block of the map with a pattern of its own.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Region {
    /// Dominant orientations of this region, radians in `[-pi/2, pi/2)`, ascending.
    pub orientations: Vec<f64>,
    /// Box along the first orientation around the region's known cells.
    pub bounds: OrientedBox,
    /// Share of the known cells.
    pub share: f64,
}

impl RegionMap {
    /// No region: outside the known part of the map.
    pub const NONE: u8 = u8::MAX;

    /// Region of a cell, by column and row.
    #[must_use]
    pub fn region_of_cell(&self, column: usize, row: usize) -> Option<u8> {
        let tile = (row / self.tile_cells) * self.columns + column / self.tile_cells;
        self.tiles.get(tile).copied().filter(|&region| region != Self::NONE)
    }
}

/// Finds the regions of a grid. A grid without known cells has no region.
///
/// # Errors
/// [`Stopped`] when the watch says so.
pub fn segment(
    grid: &OccupancyGrid,
    global: &Orientations,
    options: &AnalysisOptions,
    watch: &Watch<'_>,
) -> Result<RegionMap, Stopped> {
    let _ = (grid, global, options, watch);
    todo!()
}
