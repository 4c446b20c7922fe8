//! Dominant orientations: the directions along which the structure of a map is aligned.
//!
//! | method | how |
//! | --- | --- |
//! | energy (default) | maxima of the radiogram energy, of the whole map and of its parts (`by_energy`) |
//! | paper (II-B, Fig. 4) | gradient histogram, circular Gaussian mixture, wavelet peaks (`by_gradients`) |
//!
//! Limits: two orientations closer than `min_separation_deg` are one.

mod bins;
mod blocks;
mod by_energy;
mod by_gradients;
pub mod energy;
mod gradient;
mod mixture;
mod orientations;
mod refine;
pub(crate) mod slope;

#[cfg(test)]
mod tests;

use crate::grid::OccupancyGrid;
use crate::spec::{OrientationMethod, OrientationOptions};
use crate::watch::{Stopped, Watch};

pub use by_gradients::orientations_of_parts;
pub use orientations::Orientations;

/// Finds the dominant orientations of a grid.
///
/// # Errors
/// [`Stopped`] when the watch says so.
pub fn dominant_orientations(
    grid: &OccupancyGrid,
    options: &OrientationOptions,
    watch: &Watch<'_>,
) -> Result<Orientations, Stopped> {
    if options.method == OrientationMethod::Energy {
        return by_energy::by_energy(grid, options, watch);
    }
    let mut parts = orientations_of_parts(grid, 1, |_, _| Some(0), options, watch)?;
    Ok(parts.pop().unwrap_or_default())
}
