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
//! Departures from the paper: none known. Where its table leaves a definition open, the author's code and O. Mozos'
//! definitions decide (differences wrap around as in Mozos). A feature that is no number (PC2 of points on a line) is
//! 0.
//!
//! Method: the sweep gives the beams of a tile direction by direction; each is added to twelve running sums per cell
//! and not kept. Directions that are swept along columns come first, with rows and columns exchanged, so that the sums
//! are transposed once and no beam is. Cost: O(cells x beams). Tiles are independent, and no sum depends on the SIMD
//! width, so the result depends on neither threads nor machine.

use super::cell_features::CellFeatures;
use super::paper_sums::{BeamTerms, GROUP, Planes, ScanTerms, TileSums};
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

/// Beams that are cast before they are added, so that the sums are loaded once for all of them.
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
    scan: ScanTerms,
    /// The beams in runs of the same frame; the runs that are swept along columns come first.
    runs: Vec<BeamRun>,
    vectors: Vectors,
}

/// Consecutive beams that are swept in the same frame.
#[derive(Debug)]
struct BeamRun {
    /// Whether they are swept along columns.
    transposed: bool,
    beams: Vec<usize>,
    terms: Vec<BeamTerms>,
    /// Index of the run whose first beam follows the last of this one around the circle.
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
        let scan = ScanTerms {
            beams: count,
            limit: sweep.limit(),
            gap: (options.gap_m / grid.resolution()) as f32,
            chord_factor: (2.0 * (1.0 - beam_direction(1, count).x)) as f32,
        };
        let runs = runs(&sweep, &beams);
        Ok(Self { grid, tiles: sweep.tiles(stride), runs, sweep, beams, scan, vectors })
    }

    /// Number of tiles.
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
                features.values.extend_from_slice(&cell.features(self.scan.beams, self.grid.resolution()));
            }
        }
        features
    }
}

/// Splits the circle of beams where the frame changes.
fn runs(sweep: &Sweep, terms: &[BeamTerms]) -> Vec<BeamRun> {
    let count = terms.len();
    let changes = |beam: usize| sweep.is_transposed(beam) != sweep.is_transposed((beam + count - 1) % count);
    let start = (0..count).find(|&beam| changes(beam)).expect("eight beams or more look along both axes");
    let circle: Vec<usize> = (0..count).map(|turn| (start + turn) % count).collect();
    let mut runs: Vec<BeamRun> = circle
        .chunk_by(|&a, &b| sweep.is_transposed(a) == sweep.is_transposed(b))
        .map(|beams| BeamRun {
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

/// Where in a plane the groups of neighbouring cells begin that hold a free cell.
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

/// The computation of the sums of a tile from its beams.
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
                self.transpose();
                transposed = run.transposed;
            }
            self.add_run::<SIMD_WIDTH>(index, run)?;
        }
        for (index, run) in runs.iter().enumerate() {
            let beams = [run.beams[run.beams.len() - 1], runs[run.next].beams[0]];
            let terms = beams.map(|beam| &self.features.beams[beam]);
            let TileMemory { ends, sums, .. } = &mut *self.memory;
            let units = [ends.plane(2 * index + 1), ends.plane(2 * run.next)];
            sums.join::<SIMD_WIDTH>(&self.groups[0], terms, units, &self.features.scan);
        }
        Ok(())
    }
}

impl TileWork<'_> {
    /// Sets each pivot to the mean of a few beams; leaves the pivots in the frame of the columns.
    #[inline(always)]
    fn choose_pivots(&mut self) {
        let TileMemory { sweep: scratch, planes, sums, .. } = &mut *self.memory;
        let Self { features, tile, .. } = self;
        let count = features.scan.beams;
        let pivots = PIVOT_BEAMS.min(count);
        for transposed in [false, true] {
            let beams = (0..pivots).map(|pivot| pivot * count / pivots);
            for beam in beams.filter(|&beam| features.sweep.is_transposed(beam) == transposed) {
                features.sweep.cast(tile, beam, scratch, planes.plane_mut(0));
                sums.add_to_pivots(planes.plane(0), &features.beams[beam], &features.scan, pivots);
            }
            if !transposed {
                sums.transpose_pivots();
            }
        }
    }

    /// Adds the beams of a run, and keeps its first and last beam.
    #[inline(always)]
    fn add_run<const SIMD_WIDTH: usize>(&mut self, index: usize, run: &BeamRun) -> Result<(), Stopped> {
        let TileMemory { sweep: scratch, planes, sums, ends } = &mut *self.memory;
        let Self { features, tile, groups, watch, .. } = self;
        let groups = &groups[usize::from(run.transposed)];
        for (block, beams) in run.beams.chunks(BEAMS_PER_BLOCK).enumerate() {
            watch.check()?;
            for (place, &beam) in beams.iter().enumerate() {
                features.sweep.cast(tile, beam, scratch, planes.plane_mut(place));
            }
            let terms = &run.terms[block * BEAMS_PER_BLOCK..][..beams.len()];
            sums.add::<SIMD_WIDTH>(groups, terms, planes, &features.scan, block == 0);
            if block == 0 {
                ends.plane_mut(2 * index).copy_from_slice(planes.plane(0));
            }
        }
        let last = (run.beams.len() - 1) % BEAMS_PER_BLOCK;
        ends.plane_mut(2 * index + 1).copy_from_slice(planes.plane(last));
        Ok(())
    }

    /// Transposes sums and kept beams from the frame of the columns to that of the rows.
    #[inline(always)]
    fn transpose(&mut self) {
        let TileMemory { ends, sums, .. } = &mut *self.memory;
        sums.transpose();
        for (index, _) in self.features.runs.iter().enumerate().filter(|(_, run)| run.transposed) {
            ends.transpose(2 * index);
            ends.transpose(2 * index + 1);
        }
    }
}

#[cfg(test)]
mod tests;
