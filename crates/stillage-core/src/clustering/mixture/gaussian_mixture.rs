//! A fitted mixture and the memberships of rows in it.

use serde::{Deserialize, Serialize};

use super::component::NormalComponent;
use crate::clustering::points::SIMD_WIDTH;

/// A sum of weighted normal distributions over scaled rows.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GaussianMixture {
    pub(super) components: Vec<NormalComponent>,
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
    pub(in crate::clustering) fn reordered(&self, order: &[usize]) -> Self {
        let total: f64 = order.iter().map(|&component| self.components[component].weight).sum();
        let chosen = order.iter().map(|&component| {
            let NormalComponent { weight, mean, whitening, .. } = self.components[component].clone();
            NormalComponent::new(weight / total, mean, whitening)
        });
        Self { components: chosen.collect() }
    }

    /// Membership of each row of a group in each component, and the logarithm of the density at each row.
    pub(in crate::clustering) fn memberships(
        &self,
        group: &[[f32; SIMD_WIDTH]],
        scratch: &mut Scratch,
    ) -> [f64; SIMD_WIDTH] {
        scratch.offsets.resize(group.len(), [0.0; SIMD_WIDTH]);
        scratch.memberships.clear();
        let log_densities = self.components.iter().map(|part| part.log_densities(group, &mut scratch.offsets));
        scratch.memberships.extend(log_densities);
        normalize(&mut scratch.memberships)
    }
}

/// Working memory for the memberships of a group.
#[derive(Debug, Default)]
pub(in crate::clustering) struct Scratch {
    pub(super) offsets: Vec<[f64; SIMD_WIDTH]>,
    /// By component, the memberships of the rows.
    pub memberships: Vec<[f64; SIMD_WIDTH]>,
}

/// Turns logarithms of weighted densities into shares; gives the logarithm of their sum.
pub(in crate::clustering) fn normalize(log_densities: &mut [[f64; SIMD_WIDTH]]) -> [f64; SIMD_WIDTH] {
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
