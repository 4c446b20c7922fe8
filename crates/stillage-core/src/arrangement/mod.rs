//! The subdivision of the plane by a set of segments. (builder to be written)

mod ids;
mod subdivision;

pub use ids::{EdgeId, FaceId, HalfEdgeId, VertexId};
pub use subdivision::{EdgeSource, HalfEdge, Subdivision};

use crate::geometry::Point;
use crate::grid::OccupancyGrid;
use crate::radiography::Line;
use crate::segmentation::RegionMap;
use crate::watch::{Stopped, Watch};

/// A segment that goes into the arrangement, with what it stands for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SourceSegment {
    /// One end.
    pub start: Point,
    /// The other end.
    pub end: Point,
    /// What it stands for.
    pub source: EdgeSource,
}

/// The segments of a decomposition: the boundaries of the regions and the stretches of the lines.
#[must_use]
pub fn source_segments(grid: &OccupancyGrid, regions: &RegionMap, lines: &[Line]) -> Vec<SourceSegment> {
    let _ = (grid, regions, lines);
    todo!()
}

/// Subdivides the plane by segments.
///
/// # Errors
/// [`Stopped`] when the watch says so.
pub fn arrange(segments: &[SourceSegment], watch: &Watch<'_>) -> Result<Subdivision, Stopped> {
    let _ = (segments, watch);
    todo!()
}
