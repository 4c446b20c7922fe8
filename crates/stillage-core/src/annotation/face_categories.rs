//! The categories that faces may have, by number.

use serde::{Deserialize, Serialize};

use crate::categorization::CategoryMap;

/// The categories that faces may have: clusters, and three for faces without a categorized cell.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct FaceCategories {
    /// Number of clusters, of cells where cells vote and of faces where faces are clustered.
    pub clusters: usize,
}

impl From<&CategoryMap> for FaceCategories {
    /// Where cells vote, the categories of cells are the clusters.
    fn from(categories: &CategoryMap) -> Self {
        Self { clusters: categories.categories.len() }
    }
}

impl FaceCategories {
    /// Faces that hold no free cell but occupied ones.
    #[must_use]
    pub fn occupied(&self) -> u8 {
        self.clusters as u8
    }

    /// Faces among known places that hold no known cell at all.
    #[must_use]
    pub fn unknown(&self) -> u8 {
        self.clusters as u8 + 1
    }

    /// Unexplored faces that are joined with the ground outside the map.
    #[must_use]
    pub fn outside(&self) -> u8 {
        self.clusters as u8 + 2
    }

    /// Number of categories a face may have.
    #[must_use]
    pub fn count(&self) -> usize {
        self.clusters + 3
    }
}
