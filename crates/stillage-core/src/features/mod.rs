//! Shape features of the free space seen from a cell.
//!
//! Two profiles. [`Paper13`](FeatureProfile::Paper13), the default, is Table I of the paper (S. Gholami Shahbandi et
//! al., ECMR 2015, doi 10.1109/ECMR.2015.7324207; nine of the thirteen after O. Mozos) in metres, from the direction
//! sweep, in constant time per beam. [`Halmstad2017`](FeatureProfile::Halmstad2017) is the recipe of the author's own
//! published code, whose published categories it reproduces; it is there for that proof and costs many times as much.
//!
//! Only cells on the lattice of the stride are measured (column and row divisible by it). Where that lattice meets no
//! free cell at all, every free cell is measured, so that a map with free cells always has features.

mod halmstad;
mod lanes;
mod paper;
mod paper_sums;

use rayon::prelude::*;

use crate::grid::{Occupancy, OccupancyGrid};
use crate::spec::{CategorizationOptions, FeatureProfile};
use crate::watch::{Stopped, Watch};

/// Features of the measured free cells, one row per cell. The first feature is the mean beam length.
#[derive(Debug, Clone, PartialEq)]
pub struct CellFeatures {
    /// Index (row-major) of each measured cell, ascending.
    pub cells: Vec<u32>,
    /// Names of the features, in the order of a row.
    pub names: &'static [&'static str],
    /// `cells.len()` rows of `names.len()` values.
    pub values: Vec<f32>,
}

/// Casts beams from every free cell (of the stride) and reduces them to features.
///
/// # Errors
/// [`Stopped`] when the watch says so.
///
/// # Panics
/// When the grid has 2^32 cells or more.
pub fn extract(
    grid: &OccupancyGrid,
    options: &CategorizationOptions,
    watch: &Watch<'_>,
) -> Result<CellFeatures, Stopped> {
    let mut stride = options.stride;
    let mut cells = measured_cells(grid, stride);
    if cells.is_empty() {
        stride = 1;
        cells = measured_cells(grid, stride);
    }
    if cells.is_empty() {
        return Ok(CellFeatures { cells, names: names(options.profile), values: Vec::new() });
    }
    let values = match options.profile {
        FeatureProfile::Paper13 => paper::measure(grid, &cells, stride, options, watch)?,
        FeatureProfile::Halmstad2017 => halmstad::measure(grid, &cells, options, watch)?,
    };
    Ok(CellFeatures { cells, names: names(options.profile), values })
}

/// The names of a profile's features, in their order.
#[must_use]
pub const fn names(profile: FeatureProfile) -> &'static [&'static str] {
    match profile {
        FeatureProfile::Paper13 => &paper::NAMES,
        FeatureProfile::Halmstad2017 => &halmstad::NAMES,
    }
}

/// The free cells on the lattice of a stride, ascending.
fn measured_cells(grid: &OccupancyGrid, stride: usize) -> Vec<u32> {
    assert!(u32::try_from(grid.cells().len()).is_ok(), "cells are numbered by 32 bits");
    (0..grid.height())
        .into_par_iter()
        .step_by(stride)
        .flat_map_iter(|row| {
            let free = move |column: &usize| grid.row(row)[*column] == Occupancy::Free;
            (0..grid.width()).step_by(stride).filter(free).map(move |column| (row * grid.width() + column) as u32)
        })
        .collect()
}
