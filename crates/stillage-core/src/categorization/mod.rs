//! Place categories: features, scaled and clustered (paper, II-A; doi 10.1109/ECMR.2015.7324207).
//!
//! A clustering is fitted to the features of a sample of the measured cells. It gives every measured cell a category,
//! part by part, and memberships where they are asked for; relaxation, an option, brings neighbours to agree. A free
//! cell that is not measured takes the category of the nearest measured one through free space, or through walls where
//! there is no other way. Departure: the paper stops at the clusters; here they are numbered by their mean beam length,
//! from the narrowest places to the widest, so that the same map has the same numbers whatever the seed.
//!
//! Cost: that of the features and of the clustering, and O(cells) for the cells in between. Limits: 32 categories by
//! the checked options, 253 by the type.

mod category_map;
mod parts;
mod spread;

use crate::clustering::{self, FitOptions, Method};
use crate::features::FeatureSource;
use crate::grid::{Occupancy, OccupancyGrid};
use crate::relaxation::{Lattice, Memberships, relax_cells};
use crate::spec::{CategorizationOptions, ClusteringMethod, FeatureProfile};
use crate::vectors::Vectors;
use crate::watch::{Stage, Stopped, Watch};

pub use category_map::{Category, CategoryMap};
pub(crate) use parts::{KEPT_CELLS, sampled_share};
use parts::{PartLabels, Sample, assign_parts};
use spread::spread;

/// Cells that categories are fitted to: the standard error of a centroid is below half a percent of the standard
/// deviation of a feature.
pub(crate) const FIT_CELLS: usize = 200_000;
/// Movement of the centroids below which k-means ends ([`FitOptions::tolerance`]). With a looser one, thousands of
/// cells may change their category with the seed.
const TOLERANCE: f64 = 1e-6;
/// The same in the author's code, which fits to all cells (the default of scikit-learn).
const AUTHORS_TOLERANCE: f64 = 1e-4;

/// The categories of a map, with memberships where they are asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct Categorization {
    /// The category of every cell.
    pub map: CategoryMap,
    /// The distribution of every measured cell over the categories; absent where neither a mixture nor a relaxation is
    /// asked for, so that a cell has its category alone.
    pub memberships: Option<CellMemberships>,
}

/// Distributions of the measured cells over the categories.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CellMemberships {
    /// Number (row-major) of each measured cell, ascending.
    pub cells: Vec<u32>,
    /// Their distributions.
    pub shares: Memberships,
}

/// Measures and clusters the places of a grid and gives every free cell a category.
///
/// There are fewer categories than asked for where there are fewer distinct places, and none without free cells.
///
/// # Errors
/// [`Stopped`] when the watch says so.
pub fn categorize(
    grid: &OccupancyGrid,
    options: &CategorizationOptions,
    seed: u64,
    watch: &Watch<'_>,
) -> Result<Categorization, Stopped> {
    let (source, sample) = watch.stage(Stage::Features, || {
        let cells = grid.count(Occupancy::Free);
        let prepared = FeatureSource::preparation_share(options.profile, sampled_share(cells));
        let source = FeatureSource::new(grid, options, Vectors::widest(), &watch.part(0.0, prepared))?;
        let sample = Sample::measure(&source, cells, seed, &watch.part(prepared, 1.0))?;
        Ok((source, sample))
    })?;
    let columns = source.names().len();
    let (model, fit) = watch
        .stage(Stage::Clustering, || clustering::fit(sample.rows(), columns, &fit_options(options, seed), watch))?;
    watch.stage(Stage::Categorization, || {
        let feature_names = source.names().iter().map(|&name| name.to_owned()).collect();
        let is_graded = options.clustering == ClusteringMethod::GaussianMixture || options.relaxation.is_some();
        let parts = assign_parts(&source, sample, &model, is_graded, watch)?;
        drop(source);
        let mut categories = describe(&parts, model.len(), columns);
        let mut cells = vec![CategoryMap::NONE; grid.cells().len()];
        for (&cell, &label) in parts.iter().flat_map(|part| part.cells.iter().zip(&part.labels)) {
            cells[cell as usize] = label;
        }
        let measured = measured_cells(&cells);
        let mut memberships = is_graded.then(|| CellMemberships::gather(measured.clone(), &parts, model.len()));
        drop(parts);
        let mut relaxation = None;
        if let (Some(wanted), Some(CellMemberships { shares, .. })) = (options.relaxation, &mut memberships) {
            let lattice = Lattice::new(&measured, grid.width(), options.stride);
            relaxation = Some(relax_cells(&lattice, shares, wanted, watch)?);
            for (&cell, label) in measured.iter().zip(shares.categories()) {
                cells[cell as usize] = label;
            }
        }
        spread(grid, &measured, &mut cells, watch)?;
        for &category in cells.iter().filter(|&&category| category != CategoryMap::NONE) {
            categories[usize::from(category)].cells += 1;
        }
        Ok(Categorization { map: CategoryMap { cells, categories, feature_names, fit, relaxation }, memberships })
    })
}

/// The numbers of the cells that have a category, ascending.
fn measured_cells(cells: &[u8]) -> Vec<u32> {
    (0..cells.len()).filter(|&cell| cells[cell] != CategoryMap::NONE).map(|cell| cell as u32).collect()
}

/// The options of the clustering.
fn fit_options(options: &CategorizationOptions, seed: u64) -> FitOptions {
    let (tolerance, fit_rows) = match options.profile {
        FeatureProfile::Paper13 => (TOLERANCE, FIT_CELLS),
        FeatureProfile::Halmstad2017 => (AUTHORS_TOLERANCE, usize::MAX),
    };
    FitOptions {
        method: match options.clustering {
            ClusteringMethod::KMeans => Method::KMeans,
            ClusteringMethod::GaussianMixture => Method::GaussianMixture(options.covariance),
        },
        count: options.k,
        max_count: options.max_k,
        scaling: options.scaling,
        restarts: options.restarts,
        max_iterations: options.max_iterations,
        tolerance,
        fit_rows,
        seed,
    }
}

/// The categories with the means of their features; their cells are not counted yet.
fn describe(parts: &[PartLabels], count: usize, columns: usize) -> Vec<Category> {
    (0..count)
        .map(|category| {
            let cells: usize = parts.iter().map(|part| part.counts[category]).sum();
            let sum = |column| parts.iter().map(|part| part.sums[category * columns + column]).sum::<f64>();
            let mean_features = (0..columns).map(|column| sum(column) / cells.max(1) as f64).collect();
            Category { cells: 0, mean_features }
        })
        .collect()
}

impl CellMemberships {
    /// Puts the memberships of all parts in the order of their cells.
    fn gather(cells: Vec<u32>, parts: &[PartLabels], count: usize) -> Self {
        let mut shares = Memberships::new(cells.len(), count);
        for part in parts {
            // There are no categories without cells.
            let mut of_part = part.shares.chunks_exact(count.max(1));
            // Between neighbours in a row lies no cell of another part, so a run is contiguous.
            for run in part.cells.chunk_by(|one, next| one + 1 == *next) {
                let start = cells.binary_search(&run[0]).expect("every cell of a part was measured");
                for (place, packed) in (start..).zip(of_part.by_ref().take(run.len())) {
                    shares.values_mut()[place * count..][..count].copy_from_slice(packed);
                }
            }
        }
        Self { cells, shares }
    }
}

#[cfg(test)]
mod tests;
