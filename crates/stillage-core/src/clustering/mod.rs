//! Clustering of rows of numbers: a model fitted to a sample, then every row assigned by the model alone.
//!
//! [`fit`] sees a sample (or all rows) and gives a [`PlaceModel`]: the scaling of the columns with the centroids of
//! k-means, or with a Gaussian mixture. The model is immutable and can be stored. [`PlaceModel::assign`] gives the rows
//! of a block their clusters, [`PlaceModel::memberships`] their distributions over the clusters; neither has a state, so
//! blocks of any size on any number of threads give the same bytes.
//!
//! Clusters are numbered by the mean of the first column over the rows they were fitted to: the same whatever the seed.

mod kmeans;
mod mixture;
mod model;
mod points;
mod random;
mod scaling;
mod strength;

#[cfg(test)]
mod reference_tests;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

pub use kmeans::{KMeansOptions, k_means};
pub use mixture::GaussianMixture;
pub use model::PlaceModel;
pub use scaling::RowScaling;

use crate::spec::{CategoryCount, Covariance, Scaling};
use crate::watch::{Stage, Stopped, Watch};
use points::{Points, sample};

/// Rows that a mixture is fitted to: a hundred for each parameter of five full covariances of thirteen columns.
const MIXTURE_ROWS: usize = 50_000;
/// Starts of a mixture, and the iterations of k-means before all but the first.
const MIXTURE_STARTS: u64 = 6;
const COARSE_ITERATIONS: usize = 10;

/// A way to cluster.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// k-means.
    KMeans,
    /// A Gaussian mixture, started by k-means.
    GaussianMixture(Covariance),
}

/// How to fit a model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FitOptions {
    /// What kind of clusters.
    pub method: Method,
    /// How many of them.
    pub count: CategoryCount,
    /// Most clusters when their number is found, 2 to 255.
    pub max_count: usize,
    /// How columns are made comparable.
    pub scaling: Scaling,
    /// Restarts of k-means, the best one wins.
    pub restarts: usize,
    /// Most iterations of one run, of k-means and of expectation-maximization.
    pub max_iterations: usize,
    /// When the centroids of k-means rest: see [`KMeansOptions::tolerance`].
    pub tolerance: f64,
    /// Most rows that centroids are fitted to; a sample is drawn where there are more.
    pub fit_rows: usize,
    /// Seed of all that is drawn.
    pub seed: u64,
}

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
    /// Numbers of clusters that were tried; empty where the number was given.
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
    /// How well one half of the rows predicts the clusters of the other, 0 to 1.
    pub prediction_strength: f64,
}

/// How a mixture was fitted.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct MixtureReport {
    /// Rows it was fitted to.
    pub rows: usize,
    /// Mean logarithm of their density.
    pub log_likelihood: f64,
    /// Bayesian information criterion, less is better. It counts rows as independent, which neighbouring cells are not.
    pub bic: f64,
    /// Iterations of expectation-maximization.
    pub iterations: usize,
}

/// Fits a model to rows of `columns` numbers each. Without rows there are no clusters; there are fewer than asked for
/// where there are fewer distinct rows, and a cluster that no row of the sample is in is left out.
///
/// # Errors
/// [`Stopped`] when the watch says so.
///
/// # Panics
/// When the values are no whole rows, or a number of clusters is out of range.
pub fn fit(
    rows: &[f32],
    columns: usize,
    options: &FitOptions,
    watch: &Watch<'_>,
) -> Result<(PlaceModel, FitReport), Stopped> {
    let scaling = RowScaling::fit(rows, columns, options.scaling);
    let chosen = sample(rows.len() / columns, options.fit_rows, options.seed);
    let mut points = Points::default();
    points.refill(rows, &scaling, chosen.iter().copied());
    let mut search = KMeansOptions {
        k: options.max_count,
        restarts: options.restarts,
        max_iterations: options.max_iterations,
        tolerance: options.tolerance,
        fit_rows: options.fit_rows,
        seed: options.seed,
    };
    let [searched, centered] = parts_of_the_time(options);
    let candidates = match options.count {
        CategoryCount::Auto => strength::candidates(&points, &search, &watch.part(0.0, searched))?,
        CategoryCount::Fixed(_) => Vec::new(),
    };
    search.k = match options.count {
        CategoryCount::Fixed(count) => count,
        CategoryCount::Auto => strength::choose(&candidates),
    };
    let run = kmeans::fit(&points, &search, &watch.part(searched, centered))?;
    let mean_squared_distance = run.inertia / points.len().max(1) as f64;
    let mut mixture = None;
    let mut model = match options.method {
        Method::GaussianMixture(covariance) if points.len() > 0 => {
            let few = points.select(sample(points.len(), MIXTURE_ROWS, options.seed).into_iter());
            let fitted = fit_mixture(&few, run.centroids, covariance, &search, &watch.part(centered, 1.0))?;
            mixture = Some(MixtureReport {
                rows: few.len(),
                log_likelihood: fitted.log_likelihood,
                bic: fitted.criterion(few.len()),
                iterations: fitted.iterations,
            });
            PlaceModel::mixture(scaling, fitted.mixture)
        }
        _ => PlaceModel::centroids(scaling, run.centroids, mean_squared_distance),
    };
    model.number(&points, |point| rows[chosen[point] * columns], watch)?;
    let report = FitReport { k: model.len(), rows: points.len(), mean_squared_distance, candidates, mixture };
    Ok((model, report))
}

/// Shares of the time of a fit when the number of clusters is found, and when its centroids are. Finding the number took
/// 7 times as long as k-means itself, a mixture 7 times as well (360,000 rows of thirteen features).
fn parts_of_the_time(options: &FitOptions) -> [f64; 2] {
    const TIMES_K_MEANS: f64 = 7.0;
    let search = if options.count == CategoryCount::Auto { TIMES_K_MEANS } else { 0.0 };
    let mixture = if options.method == Method::KMeans { 0.0 } else { TIMES_K_MEANS };
    let whole = search + 1.0 + mixture;
    [search / whole, (search + 1.0) / whole]
}

/// Fits a mixture from the best centroids and from those of some single runs of k-means: the best centroids are not the
/// best start as a rule. The likeliest wins.
fn fit_mixture(
    points: &Points,
    best: Vec<f32>,
    covariance: Covariance,
    search: &KMeansOptions,
    watch: &Watch<'_>,
) -> Result<mixture::Fitted, Stopped> {
    let starts = (1..MIXTURE_STARTS).into_par_iter().map(|start| {
        // The mixture does the fine work: coarse centroids will do.
        let seed = search.seed.wrapping_add(start);
        let coarse = KMeansOptions { restarts: 1, max_iterations: COARSE_ITERATIONS, seed, ..*search };
        Ok(kmeans::fit(points, &coarse, &watch.silent())?.centroids)
    });
    let starts: Result<Vec<Vec<f32>>, Stopped> = rayon::iter::once(Ok(best)).chain(starts).collect();
    let steps = watch.steps(Stage::Clustering, MIXTURE_STARTS as usize);
    let fits: Result<Vec<mixture::Fitted>, Stopped> = starts?
        .into_par_iter()
        .map(|start| {
            let fitted =
                mixture::fit(points, &start, covariance, mixture::REGULARIZATION, search.max_iterations, watch)?;
            steps.count_one();
            Ok(fitted)
        })
        .collect();
    let best =
        fits?.into_iter().reduce(|best, other| if other.log_likelihood > best.log_likelihood { other } else { best });
    Ok(best.expect("there is at least one start"))
}
