//! Which region a cell belongs to, in whole tiles.

use serde::{Deserialize, Serialize};

use crate::geometry::OrientedBox;

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

/// A part of the map with orientations of its own.
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

    /// The first direction of the largest region, radians; 0 without regions.
    pub(crate) fn main_direction(&self) -> f64 {
        let largest = self.regions.iter().max_by(|one, other| one.share.total_cmp(&other.share));
        largest.and_then(|region| region.orientations.first().copied()).unwrap_or(0.0)
    }

    /// Region of a cell, by column and row.
    #[must_use]
    pub fn region_of_cell(&self, column: usize, row: usize) -> Option<u8> {
        let tile = (row / self.tile_cells) * self.columns + column / self.tile_cells;
        self.tiles.get(tile).copied().filter(|&region| region != Self::NONE)
    }
}
