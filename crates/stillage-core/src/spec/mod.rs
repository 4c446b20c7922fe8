//! What a user may ask for ([`AnalysisOptions`]) and what the stages rely on ([`AnalysisSpec`]).
//!
//! The options are one JSON object, the same for the API and the command line: every field is optional, unknown
//! fields are refused, and the whole object with its defaults is echoed in the result. A [`Preset`] is a whole set of
//! options under one name. [`AnalysisOptions::check`] turns options into a spec; functions that take a spec, or one of
//! its groups, assume that it is valid.

mod categorization;
mod check;
mod groups;
mod preset;

use serde::{Deserialize, Serialize};

pub use categorization::{
    CategorizationOptions, CategoryCount, ClusteringMethod, Covariance, FeatureProfile, RelaxationOptions, Scaling,
};
pub use check::OptionProblem;
pub use groups::{
    AnnotationMethod, AnnotationOptions, DeclutterMethod, DeclutterOptions, DecompositionMethod, DecompositionOptions,
    GridOptions, OrientationMethod, OrientationOptions, RegionMethod, RegionOptions,
};
pub use preset::Preset;

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

/// Options that were checked: each value is within its range.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
#[serde(transparent)]
pub struct AnalysisSpec(AnalysisOptions);

impl AnalysisSpec {
    /// The options behind the spec, with every default filled in.
    #[must_use]
    pub const fn options(&self) -> &AnalysisOptions {
        &self.0
    }
}
