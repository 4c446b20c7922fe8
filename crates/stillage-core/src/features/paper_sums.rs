//! The thirteen features of one cell as functions of twelve sums over its beams.
//!
//! With beams `d_0 .. d_(n-1)` (cells), `e_i = d_i - pivot` and `delta_i = d_i - d_(i-1)` around the circle, the sums
//! are those of `e, e^2, e^3, e^4, |delta|, delta^2`, the perimeter, the gaps, and of `d cos t, d sin t, d^2 cos 2t,
//! d^2 sin 2t`. The pivot is any number near the mean: it keeps the powers small, so that single precision is enough
//! even for the kurtosis of nearly round places. Everything else follows:
//! `d_i d_(i-1) = (d_i^2 + d_(i-1)^2 - delta_i^2) / 2` gives the area of the polygon of end points.

use std::f64::consts::TAU;

use super::lanes::{LANES, Lanes};

/// How many sums there are.
const SUMS: usize = 12;

/// Spread of beam lengths, in cells, below which they count as equal and the kurtosis as nothing: a grid cannot show a
/// rounder place than this.
const NEARLY_CONSTANT: f64 = 0.01;

/// What all beams of a direction have in common.
#[derive(Debug, Clone, Copy)]
pub(super) struct BeamTerms {
    /// Cells per unit of length.
    pub(super) unit: f32,
    pub(super) cos: f32,
    pub(super) sin: f32,
    pub(super) cos_twice: f32,
    pub(super) sin_twice: f32,
}

/// What all beams of all directions have in common.
#[derive(Debug, Clone, Copy)]
pub(super) struct FanTerms {
    /// Beams around the circle.
    pub(super) beams: usize,
    /// Longest beam, cells.
    pub(super) limit: f32,
    /// Smallest gap, cells.
    pub(super) gap: f32,
    /// `2 (1 - cos(turn from beam to beam))`: the law of cosines is `chord^2 = delta^2 + chord_factor d_i d_(i-1)`.
    pub(super) chord_factor: f32,
}

/// The sums of a few neighbouring cells.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct RunningSums {
    sums: [Lanes; SUMS],
    previous: Lanes,
    pivot: Lanes,
}

impl RunningSums {
    /// Adds one of `of` lengths whose mean becomes the pivot.
    #[inline]
    pub(super) fn add_to_pivot(&mut self, units: &[u16; LANES], beam: &BeamTerms, fan: &FanTerms, of: usize) {
        self.pivot += (Lanes::from_units(units) * beam.unit).min(fan.limit) * (1.0 / of as f32);
    }

    /// Says which beam came before the first one: the last.
    #[inline]
    pub(super) fn begin_after(&mut self, units: &[u16; LANES], beam: &BeamTerms, fan: &FanTerms) {
        self.previous = (Lanes::from_units(units) * beam.unit).min(fan.limit);
    }

    /// Adds consecutive beams: of each, its terms and the plane that holds this group of cells from `start` on.
    #[inline]
    pub(super) fn add(&mut self, beams: &[BeamTerms], planes: &[Vec<u16>], start: usize, fan: &FanTerms) {
        let mut sums = self.sums;
        let mut previous = self.previous;
        for (beam, plane) in beams.iter().zip(planes) {
            let length = (Lanes::from_units(units_of(plane, start)) * beam.unit).min(fan.limit);
            let change = length - previous;
            let (change_size, change_squared) = (change.abs(), change * change);
            let squared = length * length;
            let shifted = length - self.pivot;
            let shifted_squared = shifted * shifted;
            sums[0] += shifted;
            sums[1] += shifted_squared;
            sums[2] += shifted_squared * shifted;
            sums[3] += shifted_squared * shifted_squared;
            sums[4] += change_size;
            sums[5] += change_squared;
            sums[6] += (length * previous * fan.chord_factor + change_squared).sqrt();
            sums[7] += change_size.above(fan.gap);
            sums[8] += length * beam.cos;
            sums[9] += length * beam.sin;
            sums[10] += squared * beam.cos_twice;
            sums[11] += squared * beam.sin_twice;
            previous = length;
        }
        self.sums = sums;
        self.previous = previous;
    }

    /// The sums of one of the cells.
    pub(super) fn of_lane(&self, lane: usize) -> CellSums {
        CellSums { sums: self.sums.map(|sum| f64::from(sum.0[lane])), pivot: f64::from(self.pivot.0[lane]) }
    }
}

/// The lengths of the group of cells that begins at `start`.
pub(super) fn units_of(plane: &[u16], start: usize) -> &[u16; LANES] {
    plane[start..].first_chunk().expect("rows of a plane are filled up to whole groups")
}

/// The sums of one cell.
pub(super) struct CellSums {
    sums: [f64; SUMS],
    pivot: f64,
}

impl CellSums {
    /// The features, in the order of [`super::paper::NAMES`].
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
            x.hypot(y) * resolution,
        ]
        .map(|feature| if feature.is_finite() { feature as f32 } else { 0.0 })
    }
}

/// Square roots of the eigenvalues of a covariance `[xx, yy, xy]`, the larger first.
pub(super) fn principal_spreads([xx, yy, xy]: [f64; 3]) -> [f64; 2] {
    let (middle, half_difference) = (0.5 * (xx + yy), 0.5 * (xx - yy));
    let radius = half_difference.hypot(xy);
    [(middle + radius).max(0.0).sqrt(), (middle - radius).max(0.0).sqrt()]
}
