//! Regions by Gabor texture (the paper's way): texture of tiles, principal components, k-means, patterns.
//!
//! Cost: that of [`gabor`] and, for each number of clusters, of k-means and of [`patterns`].

use super::gabor;
use super::patterns::{self, Division};
use super::tiles::{NONE, Tiles};
use crate::clustering::{KMeansOptions, k_means};
use crate::grid::{Occupancy, OccupancyGrid};
use crate::linalg::PrincipalComponents;
use crate::orientation::energy::OccupiedSample;
use crate::spec::RegionOptions;
use crate::watch::{Stopped, Watch};

/// Share of the variance that the kept principal components hold.
const KEPT_VARIANCE: f64 = 0.95;
/// Most principal components that are kept.
const MOST_COMPONENTS: usize = 8;
/// Runs of k-means; some thousand tiles of eight numbers are cheap.
const RESTARTS: usize = 8;
/// Most iterations of a run of k-means.
const MAX_ITERATIONS: usize = 100;
/// Movement of the centroids below which a run ends, as a share of the mean variance ([`KMeansOptions::tolerance`]):
/// far below the distance between any two tiles.
const TOLERANCE: f64 = 1e-6;

/// The region of each tile.
pub(super) fn by_texture(
    grid: &OccupancyGrid,
    tiles: &Tiles,
    options: &RegionOptions,
    seed: u64,
    watch: &Watch<'_>,
) -> Result<Vec<u8>, Stopped> {
    let most = options.count.unwrap_or(options.max_count).min(tiles.known_tiles().count());
    if most < 2 || grid.count(Occupancy::Occupied) == 0 {
        return Ok(tiles.uniform());
    }
    let texture = gabor::texture(grid, tiles, options, watch)?;
    let points = KnownTiles::new(tiles, &texture);
    watch.check()?;
    if options.count.is_some() {
        let clusters = tiles.majority(&points.clusters(tiles, most, seed, watch)?);
        return Ok(tiles.absorb_small_pieces(&clusters, options.min_share, false));
    }
    let sample = OccupiedSample::of_parts(grid, 1, |_, _| Some(0), patterns::SAMPLE_CELLS, watch)?.swap_remove(0);
    let mut best: Option<Division> = None;
    for count in 2..=most {
        watch.check()?;
        let clusters = tiles.majority(&points.clusters(tiles, count, seed, watch)?);
        let division = patterns::divide(tiles, &clusters, count, &sample, watch)?;
        let is_better = |best: &Division| {
            (division.count, division.sharpness).partial_cmp(&(best.count, best.sharpness))
                == Some(std::cmp::Ordering::Greater)
        };
        if best.as_ref().is_none_or(is_better) {
            best = Some(division);
        }
    }
    let several = best.filter(|division| division.count > 1);
    Ok(several.map_or_else(
        || tiles.uniform(),
        |division| tiles.absorb_small_pieces(&division.labels, options.min_share, true),
    ))
}

/// The texture of the tiles with known cells, in few dimensions.
struct KnownTiles {
    points: Vec<f32>,
    dimensions: usize,
}

impl KnownTiles {
    /// Scales the channels to unit variance and keeps the first principal components.
    fn new(tiles: &Tiles, texture: &[f32]) -> Self {
        let mut points: Vec<f32> = tiles
            .known_tiles()
            .flat_map(|tile| &texture[tile * gabor::CHANNELS..(tile + 1) * gabor::CHANNELS])
            .copied()
            .collect();
        scale_columns(&mut points, gabor::CHANNELS);
        let components = PrincipalComponents::fit(&points, gabor::CHANNELS).keep(KEPT_VARIANCE, MOST_COMPONENTS);
        Self { points: components.project(&points), dimensions: components.axes().len() }
    }

    /// Cluster of every tile, [`NONE`] for tiles without known cells.
    fn clusters(&self, tiles: &Tiles, count: usize, seed: u64, watch: &Watch<'_>) -> Result<Vec<u8>, Stopped> {
        let options = KMeansOptions {
            k: count,
            restarts: RESTARTS,
            max_iterations: MAX_ITERATIONS,
            tolerance: TOLERANCE,
            fit_rows: usize::MAX,
            seed,
        };
        let labels = k_means(&self.points, self.dimensions, &options, watch)?;
        let mut clusters = vec![NONE; tiles.known.len()];
        for (tile, label) in tiles.known_tiles().zip(labels) {
            clusters[tile] = label;
        }
        Ok(clusters)
    }
}

/// Zero mean and unit variance for each column; constant columns become zero.
fn scale_columns(points: &mut [f32], dimensions: usize) {
    let count = (points.len() / dimensions).max(1) as f64;
    for column in 0..dimensions {
        let values = || points.iter().skip(column).step_by(dimensions).map(|&value| f64::from(value));
        let mean = values().sum::<f64>() / count;
        let deviation = (values().map(|value| (value - mean).powi(2)).sum::<f64>() / count).sqrt();
        let scale = if deviation > 0.0 { 1.0 / deviation } else { 0.0 };
        for value in points.iter_mut().skip(column).step_by(dimensions) {
            *value = ((f64::from(*value) - mean) * scale) as f32;
        }
    }
}
