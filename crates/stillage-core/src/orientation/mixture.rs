//! Mixture of wrapped normal distributions with a uniform floor, over directions of lines (period pi).
//!
//! Source: the paper, II-B: "GMM acts as an aggressive low-pass filter". Fitted by expectation-maximization on the bins
//! of a histogram; the number of components is that of the least Bayesian information criterion (G. Schwarz,
//! *Estimating the dimension of a model*, 1978). Only the nearest image of each wrapped normal is counted, exact to
//! 1e-4 for the deviations allowed here.
//!
//! Cost: O(bins x components) per iteration. Limits: components start at the highest bins, and the result depends on
//! the start; it is the same on every run.

use std::f64::consts::PI;

use super::bins::angle_at;
use crate::geometry::fold_half_turn;
use crate::watch::{Stopped, Watch};

/// Independent observations that the histogram counts for in the criterion (3000 in the accuracy study): the gradients
/// of neighbouring cells are not independent.
const OBSERVATIONS: f64 = 3_000.0;
/// Parameters of a component: mean, deviation, weight.
const PARAMETERS: f64 = 3.0;
/// Most iterations of a fit.
const ITERATIONS: usize = 60;
/// Gain in log-likelihood per observation below which a fit ends.
const MIN_GAIN: f64 = 1e-7;
/// Standard deviation of each component at the start, degrees.
const FIRST_DEVIATION_DEG: f64 = 3.0;
/// Range of the standard deviation, degrees: narrower peaks are artefacts of the pixel grid, wider ones no orientation.
const DEVIATIONS_DEG: [f64; 2] = [0.5, 20.0];
/// Least angle between the means at the start, degrees.
const FIRST_SEPARATION_DEG: f64 = 6.0;
/// Weight of the floor at the start.
const FIRST_FLOOR: f64 = 0.3;
/// Least weight of the floor.
const MIN_FLOOR: f64 = 1e-6;
/// Numbers of components without a better criterion after which the search for their number ends.
const PATIENCE: usize = 2;
/// Deviations from the mean beyond which a density is taken as 0: it is below 1e-15 of the peak there.
const MAX_DEVIATIONS: f64 = 8.5;

/// A weighted wrapped normal distribution; angles in radians.
#[derive(Debug, Clone, Copy, PartialEq)]
struct WrappedNormal {
    mean: f64,
    deviation: f64,
    weight: f64,
}

/// A fitted mixture. The weights of the components and the floor sum to 1.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Mixture {
    components: Vec<WrappedNormal>,
    /// Weight of the uniform distribution.
    floor: f64,
}

impl Mixture {
    /// Fits a histogram of sum 1 over `[-pi/2, pi/2)` with up to `most` components.
    pub(super) fn fit(histogram: &[f64], most: usize, watch: &Watch<'_>) -> Result<Self, Stopped> {
        let uniform = Self { components: Vec::new(), floor: 1.0 };
        let mut best = (criterion(&uniform, uniform.log_likelihood(histogram)), uniform);
        let mut best_count = 0;
        for count in 1..=most {
            watch.check()?;
            let mut mixture = Self::start(histogram, count);
            let likelihood = mixture.maximize(histogram);
            let criterion = criterion(&mixture, likelihood);
            if criterion < best.0 {
                best = (criterion, mixture);
                best_count = count;
            } else if count - best_count >= PATIENCE {
                break;
            }
        }
        Ok(best.1)
    }

    /// Components at the highest bins that are far enough apart.
    fn start(histogram: &[f64], count: usize) -> Self {
        let mut order: Vec<usize> = (0..histogram.len()).collect();
        order.sort_by(|&one, &other| histogram[other].total_cmp(&histogram[one]).then(one.cmp(&other)));
        let mut means: Vec<f64> = Vec::new();
        for angle in order.into_iter().map(|bin| bin_center(bin, histogram.len())) {
            if means.len() == count {
                break;
            }
            if means.iter().all(|mean| fold_half_turn(angle - mean).abs() >= FIRST_SEPARATION_DEG.to_radians()) {
                means.push(angle);
            }
        }
        let weight = (1.0 - FIRST_FLOOR) / means.len().max(1) as f64;
        let deviation = FIRST_DEVIATION_DEG.to_radians();
        let components = means.into_iter().map(|mean| WrappedNormal { mean, deviation, weight }).collect();
        Self { components, floor: FIRST_FLOOR }
    }

    /// Expectation-maximization; returns the log-likelihood per observation.
    fn maximize(&mut self, histogram: &[f64]) -> f64 {
        let mut likelihood = f64::NEG_INFINITY;
        for _ in 0..ITERATIONS {
            let next = self.step(histogram);
            let gain = next - likelihood;
            likelihood = next;
            if gain < MIN_GAIN {
                break;
            }
        }
        likelihood
    }

    /// One iteration; returns the log-likelihood before it.
    fn step(&mut self, histogram: &[f64]) -> f64 {
        let mut sums = vec![[0.0; 3]; self.components.len()];
        let mut parts = vec![(0.0, 0.0); self.components.len()];
        let mut likelihood = 0.0;
        for (bin, &weight) in histogram.iter().enumerate().filter(|&(_, &weight)| weight > 0.0) {
            let angle = bin_center(bin, histogram.len());
            let mut density = self.floor / PI;
            for (part, component) in parts.iter_mut().zip(&self.components) {
                *part = component.density(angle);
                density += part.1;
            }
            likelihood += weight * density.ln();
            for (sums, (distance, part)) in sums.iter_mut().zip(&parts) {
                let responsibility = weight * part / density;
                sums[0] += responsibility;
                sums[1] += responsibility * distance;
                sums[2] += responsibility * distance * distance;
            }
        }
        let [least, most] = DEVIATIONS_DEG.map(f64::to_radians);
        for (component, [weight, first, second]) in self.components.iter_mut().zip(sums) {
            if weight > 0.0 {
                let shift = first / weight;
                component.mean = fold_half_turn(component.mean + shift);
                component.deviation = (second / weight - shift * shift).max(0.0).sqrt().clamp(least, most);
            }
            component.weight = weight;
        }
        let explained: f64 = self.components.iter().map(|component| component.weight).sum();
        self.floor = (1.0 - explained).max(MIN_FLOOR);
        likelihood
    }

    fn log_likelihood(&self, histogram: &[f64]) -> f64 {
        histogram
            .iter()
            .enumerate()
            .filter(|&(_, &weight)| weight > 0.0)
            .map(|(bin, &weight)| weight * self.density(bin_center(bin, histogram.len())).ln())
            .sum()
    }

    fn density(&self, angle: f64) -> f64 {
        self.floor / PI + self.components.iter().map(|component| component.density(angle).1).sum::<f64>()
    }

    /// Probability of each of `bins` bins.
    pub(super) fn per_bin(&self, bins: usize) -> Vec<f64> {
        (0..bins).map(|bin| self.density(bin_center(bin, bins)) * PI / bins as f64).collect()
    }

    /// Weight of the uniform floor.
    pub(super) fn floor(&self) -> f64 {
        self.floor
    }
}

impl WrappedNormal {
    /// Signed angle from the mean, and the weighted density there.
    fn density(&self, angle: f64) -> (f64, f64) {
        // Both angles are folded, so at most one half turn is added. This is the innermost loop.
        let difference = angle - self.mean;
        let distance = if difference.abs() > PI / 2.0 { difference - PI.copysign(difference) } else { difference };
        let scaled = distance / self.deviation;
        let bell = if scaled.abs() < MAX_DEVIATIONS { (-0.5 * scaled * scaled).exp() } else { 0.0 };
        (distance, self.weight * bell / (self.deviation * (2.0 * PI).sqrt()))
    }
}

fn bin_center(bin: usize, bins: usize) -> f64 {
    angle_at(bin as f64, bins)
}

/// Bayesian information criterion; lower is better.
fn criterion(mixture: &Mixture, likelihood: f64) -> f64 {
    -2.0 * OBSERVATIONS * likelihood + PARAMETERS * mixture.components.len() as f64 * OBSERVATIONS.ln()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn histogram(peaks: &[(f64, f64, f64)], floor: f64) -> Vec<f64> {
        let components = peaks.iter().map(|&(mean, deviation, weight)| WrappedNormal {
            mean: mean.to_radians(),
            deviation: deviation.to_radians(),
            weight,
        });
        Mixture { components: components.collect(), floor }.per_bin(900)
    }

    #[test]
    fn a_mixture_is_found_again() {
        let truth = histogram(&[(-89.0, 2.0, 0.5), (20.0, 3.0, 0.3)], 0.2);
        let found = Mixture::fit(&truth, 10, &Watch::unwatched()).unwrap();
        let mut rounded: Vec<(i64, i64, i64)> = found
            .components
            .iter()
            .map(|it| {
                (
                    it.mean.to_degrees().round() as i64,
                    it.deviation.to_degrees().round() as i64,
                    (it.weight * 10.0).round() as i64,
                )
            })
            .collect();
        rounded.sort_unstable();
        assert_eq!(rounded, [(-89, 2, 5), (20, 3, 3)]);
        assert!((found.floor() - 0.2).abs() < 0.02);
    }

    #[test]
    fn an_even_histogram_is_all_floor() {
        let found = Mixture::fit(&[1.0 / 900.0; 900], 10, &Watch::unwatched()).unwrap();
        assert_eq!(found, Mixture { components: vec![], floor: 1.0 });
    }
}
