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

/// Where a robot stands to reach a location.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ApproachPose {
    /// Position in the corridor, grid frame, metres.
    pub position: Point,
    /// Direction towards the location, radians, grid frame.
    pub heading: f64,
}

/// A storage face with what an inventory system needs of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Location {
    /// `aisle-bay`, unique in its map, like `03-012`. Locations without access have aisle 0.
    pub code: String,
    /// The storage face.
    pub face: FaceId,
    /// Its label.
    pub label: LabelId,
    /// Aisle number from 1, 0 without access.
    pub aisle: u32,
    /// Bay number within the aisle: odd on the left, even on the right.
    pub bay: u32,
    /// Side of the aisle, `None` without access.
    pub side: Option<Side>,
    /// Centre, grid frame, metres.
    pub center: Point,
    /// Extent along the access edge, metres.
    pub width: f64,
    /// Extent away from the access edge, metres.
    pub depth: f64,
    /// Direction from the access edge into the location, radians, grid frame.
    pub heading: f64,
    /// Whether goods stand there.
    pub occupancy: LocationOccupancy,
    /// Edges through which it is reached, the best first.
    pub access_edges: Vec<EdgeId>,
    /// The drivable face behind the first access edge.
    pub access_from: Option<FaceId>,
    /// Where a robot stands to reach it.
    pub approach: Option<ApproachPose>,
}
