//! Clustering of rows of numbers: scaling of their columns, then k-means.

mod kmeans;
mod scaling;

pub use kmeans::{Clusters, KMeansOptions, k_means};
pub use scaling::ScaledRows;
