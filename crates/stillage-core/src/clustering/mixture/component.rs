//! One component of a mixture, stored as the factor that turns its rows into standard normal ones, so that a density
//! needs only a sum of squares.

use serde::{Deserialize, Serialize};

use crate::clustering::points::SIMD_WIDTH;

/// A weighted normal distribution.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct NormalComponent {
    pub(super) weight: f64,
    pub(super) mean: Vec<f64>,
    pub(super) whitening: Whitening,
    /// Logarithm of the weighted density at the mean.
    log_peak: f64,
}

/// What turns a row, less the mean, into a standard normal one: the inverse of the covariance's Cholesky factor.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) enum Whitening {
    /// One factor per column.
    Diagonal(Vec<f64>),
    /// Lower triangle, row by row.
    Full(Vec<f64>),
}

impl NormalComponent {
    pub(super) fn new(weight: f64, mean: Vec<f64>, whitening: Whitening) -> Self {
        let diagonal: Vec<f64> = match &whitening {
            Whitening::Diagonal(factors) => factors.clone(),
            Whitening::Full(rows) => (0..mean.len()).map(|row| rows[triangle(row + 1) - 1]).collect(),
        };
        let log_determinant: f64 = diagonal.iter().map(|factor| factor.ln()).sum();
        let log_peak = weight.ln() + log_determinant - 0.5 * mean.len() as f64 * std::f64::consts::TAU.ln();
        Self { weight, mean, whitening, log_peak }
    }

    /// Logarithm of the weighted density at each row of a group. `offsets` is scratch, one entry per column.
    #[inline]
    pub(super) fn log_densities(
        &self,
        group: &[[f32; SIMD_WIDTH]],
        offsets: &mut [[f64; SIMD_WIDTH]],
    ) -> [f64; SIMD_WIDTH] {
        for ((offset, values), mean) in offsets.iter_mut().zip(group).zip(&self.mean) {
            *offset = values.map(|value| f64::from(value) - mean);
        }
        let squares = match &self.whitening {
            Whitening::Diagonal(factors) => {
                sum_of_squares(offsets.iter().zip(factors).map(|(offset, factor)| offset.map(|value| value * factor)))
            }
            Whitening::Full(rows) => sum_of_squares((0..offsets.len()).map(|row| {
                let mut sum = [0.0; SIMD_WIDTH];
                for (factor, offset) in rows[triangle(row)..triangle(row + 1)].iter().zip(&*offsets) {
                    for (sum, value) in sum.iter_mut().zip(offset) {
                        *sum += factor * value;
                    }
                }
                sum
            })),
        };
        squares.map(|square| self.log_peak - 0.5 * square)
    }
}

/// Entries in the first rows of a lower triangle.
pub(super) const fn triangle(rows: usize) -> usize {
    rows * (rows + 1) / 2
}

#[inline]
fn sum_of_squares(columns: impl Iterator<Item = [f64; SIMD_WIDTH]>) -> [f64; SIMD_WIDTH] {
    let mut sum = [0.0; SIMD_WIDTH];
    for column in columns {
        for (sum, value) in sum.iter_mut().zip(column) {
            *sum += value * value;
        }
    }
    sum
}
