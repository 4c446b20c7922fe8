//! Gaussian mixture: clusters with a size and shape of their own, and memberships in place of verdicts.
//!
//! The density of a row is the sum of weighted normal densities; its membership in a component is the component's share
//! of it. Covariances are diagonal (columns independent within a component) or full. Fitted by
//! expectation-maximization (`em`; A. Dempster, N. Laird and D. Rubin 1977). Memberships are formed from logarithms of
//! densities: far from every component they still sum to 1.
//!
//! A component is kept as the factor that turns its rows into standard normal ones, so a density is a sum of squares.
//!
//! Cost: O(k x columns) per row with diagonal covariances, O(k x columns^2) with full ones. Limits: 255 components.

mod em;

use serde::{Deserialize, Serialize};

use super::points::SIMD_WIDTH;

pub(super) use em::{Fitted, REGULARIZATION, fit};

/// A sum of weighted normal distributions over scaled rows.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GaussianMixture {
    components: Vec<Component>,
}

/// A weighted normal distribution.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Component {
    weight: f64,
    mean: Vec<f64>,
    whitening: Whitening,
    /// Logarithm of the weighted density at the mean.
    log_peak: f64,
}

/// What turns a row, less the mean, into a standard normal one: the inverse of the covariance's Cholesky factor.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
enum Whitening {
    /// One factor per column.
    Diagonal(Vec<f64>),
    /// Lower triangle, row by row.
    Full(Vec<f64>),
}

impl Component {
    fn new(weight: f64, mean: Vec<f64>, whitening: Whitening) -> Self {
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
    fn log_densities(&self, group: &[[f32; SIMD_WIDTH]], offsets: &mut [[f64; SIMD_WIDTH]]) -> [f64; SIMD_WIDTH] {
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
const fn triangle(rows: usize) -> usize {
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

impl GaussianMixture {
    /// Number of components.
    #[must_use]
    pub fn len(&self) -> usize {
        self.components.len()
    }

    /// Whether there are no components.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.components.is_empty()
    }

    /// Share of each component, sum 1.
    #[must_use]
    pub fn weights(&self) -> Vec<f64> {
        self.components.iter().map(|component| component.weight).collect()
    }

    /// The chosen components, in that order, with weights that sum to 1 again.
    pub(super) fn reordered(&self, order: &[usize]) -> Self {
        let total: f64 = order.iter().map(|&component| self.components[component].weight).sum();
        let chosen = order.iter().map(|&component| {
            let Component { weight, mean, whitening, .. } = self.components[component].clone();
            Component::new(weight / total, mean, whitening)
        });
        Self { components: chosen.collect() }
    }

    /// Membership of each row of a group in each component, and the logarithm of the density at each row.
    pub(super) fn memberships(&self, group: &[[f32; SIMD_WIDTH]], scratch: &mut Scratch) -> [f64; SIMD_WIDTH] {
        scratch.offsets.resize(group.len(), [0.0; SIMD_WIDTH]);
        scratch.memberships.clear();
        let log_densities = self.components.iter().map(|part| part.log_densities(group, &mut scratch.offsets));
        scratch.memberships.extend(log_densities);
        normalize(&mut scratch.memberships)
    }
}

/// What the memberships of a group are computed in.
#[derive(Debug, Default)]
pub(super) struct Scratch {
    offsets: Vec<[f64; SIMD_WIDTH]>,
    /// By component, the memberships of the rows.
    pub memberships: Vec<[f64; SIMD_WIDTH]>,
}

/// Turns logarithms of weighted densities into shares; gives the logarithm of their sum.
pub(super) fn normalize(log_densities: &mut [[f64; SIMD_WIDTH]]) -> [f64; SIMD_WIDTH] {
    let mut largest = [f64::NEG_INFINITY; SIMD_WIDTH];
    for densities in &*log_densities {
        for (largest, &density) in largest.iter_mut().zip(densities) {
            *largest = largest.max(density);
        }
    }
    let mut sums = [0.0; SIMD_WIDTH];
    for densities in &mut *log_densities {
        for ((density, sum), largest) in densities.iter_mut().zip(&mut sums).zip(largest) {
            *density = (*density - largest).exp();
            *sum += *density;
        }
    }
    for densities in &mut *log_densities {
        for (density, sum) in densities.iter_mut().zip(sums) {
            *density /= sum;
        }
    }
    std::array::from_fn(|slot| largest[slot] + sums[slot].ln())
}

#[cfg(test)]
mod tests;
