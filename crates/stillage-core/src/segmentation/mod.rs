//! Regions: blocks of the map with a pattern of their own, found by direction ([`directions`]) or by Gabor texture.
//!
//! Source: the paper, II-D: a Gabor bank of 5 frequencies and 8 orientations (`gabor`), principal components,
//! k-means. Lines of one region then do not cut the others.
//!
//! Departures of the texture method: texture is clustered per tile instead of per pixel (its energy is smoothed over several tiles anyway);
//! regions are contiguous sets of tiles instead of the bounding boxes around them, which would overlap (the box of
//! each is reported); and the number of regions need not be given (`patterns`).
//!
//! Cost: the transforms, O(40 pixels log pixels) at about 0.4 m per pixel, then O(tiles). Limits: a border between two
//! regions is found to about half the smoothing length; at most 255 regions.

use serde::{Deserialize, Serialize};

use crate::clustering::{KMeansOptions, k_means};
use crate::geometry::{OrientedBox, Point};
use crate::grid::{Occupancy, OccupancyGrid};
use crate::linalg::PrincipalComponents;
use crate::orientation::energy::OccupiedSample;
use crate::orientation::slope;
use crate::orientation::{self, Orientations};
use crate::spec::{AnalysisOptions, RegionMethod, RegionOptions};
use crate::watch::{Stopped, Watch};

mod directions;
mod fourier;
mod gabor;
mod patterns;
mod tiles;

#[cfg(test)]
mod tests;

use patterns::Division;
use tiles::Tiles;

/// Cells of each region whose energy refines its direction (accuracy study: more change nothing).
const SAMPLE_CELLS: usize = 120_000;
/// Share of the variance that the principal components keep, and most of them.
const KEPT_VARIANCE: f64 = 0.95;
const MOST_COMPONENTS: usize = 8;
/// Runs of k-means and their length. Some thousand tiles of eight numbers: cheap.
const RESTARTS: usize = 8;
const MAX_ITERATIONS: usize = 100;
/// Centroids of a few hundred tiles settle fast; this is far below any tile's distance to its neighbours.
const TOLERANCE: f64 = 1e-6;

/// A partition of the known part of the map into regions, in whole tiles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RegionMap {
    /// Side of a tile, cells.
    pub tile_cells: usize,
    /// Tile columns; tile (0, 0) starts at cell (0, 0).
    pub columns: usize,
    /// Tile rows.
    pub rows: usize,
    /// Region of each tile, row-major, lowest row first; [`RegionMap::NONE`] outside the known part of the map.
    pub tiles: Vec<u8>,
    /// The regions, by id.
    pub regions: Vec<Region>,
}

/// A block of the map with a pattern of its own.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Region {
    /// Dominant orientations of this region, radians in `[-pi/2, pi/2)`, ascending.
    pub orientations: Vec<f64>,
    /// Box along the first orientation around the region's known cells.
    pub bounds: OrientedBox,
    /// Share of the known cells.
    pub share: f64,
}

impl RegionMap {
    /// No region: outside the known part of the map.
    pub const NONE: u8 = u8::MAX;

    /// Region of a cell, by column and row.
    #[must_use]
    pub fn region_of_cell(&self, column: usize, row: usize) -> Option<u8> {
        let tile = (row / self.tile_cells) * self.columns + column / self.tile_cells;
        self.tiles.get(tile).copied().filter(|&region| region != Self::NONE)
    }
}

/// Finds the regions of a grid. A grid without known cells has no region.
///
/// # Errors
/// [`Stopped`] when the watch says so.
pub fn segment(
    grid: &OccupancyGrid,
    global: &Orientations,
    options: &AnalysisOptions,
    watch: &Watch<'_>,
) -> Result<RegionMap, Stopped> {
    let tiles = Tiles::new(grid, options.regions.tile_m);
    let labels = match options.regions.method {
        RegionMethod::Single => tiles.uniform(),
        RegionMethod::Energy => return by_energy(grid, &tiles, global, options, watch),
        RegionMethod::Gabor => by_texture(grid, &tiles, &options.regions, options.seed, watch)?,
    };
    describe(grid, &tiles, labels, global, options, watch)
}

/// Regions by the direction of their structure.
fn by_energy(
    grid: &OccupancyGrid,
    tiles: &Tiles,
    global: &Orientations,
    options: &AnalysisOptions,
    watch: &Watch<'_>,
) -> Result<RegionMap, Stopped> {
    let found = directions::by_direction(grid, tiles, global, &options.regions, watch)?;
    let mut map = map_of(tiles, found.labels);
    let count = count_regions(&map.tiles);
    let region_of = |column: usize, row: usize| map.region_of_cell(column, row).map(usize::from);
    let samples = OccupiedSample::of_parts(grid, count, region_of, SAMPLE_CELLS, watch)?;
    let mut orientations = Vec::with_capacity(count);
    for (region, sample) in samples.iter().enumerate() {
        orientations.push(match found.pairs.get(region) {
            Some(&pair) => directions::both(slope::fit(sample, sample.refine_pair(pair, watch)?, true, watch)?),
            None => global.angles.clone(),
        });
    }
    map.regions = regions_with(grid, tiles, &map, orientations, watch)?;
    Ok(map)
}

fn map_of(tiles: &Tiles, labels: Vec<u8>) -> RegionMap {
    let Tiles { tile_cells, columns, rows, .. } = *tiles;
    RegionMap { tile_cells, columns, rows, tiles: labels, regions: vec![] }
}

fn count_regions(labels: &[u8]) -> usize {
    labels.iter().filter(|&&label| label != RegionMap::NONE).max().map_or(0, |&last| usize::from(last) + 1)
}

/// Region of each tile.
fn by_texture(
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
        return Ok(tiles.settle(&clusters, options.min_share, false));
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
    Ok(several.map_or_else(|| tiles.uniform(), |division| tiles.settle(&division.labels, options.min_share, true)))
}

/// The texture of the tiles that have one, in few dimensions.
struct KnownTiles {
    points: Vec<f32>,
    dimensions: usize,
}

impl KnownTiles {
    /// Columns of unit variance, then principal components.
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

    /// Cluster of every tile, [`RegionMap::NONE`] where nothing is known.
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
        let mut clusters = vec![RegionMap::NONE; tiles.known.len()];
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

/// Orientations, box and share of each region.
fn describe(
    grid: &OccupancyGrid,
    tiles: &Tiles,
    labels: Vec<u8>,
    global: &Orientations,
    options: &AnalysisOptions,
    watch: &Watch<'_>,
) -> Result<RegionMap, Stopped> {
    let mut map = map_of(tiles, labels);
    let count = count_regions(&map.tiles);
    let mut own = vec![Orientations::default(); count];
    if count > 1 {
        let region_of = |column: usize, row: usize| map.region_of_cell(column, row).map(usize::from);
        own = orientation::orientations_of_parts(grid, count, region_of, &options.orientation, watch)?;
    }
    let or_global = |own: Orientations| if own.angles.is_empty() { global.angles.clone() } else { own.angles };
    map.regions = regions_with(grid, tiles, &map, own.into_iter().map(or_global).collect(), watch)?;
    Ok(map)
}

/// The regions of a map with their orientations.
fn regions_with(
    grid: &OccupancyGrid,
    tiles: &Tiles,
    map: &RegionMap,
    orientations: Vec<Vec<f64>>,
    watch: &Watch<'_>,
) -> Result<Vec<Region>, Stopped> {
    let outlines = outlines(grid, map, orientations.len(), watch)?;
    let total: u64 = tiles.known.iter().map(|&known| u64::from(known)).sum();
    let region = |(outline, orientations): (Outline, Vec<f64>)| {
        let angle = orientations.first().copied().unwrap_or(0.0);
        let bounds = OrientedBox::around(outline.corners, angle).expect("a region has known cells");
        Region { orientations, bounds, share: outline.known as f64 / total as f64 }
    };
    Ok(outlines.into_iter().zip(orientations).map(region).collect())
}

/// The known cells of a region: how many, and points whose convex hull is theirs.
#[derive(Clone, Default)]
struct Outline {
    known: u64,
    corners: Vec<Point>,
}

fn outlines(grid: &OccupancyGrid, map: &RegionMap, count: usize, watch: &Watch<'_>) -> Result<Vec<Outline>, Stopped> {
    let mut outlines = vec![Outline::default(); count];
    let resolution = grid.resolution();
    for row in 0..grid.height() {
        watch.check()?;
        let mut spans: Vec<Option<(usize, usize)>> = vec![None; count];
        let labels = &map.tiles[row / map.tile_cells * map.columns..][..map.columns];
        for (tile, (cells, &label)) in grid.row(row).chunks(map.tile_cells).zip(labels).enumerate() {
            let is_known = |cell: &Occupancy| *cell != Occupancy::Unknown;
            let (Some(first), Some(last)) = (cells.iter().position(is_known), cells.iter().rposition(is_known)) else {
                continue;
            };
            let region = usize::from(label);
            outlines[region].known += cells.iter().filter(|cell| is_known(cell)).count() as u64;
            let start = tile * map.tile_cells;
            let span = spans[region].get_or_insert((start + first, start + last));
            span.1 = start + last;
        }
        for (outline, span) in outlines.iter_mut().zip(spans) {
            let Some((first, last)) = span else { continue };
            for (column, row) in [(first, row), (last + 1, row), (first, row + 1), (last + 1, row + 1)] {
                outline.corners.push(Point::new(column as f64, row as f64) * resolution);
            }
        }
    }
    Ok(outlines)
}
