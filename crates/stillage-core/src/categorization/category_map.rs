//! The category of every cell, and what the categories are.

use serde::{Deserialize, Serialize};

use crate::clustering::FitReport;
use crate::relaxation::RelaxationReport;

/// The category of every cell.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CategoryMap {
    /// Category of each cell, row-major; [`CategoryMap::NONE`] where the cell is not free.
    pub cells: Vec<u8>,
    /// The clusters, by category, in ascending order of their mean beam length.
    pub categories: Vec<Category>,
    /// Names of the features behind [`Category::mean_features`].
    pub feature_names: Vec<String>,
    /// How the clusters were found.
    pub fit: FitReport,
    /// What the relaxation of the cells did, where it was asked for.
    pub relaxation: Option<RelaxationReport>,
}

/// One cluster of places.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Category {
    /// Number of free cells that have it.
    pub cells: usize,
    /// Mean of each feature over the measured cells of the cluster (before any relaxation), unscaled, in the order of
    /// [`CategoryMap::feature_names`].
    pub mean_features: Vec<f64>,
}

impl CategoryMap {
    /// No category: the cell is not free.
    pub const NONE: u8 = u8::MAX;
}
