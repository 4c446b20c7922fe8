//! Lines: what cuts the map into faces.

use serde::{Deserialize, Serialize};

/// A straight line with the stretches along which it runs: an alignment of occupied cells, or the border of a place or
/// a room.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Line {
    /// Region it belongs to; [`RegionMap::NONE`](crate::segmentation::RegionMap::NONE) for the border of a room.
    pub region: u8,
    /// Direction, radians in `[-pi/2, pi/2)`.
    pub orientation: f64,
    /// Signed distance from the grid origin along [`crate::geometry::normal`], metres.
    pub offset: f64,
    /// Occupied length along the line, metres; in the paper's decomposition the height of its peak.
    pub support: f64,
    /// Stretches `[start, end]` along [`crate::geometry::direction`], ascending, metres.
    pub extents: Vec<[f64; 2]>,
}
