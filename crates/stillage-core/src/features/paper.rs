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
        for plane in planes.iter_mut() {
            plane.resize(tile.plane_length(), 0);
        }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::features::{CellFeatures, extract};
    use crate::test_maps::real_maps;
    use proptest::prelude::*;

    fn features(grid: &OccupancyGrid, options: &CategorizationOptions) -> CellFeatures {
        extract(grid, options, &Watch::unwatched()).expect("nobody stops it")
    }

    /// The lengths (cells) of all beams of all measured cells of a tile, by row, column and beam.
    fn beams_of_tile(sweep: &Sweep, tile: &Tile, beams: usize) -> Vec<((usize, usize), Vec<f64>)> {
        let (mut scratch, mut plane) = (TileScratch::default(), vec![0; tile.plane_length()]);
        let mut cells: Vec<((usize, usize), Vec<f64>)> = tile
            .measured_rows()
            .flat_map(|row| tile.measured_columns().map(move |column| ((column, row), Vec::new())))
            .collect();
        for beam in 0..beams {
            sweep.cast(tile, beam, &mut scratch, &mut plane);
            let columns = tile.measured_columns().len();
            for (index, (_, lengths)) in cells.iter_mut().enumerate() {
                let units = plane[index / columns * tile.pitch() + index % columns];
                lengths.push(f64::from((f32::from(units) * sweep.unit(beam)).min(sweep.limit())));
            }
        }
        cells
    }

    /// The features by their definitions, in double precision.
    fn by_definition(lengths: &[f64], gap: f64, resolution: f64) -> [f64; 13] {
        let count = lengths.len();
        let mean_of = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        let moment = |values: &[f64], power: i32| {
            let mean = mean_of(values);
            mean_of(&values.iter().map(|value| (value - mean).powi(power)).collect::<Vec<f64>>())
        };
        let around = |index: usize| (index + 1) % count;
        let changes: Vec<f64> = (0..count).map(|index| (lengths[around(index)] - lengths[index]).abs()).collect();
        let points: Vec<_> =
            lengths.iter().enumerate().map(|(beam, length)| beam_direction(beam, count) * *length).collect();
        let area: f64 = (0..count).map(|index| points[index].perp(&points[around(index)]) / 2.0).sum();
        let perimeter: f64 = (0..count).map(|index| (points[index] - points[around(index)]).norm()).sum();
        let center = points.iter().sum::<crate::Vector>() / count as f64;
        let covariance =
            points.iter().map(|point| (point - center) * (point - center).transpose()).sum::<nalgebra::Matrix2<f64>>()
                / count as f64;
        let mut spreads = covariance.symmetric_eigenvalues().map(|value| value.max(0.0).sqrt());
        spreads.as_mut_slice().sort_by(f64::total_cmp);
        let variance = moment(lengths, 2);
        let kurtosis = if variance < 1e-4 { 0.0 } else { moment(lengths, 4) / variance.powi(2) - 3.0 };
        [
            mean_of(lengths) * resolution,
            variance.sqrt() * resolution,
            mean_of(&changes) * resolution,
            moment(&changes, 2).sqrt() * resolution,
            area * resolution * resolution,
            perimeter * resolution,
            perimeter * perimeter / area,
            changes.iter().filter(|&&change| change > gap).count() as f64,
            kurtosis,
            spreads[1] * resolution,
            spreads[0] * resolution,
            spreads[1] / spreads[0],
            center.norm() * resolution,
        ]
    }

    /// Compares all features of a grid with their definitions; gives the largest relative difference of each.
    fn worst_differences(grid: &OccupancyGrid, options: &CategorizationOptions) -> [f64; 13] {
        let found = features(grid, options);
        let sweep = Sweep::new(grid, &BeamOptions::from(options), &Watch::unwatched()).expect("nobody stops it");
        let gap = f64::from((options.gap_m / grid.resolution()) as f32);
        let mut worst = [0.0_f64; 13];
        for tile in sweep.tile_rows(options.stride).iter().flatten() {
            for ((column, row), lengths) in beams_of_tile(&sweep, tile, options.beams) {
                let cell = (row * grid.width() + column) as u32;
                let Ok(index) = found.cells.binary_search(&cell) else { continue };
                let values = &found.values[index * 13..(index + 1) * 13];
                let expected = by_definition(&lengths, gap, grid.resolution());
                for ((worst, &value), expected) in worst.iter_mut().zip(values).zip(expected) {
                    // What is small beside a cell may be any share off.
                    let scale = expected.abs().max(grid.resolution());
                    *worst = worst.max((f64::from(value) - expected).abs() / scale);
                }
            }
        }
        worst
    }

    #[test]
    fn running_sums_give_the_defined_features_of_a_real_map() {
        let Some(path) = real_maps::find("dev/office__rmf_office_scan/map.png") else { return };
        let grid = real_maps::Picture::read(&path).grid(0.05, 89, 230);
        let options = CategorizationOptions { stride: 5, ..CategorizationOptions::default() };
        let worst = worst_differences(&grid, &options);
        println!("largest relative differences: {worst:?}");
        assert!(worst.iter().all(|&difference| difference < 1e-3), "{worst:?}");
    }

    #[test]
    fn the_middle_of_a_square_room_has_the_features_of_a_square() {
        // 41 x 41 cells of 0.1 m: half a side is 2.05 m.
        let grid = OccupancyGrid::from_ascii(&vec![".".repeat(41); 41].join("\n"), 0.1);
        let options = CategorizationOptions { stride: 20, ..CategorizationOptions::default() };
        let found = features(&grid, &options);
        assert_eq!(found.cells.len(), 9);
        let middle = &found.values[4 * 13..5 * 13];
        let near = |index: usize, expected: f32, tolerance: f32| {
            assert!((middle[index] - expected).abs() <= tolerance, "{} is {}", NAMES[index], middle[index]);
        };
        // The mean of 1 / cos over an eighth of a turn is 4 / pi ln(1 + sqrt 2).
        near(0, 2.05 * 1.1222, 0.01);
        near(4, 16.81, 0.2);
        near(5, 16.4, 0.4);
        near(6, 16.0, 0.6);
        near(7, 0.0, 0.0);
        near(11, 1.0, 0.01);
        near(12, 0.0, 0.01);
    }

    #[test]
    fn a_range_limit_makes_open_places_round() {
        let grid = OccupancyGrid::from_ascii(&vec![".".repeat(41); 41].join("\n"), 0.1);
        let options = CategorizationOptions { stride: 20, max_range_m: Some(1.5), ..CategorizationOptions::default() };
        let found = features(&grid, &options);
        let middle = &found.values[4 * 13..5 * 13];
        assert_eq!((middle[0], middle[1], middle[7], middle[8]), (1.5, 0.0, 0.0, 0.0));
    }

    #[test]
    fn the_features_of_a_cell_do_not_depend_on_the_stride() {
        let grid = OccupancyGrid::from_ascii(&vec!["...#....".repeat(20); 140].join("\n"), 0.1);
        let all = features(&grid, &CategorizationOptions::default());
        for stride in [2, 3, 50, 64] {
            let some = features(&grid, &CategorizationOptions { stride, ..CategorizationOptions::default() });
            assert!(!some.cells.is_empty());
            for (index, cell) in some.cells.iter().enumerate() {
                let same = all.cells.binary_search(cell).expect("every free cell is among all cells");
                assert_eq!(some.values[index * 13..][..13], all.values[same * 13..][..13]);
            }
        }
    }

    #[test]
    fn any_number_of_threads_gives_the_same_bytes() {
        let grid = OccupancyGrid::from_ascii(&vec!["...#......##.".repeat(23); 270].join("\n"), 0.05);
        let options = CategorizationOptions { beams: 45, ..CategorizationOptions::default() };
        let bytes = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads can be had");
            let found = pool.install(|| features(&grid, &options));
            found.values.iter().map(|value| value.to_bits()).collect::<Vec<u32>>()
        };
        let one = bytes(1);
        assert!(one == bytes(2) && one == bytes(7));
    }

    #[test]
    fn a_raised_flag_stops_the_work() {
        struct Nobody;
        impl crate::watch::Observer for Nobody {
            fn progress(&self, _: Stage, _: f64) {}
        }
        let stop = crate::StopFlag::default();
        stop.raise();
        let grid = OccupancyGrid::from_ascii("...", 0.1);
        let stopped = extract(&grid, &CategorizationOptions::default(), &Watch::new(&stop, &Nobody));
        assert_eq!(stopped, Err(Stopped));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]

        #[test]
        fn running_sums_give_the_defined_features_of_random_maps(
            rows in proptest::collection::vec("[.]{4,20}[.#]{0,10}", 1..40),
            beams in 8_usize..80,
            range in proptest::option::of(0.2..5.0),
        ) {
            let grid = OccupancyGrid::from_ascii(&rows.join("\n"), 0.1);
            let options = CategorizationOptions { beams, max_range_m: range, ..CategorizationOptions::default() };
            let worst = worst_differences(&grid, &options);
            prop_assert!(worst.iter().all(|&difference| difference < 1e-3), "{worst:?}");
        }
    }
}
