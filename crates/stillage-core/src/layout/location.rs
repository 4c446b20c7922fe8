//! A storage location: its code, place, size, occupancy and access.

use serde::{Deserialize, Serialize};

use super::occupancy::LocationOccupancy;
use crate::arrangement::{EdgeId, FaceId};
use crate::geometry::Point;
use crate::semantics::LabelId;

/// Side of its aisle, seen along the aisle's direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Side {
    /// Odd bays.
    Left,
    /// Even bays.
    Right,
}

/// Where a vehicle stands to reach a location.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ApproachPose {
    /// Position of its middle in the corridor, grid frame, metres.
    pub position: Point,
    /// Direction towards the location, radians, grid frame.
    pub heading: f64,
}

/// One place for goods with what an inventory system needs of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Location {
    /// Its name in other systems, unique in its map, like `03-012`.
    pub code: String,
    /// The storage face that it is, or is a part of.
    pub face: FaceId,
    /// Which part of the face it is, from 0 along the row; 0 for a whole face.
    pub part: u32,
    /// Of how many parts its face is.
    pub parts: u32,
    /// Its border, grid frame, counter-clockwise, metres; the first point is not repeated.
    pub outline: Vec<Point>,
    /// Its label.
    pub label: LabelId,
    /// Number of its aisle, from 1; 0 without access.
    pub aisle: u32,
    /// Number of its bay within the aisle: odd on the left, even on the right.
    pub bay: u32,
    /// Number of its row, from 1; 0 without access.
    pub row: u32,
    /// Side of the aisle; `None` without access.
    pub side: Option<Side>,
    /// How deep in the row it lies: 1 at the aisle, 2 behind that, and so on.
    pub depth_in_row: u32,
    /// Centre, grid frame, metres.
    pub center: Point,
    /// Extent along the access edge, metres.
    pub width: f64,
    /// Extent away from the access edge, metres.
    pub depth: f64,
    /// Direction from the access edge into the location, radians, grid frame.
    pub heading: f64,
    /// Area, square metres.
    pub area: f64,
    /// Whether goods stand there.
    pub occupancy: LocationOccupancy,
    /// Edges through which it is reached, the best first. Those of the location in front for one that lies behind.
    pub access_edges: Vec<EdgeId>,
    /// The drivable face behind the first access edge.
    pub access_from: Option<FaceId>,
    /// The place (corridor, junction or room) of that face.
    pub corridor: Option<u32>,
    /// The middle of the border over which it is reached; that of the location in front for one that lies behind.
    pub front: Option<Point>,
    /// Where a vehicle stands to reach it; `None` where nothing as wide as the vehicle has room before it.
    pub approach: Option<ApproachPose>,
}
