//! Place categories: features, scaled and clustered. (to be written)
use crate::features::CellFeatures;
use crate::grid::OccupancyGrid;
use crate::spec::CategorizationOptions;
use crate::watch::{Stopped, Watch};
use serde::{Deserialize, Serialize};

/// The category of every cell.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CategoryMap {
    /// Category of each cell, row-major; [`CategoryMap::NONE`] where the cell is not free.
    pub cells: Vec<u8>,
    /// The clusters, by category. Numbered in a canonical order (ascending mean beam length of the cluster).
    pub categories: Vec<Category>,
    /// Names of the features behind [`Category::mean_features`].
    pub feature_names: Vec<String>,
}

/// One cluster of places.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Category {
    /// How many free cells carry it.
    pub cells: usize,
    /// Mean of each feature over the measured cells, unscaled, in the order of [`CategoryMap::feature_names`].
    pub mean_features: Vec<f64>,
}

impl CategoryMap {
    /// No category: the cell is not free.
    pub const NONE: u8 = u8::MAX;

    /// The face-level category of faces that hold no free cell but occupied ones.
    #[must_use]
    pub fn occupied(&self) -> u8 {
        self.categories.len() as u8
    }

    /// The face-level category of faces that hold no known cell at all.
    #[must_use]
    pub fn unknown(&self) -> u8 {
        self.categories.len() as u8 + 1
    }

    /// Number of categories a face may have: the clusters, `occupied` and `unknown`.
    #[must_use]
    pub fn face_categories(&self) -> usize {
        self.categories.len() + 2
    }
}

/// Clusters the features into place categories and gives every free cell one.
///
/// # Errors
/// [`Stopped`] when the watch says so.
pub fn categorize(
    grid: &OccupancyGrid,
    features: &CellFeatures,
    options: &CategorizationOptions,
    seed: u64,
    watch: &Watch<'_>,
) -> Result<CategoryMap, Stopped> {
    let _ = (grid, features, options, seed, watch);
    todo!()
}
