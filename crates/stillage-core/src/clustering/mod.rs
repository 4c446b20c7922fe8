//! Clustering of rows of numbers: a model is fitted to a sample, then every row is assigned by the model alone.
//!
//! [`fit()`] takes a sample (or all rows) and gives a [`PlaceModel`]: the scaling of the columns with the centroids of
//! k-means, or with a Gaussian mixture. The model is immutable and can be stored. [`PlaceModel::assign`] gives the rows
//! of a block their clusters, [`PlaceModel::memberships`] their distributions over the clusters. Neither has a state,
//! so blocks of any size on any number of threads give the same bytes.
//!
//! Clusters are numbered by the mean of the first column over the rows they were fitted to: the same whatever the seed.

mod fit;
mod kmeans;
mod mixture;
mod model;
mod points;
mod random;
mod report;
mod scaling;
mod strength;

#[cfg(test)]
mod reference_tests;

pub use fit::{FitOptions, Method, fit};
pub use kmeans::{KMeansOptions, k_means};
pub use mixture::GaussianMixture;
pub use model::PlaceModel;
pub use report::{Candidate, FitReport, MixtureReport};
pub use scaling::RowScaling;
