//! How a model was found.

use serde::{Deserialize, Serialize};

/// How a model was found.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct FitReport {
    /// Number of clusters.
    pub k: usize,
    /// Rows it was fitted to.
    pub rows: usize,
    /// Mean squared distance of these rows to their centroid, scaled: inertia over rows.
    pub mean_squared_distance: f64,
    /// The numbers of clusters that were tried; empty where the number was given.
    pub candidates: Vec<Candidate>,
    /// The mixture, if there is one.
    pub mixture: Option<MixtureReport>,
}

/// A number of clusters that was tried.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Candidate {
    /// Number of clusters.
    pub k: usize,
    /// Prediction strength: how well one half of the rows predicts the clusters of the other, 0 to 1.
    pub prediction_strength: f64,
}

/// How a mixture was fitted.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct MixtureReport {
    /// Rows it was fitted to.
    pub rows: usize,
    /// Mean logarithm of the density of these rows.
    pub log_likelihood: f64,
    /// Bayesian information criterion, lower is better. It counts rows as independent, which neighbouring cells are
    /// not.
    pub bic: f64,
    /// Iterations of expectation-maximization.
    pub iterations: usize,
}
