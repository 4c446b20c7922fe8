//! Radiography: projection of the occupied cells along each orientation, peaks, lines. (to be written)
use crate::grid::OccupancyGrid;
use crate::segmentation::RegionMap;
use crate::spec::DecompositionOptions;
use crate::watch::{Stopped, Watch};
use serde::{Deserialize, Serialize};

/// Projection of the occupied cells of a region on the normal of an orientation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Radiogram {
    /// Region it was taken of.
    pub region: u8,
    /// Direction of projection (and of its lines), radians.
    pub orientation: f64,
    /// Offset of the lower edge of the first bin along the normal, metres.
    pub start: f64,
    /// Width of a bin, metres.
    pub bin: f64,
    /// Occupied length per bin after smoothing, metres (occupied cells x resolution).
    pub values: Vec<f64>,
}

/// A straight alignment of occupied cells.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Line {
    /// Region it belongs to.
    pub region: u8,
    /// Direction, radians in `[-pi/2, pi/2)`.
    pub orientation: f64,
    /// Signed distance from the grid origin along [`crate::geometry::normal`], metres.
    pub offset: f64,
    /// Height of its peak: occupied length along the line, metres.
    pub support: f64,
    /// Where the line runs: stretches `[start, end]` along [`crate::geometry::direction`], ascending, metres.
    pub extents: Vec<[f64; 2]>,
}

/// Takes the radiograms of every region and reads the lines from their peaks.
///
/// # Errors
/// [`Stopped`] when the watch says so.
pub fn lines(
    grid: &OccupancyGrid,
    regions: &RegionMap,
    options: &DecompositionOptions,
    watch: &Watch<'_>,
) -> Result<(Vec<Radiogram>, Vec<Line>), Stopped> {
    let _ = (grid, regions, options, watch);
    todo!()
}
