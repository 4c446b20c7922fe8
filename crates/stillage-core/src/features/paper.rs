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
//! are forgotten. Directions that are swept along columns are added up with rows and columns exchanged, first, so that
//! the sums are turned once and no beam is. Cost: O(cells x beams). Tiles are independent, and no sum depends on the
//! width of the machine's vectors, so the result depends on neither.

use super::CellFeatures;
use super::paper_sums::{BeamTerms, FanTerms, GROUP, Planes, TileSums};
use crate::grid::{Occupancy, OccupancyGrid};
use crate::raycast::{BeamOptions, PLANE_PITCH, Sweep, Tile, TileScratch, beam_direction};
use crate::spec::CategorizationOptions;
use crate::vectors::{Kernel, Vectors};
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
const PIVOT_BEAMS: usize = 8;

/// The features of a grid, tile by tile.
#[derive(Debug)]
pub(super) struct PaperFeatures<'a> {
    grid: &'a OccupancyGrid,
    sweep: Sweep,
    tiles: Vec<Tile>,
    beams: Vec<BeamTerms>,
    fan: FanTerms,
    /// The beams in runs of the same frame, those that are swept along columns first; each begins where the `next`
    /// one of the run before it ends.
    runs: Vec<Run>,
    vectors: Vectors,
}

/// Consecutive beams that are swept in the same frame.
#[derive(Debug)]
struct Run {
    /// Along columns?
    transposed: bool,
    beams: Vec<usize>,
    terms: Vec<BeamTerms>,
    /// The run that follows around the circle.
    next: usize,
}

/// Memory of one task, reused from tile to tile.
#[derive(Debug, Default)]
pub struct Workspace {
    tile: Option<TileMemory>,
}

/// What the work on a tile needs.
#[derive(Debug)]
struct TileMemory {
    sweep: TileScratch,
    /// The beams of a block.
    planes: Planes<u16>,
    /// The first and the last beam of each run.
    ends: Planes<u16>,
    sums: TileSums,
}

impl<'a> PaperFeatures<'a> {
    /// Prepares the sweep.
    pub(super) fn new(
        grid: &'a OccupancyGrid,
        stride: usize,
        options: &CategorizationOptions,
        vectors: Vectors,
        watch: &Watch<'_>,
    ) -> Result<Self, Stopped> {
        let progress = |done: f64| watch.progress(Stage::Features, done);
        let sweep = Sweep::new(grid, &BeamOptions::from(options), vectors, watch, progress)?;
        let count = options.beams;
        let beams: Vec<BeamTerms> = (0..count)
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
        let runs = runs(&sweep, &beams);
        Ok(Self { grid, tiles: sweep.tiles(stride), runs, sweep, beams, fan, vectors })
    }

    /// How many tiles there are.
    pub(super) fn tiles(&self) -> usize {
        self.tiles.len()
    }

    /// The features of one tile.
    pub(super) fn tile(
        &self,
        index: usize,
        workspace: &mut Workspace,
        watch: &Watch<'_>,
    ) -> Result<CellFeatures, Stopped> {
        let tile = &self.tiles[index];
        let Workspace { tile: memory } = workspace;
        let memory = memory.get_or_insert_with(|| TileMemory {
            sweep: TileScratch::default(),
            planes: Planes::new(BEAMS_PER_BLOCK),
            ends: Planes::new(2 * self.runs.len()),
            sums: TileSums::default(),
        });
        let rows: Vec<usize> = tile.measured_rows().collect();
        let columns: Vec<usize> = tile.measured_columns().collect();
        let groups = [
            groups(&rows, &columns, |row, column| self.is_free(row, column)),
            groups(&columns, &rows, |column, row| self.is_free(row, column)),
        ];
        if groups[0].is_empty() {
            return Ok(CellFeatures { cells: Vec::new(), names: &NAMES, values: Vec::new() });
        }
        self.vectors.run(TileWork { features: self, tile, groups, memory, watch })?;
        Ok(self.finish(&rows, &columns, &memory.sums))
    }

    fn is_free(&self, row: usize, column: usize) -> bool {
        self.grid.row(row)[column] == Occupancy::Free
    }

    /// From sums to features, for the free cells only.
    fn finish(&self, rows: &[usize], columns: &[usize], sums: &TileSums) -> CellFeatures {
        let mut features = CellFeatures { cells: Vec::new(), names: &NAMES, values: Vec::new() };
        for (row_index, &row) in rows.iter().enumerate() {
            for (index, &column) in columns.iter().enumerate().filter(|&(_, &column)| self.is_free(row, column)) {
                let cell = sums.of_cell(row_index * PLANE_PITCH + index);
                features.cells.push((row * self.grid.width() + column) as u32);
                features.values.extend_from_slice(&cell.features(self.fan.beams, self.grid.resolution()));
            }
        }
        features
    }
}

/// Cuts the circle of beams where the frame changes; the runs along columns come first.
fn runs(sweep: &Sweep, terms: &[BeamTerms]) -> Vec<Run> {
    let count = terms.len();
    let changes = |beam: usize| sweep.is_transposed(beam) != sweep.is_transposed((beam + count - 1) % count);
    let start = (0..count).find(|&beam| changes(beam)).expect("eight beams or more look along both axes");
    let circle: Vec<usize> = (0..count).map(|turn| (start + turn) % count).collect();
    let mut runs: Vec<Run> = circle
        .chunk_by(|&a, &b| sweep.is_transposed(a) == sweep.is_transposed(b))
        .map(|beams| Run {
            transposed: sweep.is_transposed(beams[0]),
            beams: beams.to_vec(),
            terms: beams.iter().map(|&beam| terms[beam]).collect(),
            next: 0,
        })
        .collect();
    runs.sort_by_key(|run| !run.transposed);
    let firsts: Vec<usize> = runs.iter().map(|run| run.beams[0]).collect();
    for run in &mut runs {
        let after = (run.beams[run.beams.len() - 1] + 1) % count;
        run.next = firsts.iter().position(|&first| first == after).expect("a run begins where another one ends");
    }
    runs
}

/// Where, in a plane, the groups of neighbouring cells begin of which at least one is free.
fn groups(rows: &[usize], columns: &[usize], is_free: impl Fn(usize, usize) -> bool) -> Vec<usize> {
    let mut groups = Vec::new();
    for (row_index, &row) in rows.iter().enumerate() {
        for (group, columns) in columns.chunks(GROUP).enumerate() {
            if columns.iter().any(|&column| is_free(row, column)) {
                groups.push(row_index * PLANE_PITCH + group * GROUP);
            }
        }
    }
    groups
}

/// The way from the beams of a tile to its sums.
struct TileWork<'a> {
    features: &'a PaperFeatures<'a>,
    tile: &'a Tile,
    /// Groups with free cells: by rows, and by columns.
    groups: [Vec<usize>; 2],
    memory: &'a mut TileMemory,
    watch: &'a Watch<'a>,
}

impl Kernel for TileWork<'_> {
    type Output = Result<(), Stopped>;

    #[inline(always)]
    fn run<const SIMD_WIDTH: usize>(mut self) -> Self::Output {
        self.memory.sums.clear();
        self.choose_pivots();
        let runs = &self.features.runs;
        let mut transposed = true;
        for (index, run) in runs.iter().enumerate() {
            if run.transposed != transposed {
                self.turn();
                transposed = run.transposed;
            }
            self.add_run::<SIMD_WIDTH>(index, run)?;
        }
        for (index, run) in runs.iter().enumerate() {
            let beams = [run.beams[run.beams.len() - 1], runs[run.next].beams[0]];
            let terms = beams.map(|beam| &self.features.beams[beam]);
            let TileMemory { ends, sums, .. } = &mut *self.memory;
            let units = [ends.plane(2 * index + 1), ends.plane(2 * run.next)];
            sums.join::<SIMD_WIDTH>(&self.groups[0], terms, units, &self.features.fan);
        }
        Ok(())
    }
}

impl TileWork<'_> {
    /// Means of a few beams, for the sums to be taken around; leaves them in the frame of the columns.
    #[inline(always)]
    fn choose_pivots(&mut self) {
        let TileMemory { sweep: scratch, planes, sums, .. } = &mut *self.memory;
        let Self { features, tile, .. } = self;
        let count = features.fan.beams;
        let pivots = PIVOT_BEAMS.min(count);
        for transposed in [false, true] {
            let beams = (0..pivots).map(|pivot| pivot * count / pivots);
            for beam in beams.filter(|&beam| features.sweep.is_transposed(beam) == transposed) {
                features.sweep.cast(tile, beam, scratch, planes.plane_mut(0));
                sums.add_to_pivots(planes.plane(0), &features.beams[beam], &features.fan, pivots);
            }
            if !transposed {
                sums.transpose_pivots();
            }
        }
    }

    /// Adds the beams of a run, and keeps its ends.
    #[inline(always)]
    fn add_run<const SIMD_WIDTH: usize>(&mut self, index: usize, run: &Run) -> Result<(), Stopped> {
        let TileMemory { sweep: scratch, planes, sums, ends } = &mut *self.memory;
        let Self { features, tile, groups, watch, .. } = self;
        let groups = &groups[usize::from(run.transposed)];
        for (block, beams) in run.beams.chunks(BEAMS_PER_BLOCK).enumerate() {
            watch.check()?;
            for (place, &beam) in beams.iter().enumerate() {
                features.sweep.cast(tile, beam, scratch, planes.plane_mut(place));
            }
            let terms = &run.terms[block * BEAMS_PER_BLOCK..][..beams.len()];
            sums.add::<SIMD_WIDTH>(groups, terms, planes, &features.fan, block == 0);
            if block == 0 {
                ends.plane_mut(2 * index).copy_from_slice(planes.plane(0));
            }
        }
        let last = (run.beams.len() - 1) % BEAMS_PER_BLOCK;
        ends.plane_mut(2 * index + 1).copy_from_slice(planes.plane(last));
        Ok(())
    }

    /// From the frame of the columns to that of the rows.
    #[inline(always)]
    fn turn(&mut self) {
        let TileMemory { ends, sums, .. } = &mut *self.memory;
        sums.transpose();
        for (index, _) in self.features.runs.iter().enumerate().filter(|(_, run)| run.transposed) {
            ends.transpose(2 * index);
            ends.transpose(2 * index + 1);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::features::FeatureSource;
    use crate::raycast::PLANE_LENGTH;
    use crate::test_maps::real_maps;
    use proptest::prelude::*;

    fn features(grid: &OccupancyGrid, options: &CategorizationOptions) -> CellFeatures {
        let watch = Watch::unwatched();
        let source = FeatureSource::new(grid, options, Vectors::widest(), &watch).expect("nobody stops it");
        source.all(&watch).expect("nobody stops it")
    }

    /// The lengths (cells) of all beams of all measured cells of a tile, by row, column and beam.
    fn beams_of_tile(sweep: &Sweep, tile: &Tile, beams: usize) -> Vec<((usize, usize), Vec<f64>)> {
        let (mut scratch, mut plane) = (TileScratch::default(), vec![0; PLANE_LENGTH]);
        let mut cells: Vec<((usize, usize), Vec<f64>)> = tile
            .measured_rows()
            .flat_map(|row| tile.measured_columns().map(move |column| ((column, row), Vec::new())))
            .collect();
        for beam in 0..beams {
            sweep.cast(tile, beam, &mut scratch, &mut plane);
            let columns = tile.measured_columns().len();
            for (index, (_, lengths)) in cells.iter_mut().enumerate() {
                let (row, column) = (index / columns, index % columns);
                let place =
                    if sweep.is_transposed(beam) { column * PLANE_PITCH + row } else { row * PLANE_PITCH + column };
                lengths.push(f64::from((f32::from(plane[place]) * sweep.unit(beam)).min(sweep.limit())));
            }
        }
        cells
    }

    fn sweep_of(grid: &OccupancyGrid, options: &CategorizationOptions) -> Sweep {
        Sweep::new(grid, &BeamOptions::from(options), Vectors::widest(), &Watch::unwatched(), |_| ())
            .expect("nobody stops it")
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
        let sweep = sweep_of(grid, options);
        let gap = f64::from((options.gap_m / grid.resolution()) as f32);
        let mut worst = [0.0_f64; 13];
        for tile in &sweep.tiles(options.stride) {
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
    fn any_number_of_threads_and_any_vectors_give_the_same_bytes() {
        let grid = OccupancyGrid::from_ascii(&vec!["...#......##.".repeat(23); 270].join("\n"), 0.05);
        let options = CategorizationOptions { beams: 45, ..CategorizationOptions::default() };
        let bytes = |threads, vectors| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads can be had");
            let watch = Watch::unwatched();
            let found = pool.install(|| FeatureSource::new(&grid, &options, vectors, &watch)?.all(&watch));
            found.expect("nobody stops it").values.iter().map(|value| value.to_bits()).collect::<Vec<u32>>()
        };
        let first = bytes(1, Vectors::Portable);
        for vectors in Vectors::available() {
            for threads in [1, 2, 7] {
                assert!(first == bytes(threads, vectors), "{vectors:?}, {threads} threads");
            }
        }
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
        let watch = Watch::new(&stop, &Nobody);
        let stopped = FeatureSource::new(&grid, &CategorizationOptions::default(), Vectors::widest(), &watch);
        assert!(stopped.is_err());
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]

        #[test]
        fn every_vector_width_gives_the_same_features_of_random_maps(
            rows in proptest::collection::vec("[.]{4,200}[.#?]{0,30}", 1..150),
            beams in 8_usize..40,
            stride in 1_usize..4,
        ) {
            let grid = OccupancyGrid::from_ascii(&rows.join("\n"), 0.1);
            let options = CategorizationOptions { beams, stride, ..CategorizationOptions::default() };
            let watch = Watch::unwatched();
            let features = |vectors| FeatureSource::new(&grid, &options, vectors, &watch)?.all(&watch);
            let portable = features(Vectors::Portable).expect("nobody stops it");
            for vectors in Vectors::available() {
                prop_assert_eq!(&portable, &features(vectors).expect("nobody stops it"));
            }
        }

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
