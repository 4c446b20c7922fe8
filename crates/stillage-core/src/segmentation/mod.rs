//! Regions: parts of the map with orientations of their own, in whole tiles. Lines of one region do not cut the others.
//!
//! | method | how |
//! | --- | --- |
//! | energy (default) | each tile takes the pair of directions that its structure is aligned with (`directions`) |
//! | Gabor (the paper, II-D) | a Gabor bank of 5 frequencies and 8 orientations, principal components, k-means (`texture`) |
//! | single | the whole map is one region |
//!
//! Departures of the Gabor method: texture is clustered per tile instead of per pixel (its energy is smoothed over
//! several tiles anyway); regions are contiguous sets of tiles instead of the bounding boxes around them, which would
//! overlap (the box of each is reported); the number of regions need not be given (`patterns`).
//!
//! Cost of the Gabor method: O(40 pixels log pixels) for the transforms at about 0.4 m per pixel, then O(tiles).
//! Limits: its border between two regions is right to about half the smoothing length; at most 255 regions.

use crate::geometry::OrientedBox;
use crate::grid::OccupancyGrid;
use crate::orientation::energy::OccupiedSample;
use crate::orientation::slope;
use crate::orientation::{self, Orientations};
use crate::spec::{AnalysisOptions, RegionMethod};
use crate::watch::{Stopped, Watch};

mod directions;
mod gabor;
mod outline;
mod patterns;
mod region_map;
mod texture;
mod tiles;

#[cfg(test)]
mod tests;

use outline::{Outline, outlines};
pub use region_map::{Region, RegionMap};
use tiles::Tiles;

/// Occupied cells sampled of each region to refine its direction; in the accuracy study more changed nothing.
const SAMPLE_CELLS: usize = 120_000;
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
        RegionMethod::Gabor => texture::by_texture(grid, &tiles, &options.regions, options.seed, watch)?,
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

/// A map of labelled tiles whose regions are not described yet.
fn map_of(tiles: &Tiles, labels: Vec<u8>) -> RegionMap {
    let Tiles { tile_cells, columns, rows, .. } = *tiles;
    RegionMap { tile_cells, columns, rows, tiles: labels, regions: vec![] }
}

fn count_regions(labels: &[u8]) -> usize {
    labels.iter().filter(|&&label| label != RegionMap::NONE).max().map_or(0, |&last| usize::from(last) + 1)
}

/// The map of labelled tiles, with the orientations, box and share of each region.
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
