//! What a user may ask for ([`AnalysisOptions`]) and what the stages rely on ([`AnalysisSpec`]).
//!
//! The options are one JSON object, the same for the API and the command line: every field is optional, unknown fields
//! are refused, and the whole object with its defaults is part of the result. A [`Preset`] is a whole set of options
//! under one name. [`AnalysisOptions::check`] turns options into a spec; functions that take a spec, or one of its
//! groups, assume that it is valid.

mod categorization;
mod check;
mod groups;
mod options;
mod preset;
mod vehicle_width;

pub use categorization::{
    CategorizationOptions, CategoryCount, ClusteringMethod, Covariance, FeatureProfile, RelaxationOptions, Scaling,
};
pub use check::{AnalysisSpec, OptionProblem};
pub use groups::{
    AnnotationMethod, AnnotationOptions, DeclutterMethod, DeclutterOptions, DecompositionMethod, DecompositionOptions,
    GridOptions, GridSemantics, OrientationMethod, OrientationOptions, RegionMethod, RegionOptions,
};
pub use options::AnalysisOptions;
pub use preset::Preset;
pub use vehicle_width::VehicleWidth;
