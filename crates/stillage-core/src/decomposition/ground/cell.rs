//! One cell of a region's frame in one byte.

use crate::grid::Occupancy;

const OCCUPANCY: u8 = 0b11;
const INSIDE: u8 = 0b100;
const DRIVABLE: u8 = 0b1000;

/// Occupancy of a cell, whether it belongs to the region, and whether a vehicle finds room on it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Cell(u8);

impl Cell {
    /// A cell that is not drivable yet; `is_inside` says whether it belongs to the region and to the site.
    pub const fn new(occupancy: Occupancy, is_inside: bool) -> Self {
        Self(occupancy as u8 | if is_inside { INSIDE } else { 0 })
    }

    pub const fn is_free(self) -> bool {
        self.0 & OCCUPANCY == Occupancy::Free as u8
    }

    pub const fn is_occupied(self) -> bool {
        self.0 & OCCUPANCY == Occupancy::Occupied as u8
    }

    pub const fn is_unknown(self) -> bool {
        self.0 & OCCUPANCY == Occupancy::Unknown as u8
    }

    /// Whether it belongs to the region and to the site.
    pub const fn is_inside(self) -> bool {
        self.0 & INSIDE != 0
    }

    pub const fn is_drivable(self) -> bool {
        self.0 & DRIVABLE != 0
    }

    pub fn mark_occupied(&mut self) {
        self.0 = self.0 & !OCCUPANCY | Occupancy::Occupied as u8;
    }

    pub fn clear_drivable(&mut self) {
        self.0 &= !DRIVABLE;
    }

    pub fn mark_drivable(&mut self) {
        self.0 |= DRIVABLE;
    }
}
