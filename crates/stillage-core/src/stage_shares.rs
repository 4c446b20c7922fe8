//! The share of each stage in the time of an analysis, estimated before the first stage.
//!
//! No fixed shares fit all maps: beams take a third of the time of a small map and two thirds of that of a site of the
//! paper's size, and options change it as much. So the time of each stage is estimated from the cells of the map and
//! the options, by the measured rates below. The tests compare the estimate with measured runs.
//!
//! Rates are nanoseconds on two threads of an AMD EPYC with AVX-512, fitted on 2026-11-28 to the runs in the tests;
//! only their ratios matter. Limits: the content of a map counts as well (rows, directions, iterations of k-means), so
//! a stage of a small map may take twice its estimate; with very many lines of the paper's method the arrangement takes
//! longest.

use crate::categorization::{FIT_CELLS, KEPT_CELLS, sampled_share};
use crate::grid::{Occupancy, OccupancyGrid};
use crate::orientation::energy;
use crate::spec::{
    AnalysisOptions, CategorizationOptions, CategoryCount, ClusteringMethod, DeclutterMethod, DecompositionMethod,
    FeatureProfile, OrientationMethod, RegionMethod,
};
use crate::watch::Stage;

pub use crate::watch::StageShares;

// Passes over the whole grid, for each cell, ns.
const DECLUTTER: f64 = 10.0;
const ORIENTATION_ENERGY: f64 = 15.0;
const ORIENTATION_PAPER: f64 = 15.0;
const REGIONS_ENERGY: f64 = 12.0;
const REGIONS_GABOR: f64 = 110.0;
const RADIOGRAPHY: f64 = 2.0;
const ROOMS: f64 = 42.0;
const ROWS: f64 = 108.0;
const SITE_PLAN: f64 = 30.0;
const ARRANGEMENT: f64 = 8.0;
const ANNOTATION: f64 = 8.0;

/// First sweep of `paper13` at 360 beams, for each cell of the grid, ns.
const FIRST_SWEEP: f64 = 36.0;
/// Sweeps of the tiles of `paper13` at 360 beams, for each cell of the grid, ns.
const TILE_SWEEPS: f64 = 170.0;
/// Sums of the features of `paper13` at 360 beams, for each measured cell, ns.
const FEATURE_SUMS: f64 = 145.0;
/// Beams and features of `halmstad2017` at 360 beams, for each measured cell, ns.
const HALMSTAD: f64 = 26_000.0;
/// Labelling and storing a measured cell, ns.
const LABEL: f64 = 20.0;
/// One iteration of the relaxation of a cell, for each category, ns.
const RELAXATION: f64 = 8.0;

/// All iterations of one restart of k-means, for each row and category, ns.
const RESTART: f64 = 31.0;
/// Last run of k-means on the whole sample, for each row and category, ns.
const LAST_RUN: f64 = 60.0;
/// One restart of `halmstad2017`, for each row and category, ns: its tolerance is in effect finer and its rows are
/// longer.
const HALMSTAD_RESTART: f64 = 90.0;
/// Rows on which restarts are compared, as a share of the fitted ones.
const COMPARISON: f64 = 0.1;
/// Time of the search for the number of clusters, and that of a mixture, over that of k-means.
const SEARCH: f64 = 7.0;

/// Radiogram energy, for each occupied cell of the sample, ns.
const ORIENTATION_SAMPLE: f64 = 1_000.0;

/// How many cells a map has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CellCounts {
    /// Cells of the grid.
    pub cells: usize,
    /// Free cells.
    pub free: usize,
    /// Occupied cells.
    pub occupied: usize,
}

impl CellCounts {
    /// Counts the cells of a grid.
    #[must_use]
    pub fn of(grid: &OccupancyGrid) -> Self {
        let count = |occupancy| grid.count(occupancy);
        Self { cells: grid.cells().len(), free: count(Occupancy::Free), occupied: count(Occupancy::Occupied) }
    }
}

impl StageShares {
    /// Estimates the shares for a map and options.
    #[must_use]
    pub fn estimate(counts: &CellCounts, options: &AnalysisOptions) -> Self {
        Self::of_times(Stage::ALL.map(|stage| nanoseconds(stage, counts, options)))
    }
}

/// Estimated time of a stage.
fn nanoseconds(stage: Stage, counts: &CellCounts, options: &AnalysisOptions) -> f64 {
    let cells = counts.cells as f64;
    let sample = counts.occupied.min(energy::SAMPLE_CELLS) as f64;
    let categorization = &options.categorization;
    let only_adaptive = |rate: f64| match options.decomposition.method {
        DecompositionMethod::Adaptive => rate * cells,
        DecompositionMethod::Paper => 0.0,
    };
    match stage {
        Stage::Declutter if options.declutter.method == DeclutterMethod::None => 0.0,
        Stage::Declutter => DECLUTTER * cells,
        Stage::Features => features(counts, categorization)[0],
        Stage::Clustering => clustering(counts, categorization),
        Stage::Categorization => features(counts, categorization)[1] + labels(counts, categorization),
        Stage::Orientation => match options.orientation.method {
            OrientationMethod::Energy => ORIENTATION_ENERGY * cells + ORIENTATION_SAMPLE * sample,
            OrientationMethod::Paper => ORIENTATION_PAPER * cells,
        },
        Stage::Regions => match options.regions.method {
            RegionMethod::Energy => REGIONS_ENERGY * cells,
            RegionMethod::Gabor => REGIONS_GABOR * cells,
            RegionMethod::Single => 0.0,
        },
        Stage::Radiography => RADIOGRAPHY * cells,
        Stage::Rooms => only_adaptive(ROOMS),
        Stage::Rows => only_adaptive(ROWS),
        Stage::SitePlan => only_adaptive(SITE_PLAN),
        Stage::Arrangement => ARRANGEMENT * cells,
        Stage::Annotation => ANNOTATION * cells,
    }
}

/// Number of measured cells.
fn measured(counts: &CellCounts, options: &CategorizationOptions) -> f64 {
    counts.free as f64 / (options.stride * options.stride) as f64
}

/// Time of the features of the sample, and of those of the other cells, ns.
fn features(counts: &CellCounts, options: &CategorizationOptions) -> [f64; 2] {
    let beams = options.beams as f64 / 360.0;
    let (cells, measured) = (counts.cells as f64, measured(counts, options));
    let (once, all) = match options.profile {
        FeatureProfile::Paper13 => (FIRST_SWEEP * cells, TILE_SWEEPS * cells + FEATURE_SUMS * measured),
        FeatureProfile::Halmstad2017 => (0.0, HALMSTAD * measured),
    };
    let sampled = sampled_share(counts.free);
    [beams * (once + sampled * all), beams * (1.0 - sampled) * all]
}

fn clustering(counts: &CellCounts, options: &CategorizationOptions) -> f64 {
    let kept = measured(counts, options).min(KEPT_CELLS as f64);
    let fitted = kept.min(FIT_CELLS as f64);
    let (k, restarts) = (clusters(options) as f64, options.restarts as f64);
    let k_means = match options.profile {
        FeatureProfile::Halmstad2017 => HALMSTAD_RESTART * k * restarts * kept,
        FeatureProfile::Paper13 => {
            let compared = fitted.min(COMPARISON * FIT_CELLS as f64);
            k * (RESTART * restarts * compared + LAST_RUN * fitted)
        }
    };
    let search = if options.k == CategoryCount::Auto { SEARCH } else { 0.0 };
    let mixture = if options.clustering == ClusteringMethod::GaussianMixture { SEARCH } else { 0.0 };
    k_means * (search + 1.0 + mixture)
}

fn labels(counts: &CellCounts, options: &CategorizationOptions) -> f64 {
    let iterations = options.relaxation.map_or(0.0, |relaxation| relaxation.iterations as f64);
    measured(counts, options) * (LABEL + RELAXATION * iterations * clusters(options) as f64)
}

/// The number of categories, or the middle of the range that is searched.
fn clusters(options: &CategorizationOptions) -> usize {
    match options.k {
        CategoryCount::Fixed(count) => count,
        CategoryCount::Auto => (2 + options.max_k).div_ceil(2),
    }
}

#[cfg(test)]
mod tests;
