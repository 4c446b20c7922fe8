//! Orientations to hundredths of a degree: one least-squares slope for the points of all sharp lines.
//!
//! The energy of a hall hardly changes over a tenth of a degree: a line of 30 m then leaves its bin by one cell only.
//! So each sharp line of the projection is fitted by least squares, all lines with one slope, those along the direction
//! and those across it together where the two are perpendicular. Long lines have most weight. The fit is accepted only
//! if the energy stays nearly the same. Errors on drawn halls: 0.05 degrees by the energy alone, 0.01 by the fit. Cost:
//! O(sample).

use std::f64::consts::FRAC_PI_2;

use super::energy::OccupiedSample;
use crate::watch::{Stopped, Watch};

/// Fits in a row; the remaining error falls to a third in each.
const ITERATIONS: usize = 4;
/// Least energy of an accepted fit, as a share of the energy before it. Scanned maps keep 0.99; drawings with crooked
/// goods keep 0.88 to 0.96, and there the energy is right.
const KEPT_ENERGY: f64 = 0.98;
/// Least height of a line above the mean count of a bin, Poisson deviations; 3 to 12 give the same results.
const DEVIATIONS: f64 = 6.0;
/// Bins to either side of a maximum that belong to its line: lines are slightly turned and bent.
const SIDE: usize = 2;

/// The direction near `angle`, radians, of the lines that a sample shows; `is_square` when there are lines across it at
/// a right angle.
///
/// # Errors
/// [`Stopped`] when the watch says so.
pub(crate) fn fit(sample: &OccupiedSample, angle: f64, is_square: bool, watch: &Watch<'_>) -> Result<f64, Stopped> {
    let mut fitted = angle;
    for _ in 0..ITERATIONS {
        let mut sums = moments(sample, fitted);
        if is_square {
            let across = moments(sample, fitted + FRAC_PI_2);
            sums = [sums[0] + across[0], sums[1] + across[1]];
        }
        if sums[1] > 0.0 {
            fitted += sums[0] / sums[1];
        }
    }
    let mut angles = vec![angle, fitted];
    if is_square {
        angles.extend([angle + FRAC_PI_2, fitted + FRAC_PI_2]);
    }
    let energies = sample.energies(&angles, watch)?;
    let [before, after] = [0, 1].map(|at| energies[at..].iter().step_by(2).sum::<f64>());
    Ok(if after >= KEPT_ENERGY * before { fitted } else { angle })
}

/// Sums over all sharp lines along a direction, each about its mean: of u v and of u u, with u along the line and v
/// across.
fn moments(sample: &OccupiedSample, angle: f64) -> [f64; 2] {
    let (sine, cosine) = angle.sin_cos();
    let place = |&[x, y]: &[f32; 2]| {
        let (x, y) = (f64::from(x), f64::from(y));
        [cosine * x + sine * y, cosine * y - sine * x]
    };
    let low = sample.points().iter().map(|point| place(point)[1]).fold(f64::INFINITY, f64::min);
    let mut bins: Vec<u32> = Vec::new();
    for point in sample.points() {
        let bin = (place(point)[1] - low) as usize;
        bins.resize(bins.len().max(bin + 1), 0);
        bins[bin] += 1;
    }
    let line_of = lines(&bins);
    let mut lines = vec![[0.0; 5]; bins.len()];
    for [u, v] in sample.points().iter().map(place) {
        if let Some(line) = line_of[(v - low) as usize] {
            let v = v - low - line as f64;
            lines[line] = std::array::from_fn(|sum| lines[line][sum] + [1.0, u, v, u * v, u * u][sum]);
        }
    }
    lines.iter().filter(|line| line[0] > 0.0).fold([0.0; 2], |[product, square], &[count, u, v, of_both, of_u]| {
        [product + of_both - u * v / count, square + of_u - u * u / count]
    })
}

/// For every bin the sharp line that it belongs to, named by its highest bin: a maximum far above the mean count.
fn lines(bins: &[u32]) -> Vec<Option<usize>> {
    let mean = bins.iter().map(|&count| f64::from(count)).sum::<f64>() / bins.len().max(1) as f64;
    let around = |at: usize, reach: usize| at.saturating_sub(reach)..bins.len().min(at + reach + 1);
    let is_line = |&at: &usize| {
        let stands_out = f64::from(bins[at]) > mean + DEVIATIONS * mean.sqrt();
        stands_out && bins[around(at, SIDE + 1)].iter().all(|&other| other <= bins[at])
    };
    let mut line_of = vec![None; bins.len()];
    for at in (0..bins.len()).filter(is_line) {
        line_of[around(at, SIDE)].fill(Some(at));
    }
    line_of
}
