//! Shape features of the free space seen from a cell.
//!
//! | profile | what it is | cost |
//! | --- | --- | --- |
//! | [`Paper13`](crate::spec::FeatureProfile::Paper13), the default | Table I of the paper (S. Gholami Shahbandi et al., ECMR 2015, doi 10.1109/ECMR.2015.7324207; nine of the thirteen after O. Mozos), in metres | constant per beam |
//! | [`Halmstad2017`](crate::spec::FeatureProfile::Halmstad2017) | the recipe of the author's published code; reproduces his published categories | many times as much |
//!
//! Only cells on the lattice of the stride are measured (column and row divisible by it). Where no free cell lies on
//! that lattice, every free cell is measured, so that a map with free cells always has features.

mod cell_features;
mod halmstad;
mod lattice;
mod paper;
mod paper_sums;
mod simd;
mod source;

pub use cell_features::CellFeatures;
pub use paper::Workspace;
pub use source::{FeatureSource, names};
