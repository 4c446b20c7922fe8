//! Fits a model: scaling, number of clusters, k-means, and a mixture if one is asked for.

use rayon::prelude::*;

use super::kmeans::{self, KMeansOptions};
use super::mixture;
use super::model::PlaceModel;
use super::points::{Points, sample};
use super::report::{FitReport, MixtureReport};
use super::scaling::RowScaling;
use super::strength;
use crate::spec::{CategoryCount, Covariance, Scaling};
use crate::watch::{Stage, Stopped, Watch};

/// Rows that a mixture is fitted to: about a hundred for each parameter of five full covariances of thirteen columns.
const MIXTURE_ROWS: usize = 50_000;

/// Starts of the fit of a mixture; the likeliest fit is kept.
const MIXTURE_STARTS: u64 = 6;

/// Iterations of k-means before each start but the first.
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
    /// Restarts of k-means; the best one is kept.
    pub restarts: usize,
    /// Most iterations of one run, of k-means and of expectation-maximization.
    pub max_iterations: usize,
    /// Movement of the centroids below which k-means ends: see [`KMeansOptions::tolerance`].
    pub tolerance: f64,
    /// Most rows that centroids are fitted to; a sample is drawn where there are more.
    pub fit_rows: usize,
    /// Seed of all random numbers.
    pub seed: u64,
}

/// Fits a model to rows of `columns` numbers each. Without rows there are no clusters; there are fewer than asked for
/// where there are fewer distinct rows, and a cluster that no row of the sample is in is left out.
///
/// # Errors
/// [`Stopped`] when the watch says so.
///
/// # Panics
/// When the values are not whole rows, or a number of clusters is out of range.
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

/// Shares of the time of a fit at which the number of clusters is found, and at which the centroids are found.
fn parts_of_the_time(options: &FitOptions) -> [f64; 2] {
    /// Time of the search for the number, and that of a mixture, over that of k-means: measured on 360,000 rows of
    /// thirteen features.
    const TIMES_K_MEANS: f64 = 7.0;
    let search = if options.count == CategoryCount::Auto { TIMES_K_MEANS } else { 0.0 };
    let mixture = if options.method == Method::KMeans { 0.0 } else { TIMES_K_MEANS };
    let whole = search + 1.0 + mixture;
    [search / whole, (search + 1.0) / whole]
}

/// Fits a mixture from the best centroids and from those of some single runs of k-means, and keeps the likeliest fit:
/// the best centroids are rarely the best start.
fn fit_mixture(
    points: &Points,
    best: Vec<f32>,
    covariance: Covariance,
    search: &KMeansOptions,
    watch: &Watch<'_>,
) -> Result<mixture::Fitted, Stopped> {
    let starts = (1..MIXTURE_STARTS).into_par_iter().map(|start| {
        // The mixture is refined afterwards, so coarse centroids are enough.
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
