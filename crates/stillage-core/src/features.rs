//! Shape features of the free space seen from a cell. (to be written)
use crate::grid::OccupancyGrid;
use crate::spec::CategorizationOptions;
use crate::watch::{Stopped, Watch};

/// Features of the measured free cells, one row per cell.
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
pub fn extract(
    grid: &OccupancyGrid,
    options: &CategorizationOptions,
    watch: &Watch<'_>,
) -> Result<CellFeatures, Stopped> {
    let _ = (grid, options, watch);
    todo!()
}
