//! What a drawing is asked for.

use super::outside::Outside;

/// How a drawing departs from what its seed decides.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct DrawingOptions {
    /// Side of a cell, metres; drawn by the seed when absent.
    pub resolution: Option<f64>,
    /// Factor of the side of a cell, the hall staying as it is; 1 when absent.
    pub scale: Option<f64>,
    /// Turn of the hall in the map, degrees; drawn by the seed when absent.
    pub rotation_deg: Option<f64>,
    /// Added to the turn, degrees.
    pub turned_deg: f64,
    /// How far the cells are moved under the hall, along x and along y, in cells.
    pub shifted_cells: f64,
    /// Length and depth of the hall, metres, at most; drawn by the seed when absent.
    pub hall: Option<[f64; 2]>,
    /// What lies beyond the walls; drawn by the seed when absent.
    pub outside: Option<Outside>,
    /// Distance of the walls to the border of the picture, metres; drawn by the seed when absent.
    pub margin: Option<f64>,
}
