//! All options of an analysis, in groups.

use serde::{Deserialize, Serialize};

use super::categorization::CategorizationOptions;
use super::groups::{
    AnnotationOptions, DeclutterOptions, DecompositionOptions, GridOptions, OrientationOptions, RegionOptions,
};

/// Everything that decides the result of an analysis beside the map itself.
///
/// The groups keep their order: stored analyses hold them by position. A new group goes to the end.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct AnalysisOptions {
    /// Seed of every random choice (k-means, jitter).
    pub seed: u64,
    /// How grey levels become occupancy.
    pub grid: GridOptions,
    /// Place categories.
    pub categorization: CategorizationOptions,
    /// Dominant orientations.
    pub orientation: OrientationOptions,
    /// Regions of one direction or texture.
    pub regions: RegionOptions,
    /// Radiography and lines.
    pub decomposition: DecompositionOptions,
    /// Categories of faces.
    pub annotation: AnnotationOptions,
    /// Removal of clutter, the first stage.
    pub declutter: DeclutterOptions,
}

impl Default for AnalysisOptions {
    fn default() -> Self {
        Self {
            seed: 1,
            grid: GridOptions::default(),
            categorization: CategorizationOptions::default(),
            orientation: OrientationOptions::default(),
            regions: RegionOptions::default(),
            decomposition: DecompositionOptions::default(),
            annotation: AnnotationOptions::default(),
            declutter: DeclutterOptions::default(),
        }
    }
}
