//! Dominant orientations: weighted HOG -> circular Gaussian mixture -> CWT peaks. (to be written)
use crate::grid::OccupancyGrid;
use crate::spec::OrientationOptions;
use crate::watch::{Stopped, Watch};
use serde::{Deserialize, Serialize};

/// The dominant orientations and the signals they were read from (for plots).
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Orientations {
    /// Directions of lines, radians in `[-pi/2, pi/2)`, ascending.
    pub angles: Vec<f64>,
    /// Weighted histogram over line directions in `[-pi/2, pi/2)`, evenly spaced bins, sum 1 (empty without gradients).
    pub histogram: Vec<f64>,
    /// The mixture's density at the same bins: the histogram after the aggressive low-pass.
    pub mixture: Vec<f64>,
}

/// Finds the dominant orientations of a grid.
///
/// # Errors
/// [`Stopped`] when the watch says so.
pub fn dominant_orientations(
    grid: &OccupancyGrid,
    options: &OrientationOptions,
    watch: &Watch<'_>,
) -> Result<Orientations, Stopped> {
    let _ = (grid, options, watch);
    todo!()
}
