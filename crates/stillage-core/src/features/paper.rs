//! The thirteen features of the paper's Table I, in metres, over closed scans.
//!
//! With beams of length `d_i`, `i` in `0..n` around the circle, and their end points:
//!
//! | feature | definition |
//! | --- | --- |
//! | mean and std of beam length | of `d_i`; the std divides by `n` |
//! | mean and std of differences | of the absolute value of `d_i - d_(i-1)`, the first beam follows the last |
//! | area, perimeter | of the polygon of end points |
//! | compactness | perimeter squared over area |
//! | gaps | how many absolute differences exceed the gap threshold |
//! | kurtosis | `m4 / m2^2 - 3` of `d_i` (0 for a normal distribution); 0 where the std is below 0.01 cells |
//! | PC1, PC2, PC1 / PC2 | square roots of the eigenvalues of the end points' covariance (over `n`) |
//! | offset | distance of the end points' mean from the cell |
//!
//! Departures from the paper: none known; where its table is silent, its author's code and Mozos' definitions decide
//! (wrap-around after Mozos). A feature that is no number (PC2 of points on a line) is 0.
//!
//! Method: the sweep gives the beams of a tile direction by direction; they go into twelve running sums per cell, and
//! are forgotten. Cost: O(cells x beams). Tiles are independent and each writes its own part of the result in a fixed
//! order, so the result does not depend on threads.

use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use super::lanes::LANES;
use super::paper_sums::{BeamTerms, FanTerms, RunningSums, units_of};
use crate::grid::{Occupancy, OccupancyGrid};
use crate::raycast::{BeamOptions, Sweep, Tile, TileScratch, beam_direction};
use crate::spec::CategorizationOptions;
use crate::watch::{Stage, Stopped, Watch};

/// The features, in their order.
pub(super) const NAMES: [&str; 13] = [
    "meanBeamLength",
    "stdBeamLength",
    "meanDifference",
    "stdDifference",
    "area",
    "perimeter",
    "compactness",
    "gaps",
    "kurtosis",
    "pc1",
    "pc2",
    "pcRatio",
    "offset",
];

/// Beams that are cast before they are added up, so that the sums are loaded once for all of them.
const BEAMS_PER_BLOCK: usize = 16;

/// Beams, evenly around, whose mean length is the pivot of the sums.
const PIVOT_BEAMS: usize = 16;

/// Features of the measured cells, one row per cell.
pub(super) fn measure(
    grid: &OccupancyGrid,
    cells: &[u32],
    stride: usize,
    options: &CategorizationOptions,
    watch: &Watch<'_>,
) -> Result<Vec<f32>, Stopped> {
    let sweep = Sweep::new(grid, &BeamOptions::from(options), watch)?;
    let measure = Measure::new(grid, &sweep, options);
    let tile_rows = sweep.tile_rows(stride);
    let tiles: usize = tile_rows.iter().map(Vec::len).sum();
    let done = AtomicUsize::new(0);
    let mut values = vec![0.0; cells.len() * NAMES.len()];
    let strips = strips(grid, &tile_rows, cells, &mut values);
    strips.into_par_iter().zip(&tile_rows).try_for_each(|(strip, tiles_of_strip)| {
        let measured: Result<Vec<TileFeatures>, Stopped> = tiles_of_strip
            .par_iter()
            .map_init(Workspace::default, |workspace, tile| {
                let features = measure.tile(tile, workspace, watch)?;
                let done = done.fetch_add(1, Ordering::Relaxed) + 1;
                watch.progress(Stage::Features, done as f64 / tiles as f64);
                Ok(features)
            })
            .collect();
        join_rows(&measured?, strip);
        Ok(())
    })?;
    Ok(values)
}

/// Cuts the values of all cells into those of each row of tiles.
fn strips<'a>(
    grid: &OccupancyGrid,
    tile_rows: &[Vec<Tile>],
    cells: &[u32],
    mut values: &'a mut [f32],
) -> Vec<&'a mut [f32]> {
    let mut first = 0;
    let mut strips = Vec::with_capacity(tile_rows.len());
    for tiles in tile_rows {
        let end_row = tiles.first().map_or(0, Tile::end_row);
        let end = cells.partition_point(|&cell| (cell as usize) < end_row * grid.width());
        let (strip, rest) = values.split_at_mut((end - first) * NAMES.len());
        strips.push(strip);
        values = rest;
        first = end;
    }
    strips
}

/// The features of the measured cells of a tile, row by row.
struct TileFeatures {
    values: Vec<f32>,
    /// Where each measured row of the tile ends among the values.
    row_ends: Vec<usize>,
}

/// Joins the rows of tiles that lie side by side.
fn join_rows(tiles: &[TileFeatures], mut strip: &mut [f32]) {
    let rows = tiles.first().map_or(0, |tile| tile.row_ends.len());
    for row in 0..rows {
        for tile in tiles {
            let start = if row == 0 { 0 } else { tile.row_ends[row - 1] };
            let values = &tile.values[start..tile.row_ends[row]];
            let (part, rest) = strip.split_at_mut(values.len());
            part.copy_from_slice(values);
            strip = rest;
        }
    }
}

/// Memory of one task, reused from tile to tile.
#[derive(Default)]
struct Workspace {
    sweep: TileScratch,
    planes: Vec<Vec<u16>>,
    sums: Vec<RunningSums>,
}

/// What the work on every tile shares.
struct Measure<'a> {
    grid: &'a OccupancyGrid,
    sweep: &'a Sweep,
    beams: Vec<BeamTerms>,
    fan: FanTerms,
}

impl<'a> Measure<'a> {
    fn new(grid: &'a OccupancyGrid, sweep: &'a Sweep, options: &CategorizationOptions) -> Self {
        let count = options.beams;
        let beams = (0..count)
            .map(|beam| {
                let (once, twice) = (beam_direction(beam, count), beam_direction(2 * beam, count));
                BeamTerms {
                    unit: sweep.unit(beam),
                    cos: once.x as f32,
                    sin: once.y as f32,
                    cos_twice: twice.x as f32,
                    sin_twice: twice.y as f32,
                }
            })
            .collect();
        let fan = FanTerms {
            beams: count,
            limit: sweep.limit(),
            gap: (options.gap_m / grid.resolution()) as f32,
            chord_factor: (2.0 * (1.0 - beam_direction(1, count).x)) as f32,
        };
        Self { grid, sweep, beams, fan }
    }

    /// The features of one tile.
    fn tile(&self, tile: &Tile, workspace: &mut Workspace, watch: &Watch<'_>) -> Result<TileFeatures, Stopped> {
        let groups = self.groups_with_free_cells(tile);
        if groups.is_empty() {
            return Ok(TileFeatures { values: Vec::new(), row_ends: vec![0; tile.measured_rows().len()] });
        }
        let Workspace { sweep: scratch, planes, sums } = workspace;
        planes.resize_with(BEAMS_PER_BLOCK, Vec::new);
        planes.iter_mut().for_each(|plane| plane.resize(tile.plane_length(), 0));
        sums.clear();
        sums.resize(groups.len(), RunningSums::default());
        self.begin(tile, &groups, scratch, &mut planes[0], sums);
        for (block, terms) in self.beams.chunks(BEAMS_PER_BLOCK).enumerate() {
            watch.check()?;
            for (index, plane) in planes.iter_mut().enumerate().take(terms.len()) {
                self.sweep.cast(tile, block * BEAMS_PER_BLOCK + index, scratch, plane);
            }
            for (sums, &group) in sums.iter_mut().zip(&groups) {
                sums.add(terms, planes, group, &self.fan);
            }
        }
        Ok(self.finish(tile, &groups, sums))
    }

    /// Where, in a plane, the groups of neighbouring cells begin of which at least one is free.
    fn groups_with_free_cells(&self, tile: &Tile) -> Vec<usize> {
        let pitch = tile.pitch();
        let mut groups: Vec<usize> = Vec::new();
        for (row_index, row) in tile.measured_rows().enumerate() {
            for (index, column) in tile.measured_columns().enumerate() {
                let group = row_index * pitch + index / LANES * LANES;
                if self.grid.row(row)[column] == Occupancy::Free && groups.last() != Some(&group) {
                    groups.push(group);
                }
            }
        }
        groups
    }

    /// Sets the pivots, and the beam before the first.
    fn begin(
        &self,
        tile: &Tile,
        groups: &[usize],
        scratch: &mut TileScratch,
        plane: &mut [u16],
        sums: &mut [RunningSums],
    ) {
        let count = self.fan.beams;
        let pivots = PIVOT_BEAMS.min(count);
        for pivot in 0..pivots {
            let beam = pivot * count / pivots;
            self.sweep.cast(tile, beam, scratch, plane);
            for (sums, &group) in sums.iter_mut().zip(groups) {
                sums.add_to_pivot(units_of(plane, group), &self.beams[beam], &self.fan, pivots);
            }
        }
        self.sweep.cast(tile, count - 1, scratch, plane);
        for (sums, &group) in sums.iter_mut().zip(groups) {
            sums.begin_after(units_of(plane, group), &self.beams[count - 1], &self.fan);
        }
    }

    /// From sums to features, for the free cells only.
    fn finish(&self, tile: &Tile, groups: &[usize], sums: &[RunningSums]) -> TileFeatures {
        let pitch = tile.pitch();
        let columns: Vec<usize> = tile.measured_columns().collect();
        let mut features = TileFeatures { values: Vec::new(), row_ends: Vec::new() };
        let mut groups = groups.iter().zip(sums).peekable();
        for (row_index, row) in tile.measured_rows().enumerate() {
            while let Some((group, sums)) = groups.next_if(|(group, _)| **group / pitch == row_index) {
                for (lane, &column) in columns.iter().skip(group % pitch).take(LANES).enumerate() {
                    if self.grid.row(row)[column] == Occupancy::Free {
                        let cell = sums.of_lane(lane).features(self.fan.beams, self.grid.resolution());
                        features.values.extend_from_slice(&cell);
                    }
                }
            }
            features.row_ends.push(features.values.len());
        }
        features
    }
}
