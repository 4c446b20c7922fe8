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
pub enum LocationOccupancy {
    /// Obstacles inside.
    Occupied,
    /// Seen to be free inside.
    Empty,
    /// Not seen.
    Unknown,
}

/// Whether goods stand on a face. Goods hide what is behind them, so a few occupied cells outweigh many unknown ones.
pub(crate) fn occupancy(face: &FaceAnnotation) -> LocationOccupancy {
    let known = 1.0 - face.unknown_fraction;
    if face.inside_occupied_fraction > OCCUPIED_SHARE * known {
        LocationOccupancy::Occupied
    } else if face.unknown_fraction > UNKNOWN_SHARE {
        LocationOccupancy::Unknown
    } else {
        LocationOccupancy::Empty
    }
}
