//! A fitted model: the cluster and the memberships of any row.
//!
//! | model | cluster of a row | its memberships |
//! | --- | --- | --- |
//! | centroids | the nearest centroid | in a mixture of equal weights and one spherical variance: the mean squared distance of the fitted rows to their centroid, over the number of columns |
//! | [`GaussianMixture`] | the greatest membership | in the mixture |
//!
//! Ties go to the lower cluster. Correlated columns make the memberships of centroids too certain; full covariances do
//! not have that defect.
//!
//! Cost: O(k x columns) per row, x columns again for full covariances. Limits: 255 clusters.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::mixture::{GaussianMixture, Scratch, normalize};
use super::points::{GROUPS_PER_BLOCK, Points, SIMD_WIDTH, nearest, squared_distances};
use super::scaling::RowScaling;
use crate::watch::{Stopped, Watch};

/// Rows that are scaled before they are compared, so that their values stay in the first-level cache.
const ROWS_PER_STEP: usize = 16 * SIMD_WIDTH;

/// Clusters of places as a function of their features.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PlaceModel {
    scaling: RowScaling,
    clusters: Clusters,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
enum Clusters {
    Centroids {
        /// One scaled row each.
        values: Vec<f32>,
        /// Variance of the spherical components behind the memberships.
        variance: f64,
    },
    Mixture(GaussianMixture),
}

impl PlaceModel {
    pub(super) fn centroids(scaling: RowScaling, values: Vec<f32>, mean_squared_distance: f64) -> Self {
        let variance = mean_squared_distance / scaling.columns() as f64;
        Self { scaling, clusters: Clusters::Centroids { values, variance } }
    }

    pub(super) fn mixture(scaling: RowScaling, mixture: GaussianMixture) -> Self {
        Self { scaling, clusters: Clusters::Mixture(mixture) }
    }

    /// Number of clusters.
    #[must_use]
    pub fn len(&self) -> usize {
        match &self.clusters {
            Clusters::Centroids { values, .. } => values.len() / self.columns(),
            Clusters::Mixture(mixture) => mixture.len(),
        }
    }

    /// Whether there are no clusters, because it was fitted to no rows.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Values per row.
    #[must_use]
    pub fn columns(&self) -> usize {
        self.scaling.columns()
    }

    /// The cluster of each row of a block. Rows are as they were measured, not scaled.
    ///
    /// # Panics
    /// When there are not as many labels as rows.
    pub fn assign(&self, rows: &[f32], labels: &mut [u8]) {
        self.walk(rows, labels, |_, _, _| ());
    }

    /// The cluster of each row of a block, and its membership in every cluster: [`PlaceModel::len`] numbers of sum 1
    /// for each row, the greatest of which is that of its cluster.
    ///
    /// # Panics
    /// When there are not as many labels as rows, or not as many memberships as rows times clusters.
    pub fn memberships(&self, rows: &[f32], labels: &mut [u8], memberships: &mut [f32]) {
        let clusters = self.len();
        assert_eq!(memberships.len(), labels.len() * clusters, "there is a number for each row and cluster");
        self.walk(rows, labels, |first, group, scratch| {
            if let Clusters::Centroids { values, variance } = &self.clusters {
                spherical_memberships(group, values, *variance, scratch);
            }
            let rows = memberships[first * clusters..].chunks_exact_mut(clusters.max(1)).take(SIMD_WIDTH);
            for (slot, row) in rows.enumerate() {
                for (membership, of_cluster) in row.iter_mut().zip(&scratch.memberships) {
                    *membership = of_cluster[slot] as f32;
                }
            }
        });
    }

    /// Labels rows group by group, and calls `show` with the first row of each group, its scaled rows, and the scratch.
    fn walk(&self, rows: &[f32], labels: &mut [u8], mut show: impl FnMut(usize, &[[f32; SIMD_WIDTH]], &mut Scratch)) {
        assert_eq!(rows.len(), labels.len() * self.columns(), "there is a label for each row");
        let mut points = Points::default();
        let mut scratch = Scratch::default();
        let mut first = 0;
        let steps = rows.chunks(ROWS_PER_STEP * self.columns()).zip(labels.chunks_mut(ROWS_PER_STEP));
        for (rows, labels) in steps {
            points.refill(rows, &self.scaling, 0..labels.len());
            for (group, labels) in labels.chunks_mut(SIMD_WIDTH).enumerate() {
                let found = self.labels(points.group(group), &mut scratch);
                labels.iter_mut().zip(found).for_each(|(label, found)| *label = found as u8);
                show(first, points.group(group), &mut scratch);
                first += labels.len();
            }
        }
    }

    /// The clusters of a group of scaled rows; the memberships of a mixture are left in the scratch.
    fn labels(&self, group: &[[f32; SIMD_WIDTH]], scratch: &mut Scratch) -> [u32; SIMD_WIDTH] {
        match &self.clusters {
            Clusters::Centroids { values, .. } => nearest(group, values).labels,
            Clusters::Mixture(mixture) => {
                mixture.memberships(group, scratch);
                greatest(&scratch.memberships)
            }
        }
    }

    /// Numbers the clusters by the mean of `first` over the points they were fitted to, and drops those without points.
    pub(super) fn number(
        &mut self,
        points: &Points,
        first: impl Fn(usize) -> f32,
        watch: &Watch<'_>,
    ) -> Result<(), Stopped> {
        let groups: Vec<usize> = (0..points.group_count()).collect();
        let labels: Result<Vec<Vec<[u32; SIMD_WIDTH]>>, Stopped> = groups
            .par_chunks(GROUPS_PER_BLOCK)
            .map(|groups| {
                watch.check()?;
                let mut scratch = Scratch::default();
                Ok(groups.iter().map(|&group| self.labels(points.group(group), &mut scratch)).collect())
            })
            .collect();
        let mut sums = vec![(0.0, 0_usize); self.len()];
        for (point, &label) in labels?.iter().flatten().flatten().take(points.len()).enumerate() {
            let (sum, count) = &mut sums[label as usize];
            *sum += f64::from(first(point));
            *count += 1;
        }
        let mean = |cluster: usize| sums[cluster].0 / sums[cluster].1 as f64;
        let mut order: Vec<usize> = (0..sums.len()).filter(|&cluster| sums[cluster].1 > 0).collect();
        order.sort_by(|&one, &other| mean(one).total_cmp(&mean(other)));
        self.reorder(&order);
        Ok(())
    }

    fn reorder(&mut self, order: &[usize]) {
        let columns = self.columns();
        match &mut self.clusters {
            Clusters::Centroids { values, .. } => {
                let row = |&cluster: &usize| values[cluster * columns..(cluster + 1) * columns].to_vec();
                *values = order.iter().flat_map(row).collect();
            }
            Clusters::Mixture(mixture) => *mixture = mixture.reordered(order),
        }
    }
}

/// The greatest membership of each row, the first of equals.
fn greatest(memberships: &[[f64; SIMD_WIDTH]]) -> [u32; SIMD_WIDTH] {
    let mut labels = [0; SIMD_WIDTH];
    let mut largest = [f64::NEG_INFINITY; SIMD_WIDTH];
    for (label, memberships) in memberships.iter().enumerate() {
        for slot in 0..SIMD_WIDTH {
            let greater = memberships[slot] > largest[slot];
            largest[slot] = if greater { memberships[slot] } else { largest[slot] };
            labels[slot] = if greater { label as u32 } else { labels[slot] };
        }
    }
    labels
}

/// Memberships of a group in spherical components of equal weight around the centroids.
fn spherical_memberships(group: &[[f32; SIMD_WIDTH]], centroids: &[f32], variance: f64, scratch: &mut Scratch) {
    // Without variance the membership in the nearest centroid is 1.
    let precision = variance.max(f64::MIN_POSITIVE).recip();
    let least = nearest(group, centroids).squared_distances;
    let exponents = centroids.chunks_exact(group.len()).map(|centroid| {
        let squares = squared_distances(group, centroid);
        std::array::from_fn(|slot| -0.5 * precision * f64::from(squares[slot] - least[slot]).max(0.0))
    });
    scratch.memberships.clear();
    scratch.memberships.extend(exponents);
    normalize(&mut scratch.memberships);
}

#[cfg(test)]
mod tests;
