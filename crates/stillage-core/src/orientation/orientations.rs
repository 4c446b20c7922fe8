//! What was found, and the signals behind it.

use serde::{Deserialize, Serialize};

/// The dominant orientations and the signals they were found in (for plots).
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Orientations {
    /// Directions of lines, radians in `[-pi/2, pi/2)`, ascending.
    pub angles: Vec<f64>,
    /// Weights over line directions in `[-pi/2, pi/2)`, evenly spaced bins, sum 1: of gradients, or the contrast of the
    /// radiogram energy. Empty without gradients or contrast.
    pub histogram: Vec<f64>,
    /// The density of the Gaussian mixture at the same bins. Empty without gradients.
    pub mixture: Vec<f64>,
}
