//! The thirteen features of one cell as functions of twelve sums over its beams.
//!
//! With beams `d_0 .. d_(n-1)` (cells), `e_i = d_i - pivot` and `delta_i = d_i - d_(i-1)` around the circle, the sums
//! are those of `e, e^2, e^3, e^4, |delta|, delta^2`, the perimeter, the gaps, and of `d cos t, d sin t, d^2 cos 2t,
//! d^2 sin 2t`. The pivot is any number near the mean: it keeps the powers small, so that single precision is enough
//! for the kurtosis of nearly round places. The area of the polygon of end points follows from
//! `d_i d_(i-1) = (d_i^2 + d_(i-1)^2 - delta_i^2) / 2`.

use std::f64::consts::TAU;

use super::simd::SimdCells;
use crate::raycast::{PLANE_LENGTH, PLANE_PITCH};

/// Number of sums.
const SUMS: usize = 12;

/// Standard deviation of beam lengths below which they count as equal and the kurtosis is 0, cells: a grid cannot show
/// a rounder place.
const NEARLY_CONSTANT: f64 = 0.01;

/// What the beams of one direction have in common.
#[derive(Debug, Clone, Copy)]
pub(super) struct BeamTerms {
    /// Cells per unit of length.
    pub(super) unit: f32,
    pub(super) cos: f32,
    pub(super) sin: f32,
    pub(super) cos_twice: f32,
    pub(super) sin_twice: f32,
}

/// What the beams of all directions have in common.
#[derive(Debug, Clone, Copy)]
pub(super) struct ScanTerms {
    /// Beams around the circle.
    pub(super) beams: usize,
    /// Longest beam, cells.
    pub(super) limit: f32,
    /// Smallest gap, cells.
    pub(super) gap: f32,
    /// `2 (1 - cos(turn from beam to beam))`: the law of cosines is `chord^2 = delta^2 + chord_factor d_i d_(i-1)`.
    pub(super) chord_factor: f32,
}

/// Cells that are skipped together where none of them is free.
pub(super) const GROUP: usize = 16;

/// The plane of pivots.
const PIVOT: usize = SUMS;
/// The plane of the lengths of the beam added last.
const PREVIOUS: usize = SUMS + 1;

/// The sums of all cells of a tile, plane by plane.
#[derive(Debug)]
pub(super) struct TileSums(Planes<f32>);

/// Planes of numbers, one for each cell of a tile.
#[derive(Debug)]
pub(super) struct Planes<T> {
    numbers: Vec<T>,
}

impl<T: Copy + Default> Planes<T> {
    /// Numbers from one plane to the next. Planes a power of two apart would share the same cache lines.
    const STEP: usize = PLANE_LENGTH + 64;

    /// Planes of zeros.
    pub(super) fn new(count: usize) -> Self {
        Self { numbers: vec![T::default(); count * Self::STEP] }
    }

    #[inline(always)]
    pub(super) fn plane(&self, index: usize) -> &[T] {
        &self.numbers[index * Self::STEP..][..PLANE_LENGTH]
    }

    #[inline(always)]
    pub(super) fn plane_mut(&mut self, index: usize) -> &mut [T] {
        &mut self.numbers[index * Self::STEP..][..PLANE_LENGTH]
    }

    /// Exchanges rows and columns of a plane.
    #[inline(always)]
    pub(super) fn transpose(&mut self, index: usize) {
        const BLOCK: usize = 16;
        let plane = self.plane_mut(index);
        for block_row in (0..PLANE_PITCH).step_by(BLOCK) {
            for block_column in (0..=block_row).step_by(BLOCK) {
                for row in block_row..block_row + BLOCK {
                    for column in block_column..row.min(block_column + BLOCK) {
                        plane.swap(row * PLANE_PITCH + column, column * PLANE_PITCH + row);
                    }
                }
            }
        }
    }
}

impl Default for TileSums {
    fn default() -> Self {
        Self(Planes::new(SUMS + 2))
    }
}

impl TileSums {
    /// Sets all sums and pivots to 0.
    pub(super) fn clear(&mut self) {
        self.0.numbers.fill(0.0);
    }

    /// Exchanges rows and columns of all sums and pivots.
    #[inline(always)]
    pub(super) fn transpose(&mut self) {
        (0..=PIVOT).for_each(|plane| self.0.transpose(plane));
    }

    /// Exchanges rows and columns of the pivots.
    #[inline(always)]
    pub(super) fn transpose_pivots(&mut self) {
        self.0.transpose(PIVOT);
    }

    /// Adds one of the `of` beams whose mean length becomes the pivot.
    #[inline(always)]
    pub(super) fn add_to_pivots(&mut self, units: &[u16], beam: &BeamTerms, scan: &ScanTerms, of: usize) {
        let share = 1.0 / of as f32;
        for (pivot, &units) in self.0.plane_mut(PIVOT).iter_mut().zip(units) {
            *pivot += (f32::from(units) * beam.unit).min(scan.limit) * share;
        }
    }

    /// Adds consecutive beams (terms and plane of each) of the cells of some groups. Unless `opens`, the first beam
    /// follows the beam added last.
    #[inline(always)]
    pub(super) fn add<const N: usize>(
        &mut self,
        groups: &[usize],
        beams: &[BeamTerms],
        planes: &Planes<u16>,
        scan: &ScanTerms,
        opens: bool,
    ) {
        for start in groups.iter().flat_map(|&group| (group..group + GROUP).step_by(N)) {
            let mut sums: [SimdCells<N>; SUMS] = self.load(start);
            let pivot = SimdCells::<N>::load(&self.0.plane(PIVOT)[start..]);
            let mut previous = SimdCells::<N>::load(&self.0.plane(PREVIOUS)[start..]);
            for (index, beam) in beams.iter().enumerate() {
                let length = (SimdCells::from_units(&planes.plane(index)[start..]) * beam.unit).min(scan.limit);
                add_length(&mut sums, length, pivot, beam);
                if index > 0 || !opens {
                    add_change(&mut sums, previous, length, scan);
                }
                previous = length;
            }
            self.store(start, &sums);
            previous.store(&mut self.0.plane_mut(PREVIOUS)[start..]);
        }
    }

    /// The sums of some cells.
    #[inline(always)]
    fn load<const N: usize>(&self, start: usize) -> [SimdCells<N>; SUMS] {
        let mut sums = [SimdCells::ZERO; SUMS];
        for (plane, sum) in sums.iter_mut().enumerate() {
            *sum = SimdCells::load(&self.0.plane(plane)[start..]);
        }
        sums
    }

    /// Stores the sums of some cells.
    #[inline(always)]
    fn store<const N: usize>(&mut self, start: usize, sums: &[SimdCells<N>; SUMS]) {
        for (plane, sum) in sums.iter().enumerate() {
            sum.store(&mut self.0.plane_mut(plane)[start..]);
        }
    }

    /// Adds the change from one beam to another, for the cells of some groups.
    #[inline(always)]
    pub(super) fn join<const N: usize>(
        &mut self,
        groups: &[usize],
        beams: [&BeamTerms; 2],
        units: [&[u16]; 2],
        scan: &ScanTerms,
    ) {
        for start in groups.iter().flat_map(|&group| (group..group + GROUP).step_by(N)) {
            let mut sums: [SimdCells<N>; SUMS] = self.load(start);
            let previous = (SimdCells::from_units(&units[0][start..]) * beams[0].unit).min(scan.limit);
            let length = (SimdCells::from_units(&units[1][start..]) * beams[1].unit).min(scan.limit);
            add_change(&mut sums, previous, length, scan);
            self.store(start, &sums);
        }
    }

    /// The sums of the cell at a place in the planes.
    #[inline(always)]
    pub(super) fn of_cell(&self, place: usize) -> CellSums {
        CellSums {
            sums: std::array::from_fn(|sum| f64::from(self.0.plane(sum)[place])),
            pivot: f64::from(self.0.plane(PIVOT)[place]),
        }
    }
}

/// Adds the terms of a beam alone.
#[inline(always)]
fn add_length<const N: usize>(
    sums: &mut [SimdCells<N>; SUMS],
    length: SimdCells<N>,
    pivot: SimdCells<N>,
    beam: &BeamTerms,
) {
    let squared = length * length;
    let shifted = length - pivot;
    let shifted_squared = shifted * shifted;
    sums[0] += shifted;
    sums[1] += shifted_squared;
    sums[2] += shifted_squared * shifted;
    sums[3] += shifted_squared * shifted_squared;
    sums[8] += length * beam.cos;
    sums[9] += length * beam.sin;
    sums[10] += squared * beam.cos_twice;
    sums[11] += squared * beam.sin_twice;
}

/// Adds the terms of a beam and the one before it.
#[inline(always)]
fn add_change<const N: usize>(
    sums: &mut [SimdCells<N>; SUMS],
    previous: SimdCells<N>,
    length: SimdCells<N>,
    scan: &ScanTerms,
) {
    let change = length - previous;
    let (change_size, change_squared) = (change.abs(), change * change);
    sums[4] += change_size;
    sums[5] += change_squared;
    sums[6] += (length * previous * scan.chord_factor + change_squared).sqrt();
    sums[7] += change_size.above(scan.gap);
}

/// The sums of one cell.
pub(super) struct CellSums {
    sums: [f64; SUMS],
    pivot: f64,
}

impl CellSums {
    /// The features, in the order of Table I.
    #[inline(always)]
    pub(super) fn features(&self, beams: usize, resolution: f64) -> [f32; 13] {
        let count = beams as f64;
        let [shifted, squared, cubed, fourth, change, change_squared, perimeter, gaps, x, y, cos_twice, sin_twice] =
            self.sums.map(|sum| sum / count);
        let mean = self.pivot + shifted;
        let variance = (squared - shifted * shifted).max(0.0);
        let fourth_moment = fourth - 4.0 * shifted * cubed + 6.0 * shifted * shifted * squared - 3.0 * shifted.powi(4);
        let kurtosis = if variance < NEARLY_CONSTANT * NEARLY_CONSTANT {
            0.0
        } else {
            fourth_moment / (variance * variance) - 3.0
        };
        let mean_square = variance + mean * mean;
        let area = 0.5 * (TAU / count).sin() * count * (mean_square - 0.5 * change_squared);
        let perimeter = perimeter * count;
        let [major, minor] = principal_spreads([
            0.5 * (mean_square + cos_twice) - x * x,
            0.5 * (mean_square - cos_twice) - y * y,
            0.5 * sin_twice - x * y,
        ]);
        [
            mean * resolution,
            variance.sqrt() * resolution,
            change * resolution,
            (change_squared - change * change).max(0.0).sqrt() * resolution,
            area * resolution * resolution,
            perimeter * resolution,
            perimeter * perimeter / area,
            (gaps * count).round(),
            kurtosis,
            major * resolution,
            minor * resolution,
            major / minor,
            (x * x + y * y).sqrt() * resolution,
        ]
        .map(|feature| if feature.is_finite() { feature as f32 } else { 0.0 })
    }
}

/// Square roots of the eigenvalues of a covariance `[xx, yy, xy]`, the larger first.
pub(super) fn principal_spreads([xx, yy, xy]: [f64; 3]) -> [f64; 2] {
    let (middle, half_difference) = (0.5 * (xx + yy), 0.5 * (xx - yy));
    let radius = (half_difference * half_difference + xy * xy).sqrt();
    [(middle + radius).max(0.0).sqrt(), (middle - radius).max(0.0).sqrt()]
}
