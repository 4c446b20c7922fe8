//! The seventeen features of the author's published code of April 2017, over that code's beams.
//!
//! Source: the recipe (not the text) of `Place-Categorization-2D` by S. Gholami Shahbandi. It differs from the paper's
//! Table I. It is followed exactly, because the author published maps with the categories that it gives:
//!
//! - A beam is sampled every cell. The sample of length `l` is the cell `trunc(cell + l (cos, sin))`, moved into the
//!   image where it lies outside. The beam length is the number of samples before the first one that stops it (so 0
//!   beside a wall), in cells; the last sample, `range / resolution` (4 m unless `max_range_m` says otherwise), always
//!   stops it.
//! - Lengths and differences are divided by the range in *metres*; differences do not wrap around; a gap is a
//!   difference above one *cell*, whatever `gap_m` says; the kurtosis is `m4 / m2^2`, without the 3.
//! - End points are divided by the resolution once more before the principal components. These four features come
//!   twice, the second time without coinciding neighbours.
//!
//! Samples on a border of cells are rounded in double precision as in the author's code: that decides gaps, and gaps
//! decide categories. Departure: a quotient that is no number is 0.
//!
//! Method: each beam is followed alone, but skips as many samples as the chessboard distance to the nearest obstacle
//! allows, which changes no result. Cost: O(cells x beams x skips), a few skips per beam.

use std::f64::consts::TAU;

use super::cell_features::CellFeatures;
use super::lattice::measured_rows;
use super::paper_sums::principal_spreads;
use crate::geometry::{Vector, direction};
use crate::grid::{Occupancy, OccupancyGrid};
use crate::spec::CategorizationOptions;
use crate::watch::{Stopped, Watch};

/// The features, in their order.
pub(super) const NAMES: [&str; 17] = [
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
    "pc1Resampled",
    "pc2Resampled",
    "pcRatioResampled",
    "offsetResampled",
];

/// Longest beam in the author's code, metres.
const DEFAULT_RANGE_M: f64 = 4.0;
/// Smallest gap in the author's code, cells.
const GAP_CELLS: f64 = 1.0;
/// Standard deviation below which the author's kurtosis is 0, cells.
const NO_SPREAD: f64 = 2e-6;
/// End points nearer than this coincide, in the author's unit (cells over resolution).
const COINCIDENT: f64 = 0.5;
/// Cells that one task measures.
const CELLS_PER_CHUNK: usize = 512;

/// The features of a grid, chunk by chunk of its measured cells.
#[derive(Debug)]
pub(super) struct HalmstadFeatures {
    cells: Vec<u32>,
    beams: usize,
    caster: Caster,
}

impl HalmstadFeatures {
    pub(super) fn new(grid: &OccupancyGrid, stride: usize, options: &CategorizationOptions) -> Self {
        let free = |(start, row): (usize, &[Occupancy])| {
            let columns = (0..row.len()).step_by(stride).filter(|&column| row[column] == Occupancy::Free);
            columns.map(|column| (start + column) as u32).collect::<Vec<u32>>()
        };
        let cells = measured_rows(grid, stride).flat_map(free).collect();
        Self { cells, beams: options.beams, caster: Caster::new(grid, options) }
    }

    /// Number of chunks.
    pub(super) fn chunks(&self) -> usize {
        self.cells.len().div_ceil(CELLS_PER_CHUNK)
    }

    /// The features of one chunk.
    pub(super) fn chunk(&self, index: usize, watch: &Watch<'_>) -> Result<CellFeatures, Stopped> {
        watch.check()?;
        let start = index * CELLS_PER_CHUNK;
        let cells = self.cells[start..self.cells.len().min(start + CELLS_PER_CHUNK)].to_vec();
        let mut lengths = vec![0.0; self.beams];
        let mut values = Vec::with_capacity(cells.len() * NAMES.len());
        for &cell in &cells {
            self.caster.cast(cell as usize, &mut lengths);
            values.extend_from_slice(&self.caster.features(&lengths));
        }
        Ok(CellFeatures { cells, names: &NAMES, values })
    }
}

/// Casts the author's beams.
#[derive(Debug)]
struct Caster {
    width: usize,
    height: usize,
    /// Chessboard distance of each cell to the nearest one that stops beams.
    distances: Vec<u16>,
    directions: Vec<Vector>,
    /// Samples per beam.
    samples: i64,
    range_m: f64,
    resolution: f64,
}

impl Caster {
    fn new(grid: &OccupancyGrid, options: &CategorizationOptions) -> Self {
        let range_m = options.max_range_m.unwrap_or(DEFAULT_RANGE_M);
        let turn = TAU / options.beams as f64;
        Self {
            width: grid.width(),
            height: grid.height(),
            distances: chessboard_distances(grid, options.unknown_blocks),
            directions: (0..options.beams).map(|beam| direction(beam as f64 * turn)).collect(),
            samples: ((range_m / grid.resolution()).round() as i64).max(1),
            range_m,
            resolution: grid.resolution(),
        }
    }

    /// The lengths of all beams of a cell.
    fn cast(&self, cell: usize, lengths: &mut [f64]) {
        let (column, row) = ((cell % self.width) as f64, (cell / self.width) as f64);
        for (length, direction) in lengths.iter_mut().zip(&self.directions) {
            *length = self.length(column, row, direction) as f64;
        }
    }

    /// Number of samples of a beam before the one that stops it.
    fn length(&self, column: f64, row: f64, direction: &Vector) -> i64 {
        let mut sample = 1;
        while sample < self.samples {
            let way = direction * sample as f64;
            let column = cell_within(column + way.x, self.width);
            let row = cell_within(row + way.y, self.height);
            let distance = self.distances[row * self.width + column];
            if distance == 0 {
                break;
            }
            sample += i64::from(distance);
        }
        sample.min(self.samples) - 1
    }

    /// The features of a cell with these beams (cells).
    fn features(&self, lengths: &[f64]) -> [f32; 17] {
        let count = lengths.len() as f64;
        let [mean, deviation, kurtosis] = moments(lengths.iter().copied(), count);
        let differences = lengths.windows(2).map(|pair| (pair[1] - pair[0]).abs());
        // The author divides by the number of beams, one more than there are differences.
        let mean_difference = differences.clone().sum::<f64>() / (count - 1.0);
        let difference_square: f64 = differences.clone().map(|change| (change - mean_difference).powi(2)).sum();
        let [area, perimeter] = polygon(lengths);
        let end_points: Vec<Vector> = lengths
            .iter()
            .zip(&self.directions)
            .map(|(length, direction)| direction * *length / self.resolution)
            .collect();
        let all = spread(&end_points);
        let resampled = spread(&without_coincident(&end_points));
        [
            mean / self.range_m,
            deviation / self.range_m,
            mean_difference / self.range_m,
            (difference_square / count).sqrt() / self.range_m,
            area,
            perimeter,
            perimeter * perimeter / area,
            differences.filter(|&change| change > GAP_CELLS).count() as f64,
            kurtosis,
            all[0],
            all[1],
            all[2],
            all[3],
            resampled[0],
            resampled[1],
            resampled[2],
            resampled[3],
        ]
        .map(|feature| if feature.is_finite() { feature as f32 } else { 0.0 })
    }
}

/// A coordinate without its fraction, moved into the image.
fn cell_within(coordinate: f64, end: usize) -> usize {
    (coordinate as i64).clamp(0, end as i64 - 1) as usize
}

/// Mean, standard deviation and kurtosis.
fn moments(values: impl Iterator<Item = f64> + Clone, count: f64) -> [f64; 3] {
    let mean = values.clone().sum::<f64>() / count;
    let deviation = (values.clone().map(|value| (value - mean).powi(2)).sum::<f64>() / count).sqrt();
    let fourth = values.map(|value| (value - mean).powi(4)).sum::<f64>() / count;
    let kurtosis = if deviation < NO_SPREAD { 0.0 } else { fourth / deviation.powi(4) };
    [mean, deviation, kurtosis]
}

/// Area and perimeter of the closed polygon of end points.
fn polygon(lengths: &[f64]) -> [f64; 2] {
    let (sin, cos) = (TAU / lengths.len() as f64).sin_cos();
    let last = lengths.last().copied().unwrap_or(0.0);
    let before = std::iter::once(last).chain(lengths.iter().copied());
    let mut sums = [0.0; 2];
    for (previous, &length) in before.zip(lengths) {
        sums[0] += length * previous * sin / 2.0;
        sums[1] += (previous * sin).hypot(length - previous * cos);
    }
    sums
}

/// PC1, PC2, their ratio, and the distance of the mean from the origin.
fn spread(points: &[Vector]) -> [f64; 4] {
    let count = points.len() as f64;
    let mean = points.iter().sum::<Vector>() / count;
    let mut covariance = [0.0; 3];
    for point in points {
        let offset = point - mean;
        covariance[0] += offset.x * offset.x / count;
        covariance[1] += offset.y * offset.y / count;
        covariance[2] += offset.x * offset.y / count;
    }
    let [major, minor] = principal_spreads(covariance);
    [major, minor, major / minor, mean.norm()]
}

/// The points without those that coincide with the one before.
fn without_coincident(points: &[Vector]) -> Vec<Vector> {
    let last = points.last().into_iter();
    let pairs = last.chain(points).zip(points);
    pairs.filter(|(previous, point)| (*point - *previous).norm() >= COINCIDENT).map(|(_, point)| *point).collect()
}

/// Chessboard distance of each cell to the nearest one that stops beams, exact in two passes over the grid
/// (A. Rosenfeld and J. Pfaltz 1968, doi 10.1016/0031-3203(68)90013-7).
fn chessboard_distances(grid: &OccupancyGrid, unknown_blocks: bool) -> Vec<u16> {
    let (width, height) = (grid.width(), grid.height());
    let stops = |cell: &Occupancy| match cell {
        Occupancy::Free => false,
        Occupancy::Occupied => true,
        Occupancy::Unknown => unknown_blocks,
    };
    let mut distances: Vec<u16> = grid.cells().iter().map(|cell| if stops(cell) { 0 } else { u16::MAX }).collect();
    for row in 0..height {
        for column in 0..width {
            lower(&mut distances, width, row * width + column, column, (row > 0).then(|| (row - 1) * width), true);
        }
    }
    for row in (0..height).rev() {
        for column in (0..width).rev() {
            let ahead = (row + 1 < height).then(|| (row + 1) * width);
            lower(&mut distances, width, row * width + column, column, ahead, false);
        }
    }
    distances
}

/// Lowers the distance of a cell to one more than that of its neighbours in a finished row, and of the one beside it.
fn lower(distances: &mut [u16], width: usize, cell: usize, column: usize, row: Option<usize>, ascending: bool) {
    let mut nearest = distances[cell];
    if let Some(row) = row {
        let near = &distances[row + column.saturating_sub(1)..row + width.min(column + 2)];
        nearest = near.iter().fold(nearest, |nearest, &distance| nearest.min(distance.saturating_add(1)));
    }
    let beside = if ascending { column.checked_sub(1) } else { (column + 1 < width).then_some(column + 1) };
    if let Some(beside) = beside {
        nearest = nearest.min(distances[cell - column + beside].saturating_add(1));
    }
    distances[cell] = nearest;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec::FeatureProfile;
    use expect_test::expect;
    use proptest::prelude::*;

    fn options(beams: usize, range_m: f64) -> CategorizationOptions {
        let max_range_m = Some(range_m);
        CategorizationOptions { profile: FeatureProfile::Halmstad2017, beams, max_range_m, ..Default::default() }
    }

    fn lengths(caster: &Caster, cell: usize) -> Vec<f64> {
        let mut lengths = vec![0.0; caster.directions.len()];
        caster.cast(cell, &mut lengths);
        lengths
    }

    /// The recipe as it is written: every sample is looked at.
    fn sample_by_sample(grid: &OccupancyGrid, caster: &Caster, cell: usize) -> Vec<f64> {
        let (column, row) = ((cell % grid.width()) as f64, (cell / grid.width()) as f64);
        let at = |start: f64, step: f64, end: usize| ((start + step) as i64).clamp(0, end as i64 - 1);
        let length = |direction: &Vector| {
            let stops = |sample: &i64| {
                let length = *sample as f64;
                let column = at(column, length * direction.x, grid.width());
                let row = at(row, length * direction.y, grid.height());
                *sample == caster.samples || grid.at(column, row) != Occupancy::Free
            };
            ((1..=caster.samples).find(stops).expect("the last sample stops") - 1) as f64
        };
        caster.directions.iter().map(length).collect()
    }

    #[test]
    fn a_beam_counts_the_free_samples_before_a_wall() {
        let picture = "
            .......
            .....#.
            .......
            ...x..#
            .......
            ##.....
            ..#....
            ";
        let grid = OccupancyGrid::from_ascii(&picture.replace('x', "."), 1.0);
        let caster = Caster::new(&grid, &options(8, 5.0));
        // Samples outside the image are moved to its border, so beams there reach the range. The beam straight down
        // runs in the column beside the cell, since the cosine of three quarters of a turn is rounded below zero.
        assert_eq!(lengths(&caster, 3 * 7 + 3), [2.0, 2.0, 4.0, 4.0, 4.0, 1.0, 2.0, 4.0]);
    }

    #[test]
    fn unusual_cells_have_features_without_holes() {
        let enclosed = OccupancyGrid::from_ascii("###\n#.#\n###", 0.02);
        let open = OccupancyGrid::from_ascii("...\n...\n...", 0.02);
        let line = |grid: &OccupancyGrid| {
            let caster = Caster::new(grid, &options(360, 0.1));
            caster.features(&lengths(&caster, 4)).map(|value| format!("{value:.3}")).join(" ")
        };
        expect!["2.472 4.314 0.056 0.743 0.768 3.536 16.281 0.000 2.373 19.583 10.493 1.866 11.155 20.986 6.379 3.290 44.622"].assert_eq(&line(&enclosed));
        expect!["40.000 0.000 0.000 0.000 50.263 25.132 12.567 0.000 0.000 141.421 141.421 1.000 0.000 141.421 141.421 1.000 0.000"].assert_eq(&line(&open));
    }

    proptest! {
        #[test]
        fn jumps_change_no_result(
            rows in proptest::collection::vec("[.]{3,25}[.#]{0,5}[.]{0,9}", 1..30),
            beams in 8_usize..90,
            range in 1.0..40.0,
            at in 0.0..1.0,
        ) {
            let grid = OccupancyGrid::from_ascii(&rows.join("\n"), 1.0);
            let caster = Caster::new(&grid, &options(beams, range));
            let cell = (at * grid.cells().len() as f64) as usize;
            prop_assert_eq!(lengths(&caster, cell), sample_by_sample(&grid, &caster, cell));
        }
    }
}
