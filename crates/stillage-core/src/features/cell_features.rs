//! Features of measured cells.

/// Features of measured free cells, one row per cell. The first feature is the mean beam length.
#[derive(Debug, Clone, PartialEq)]
pub struct CellFeatures {
    /// Index (row-major) of each measured cell, ascending.
    pub cells: Vec<u32>,
    /// Names of the features, in the order of a row.
    pub names: &'static [&'static str],
    /// `cells.len()` rows of `names.len()` values.
    pub values: Vec<f32>,
}
