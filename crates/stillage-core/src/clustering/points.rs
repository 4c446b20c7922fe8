//! Scaled rows in the layout of the innermost loops: groups of [`SIMD_WIDTH`] rows, column by column within a group.
//!
//! One value of a centroid is compared with [`SIMD_WIDTH`] rows at once, which the compiler turns into vector
//! instructions. No number depends on the rows in its group, so results are the same for any division into blocks.

use super::random::{below, stream};
use super::scaling::RowScaling;

/// Rows that are compared with a centroid at once: a multiple of every SIMD width.
pub(super) const SIMD_WIDTH: usize = 16;
/// Groups whose sums one task takes.
pub(super) const GROUPS_PER_BLOCK: usize = 256;

/// Stream of random numbers for the samples; restarts have the streams from 0 on.
const SAMPLE_STREAM: u64 = u64::MAX;

/// Scaled rows; the last group is filled up with zeros.
#[derive(Debug, Default)]
pub(super) struct Points {
    count: usize,
    columns: usize,
    groups: Vec<[f32; SIMD_WIDTH]>,
}

/// The nearest centroids of a group of rows.
pub(super) struct NearestCentroids {
    pub labels: [u32; SIMD_WIDTH],
    pub squared_distances: [f32; SIMD_WIDTH],
}

impl NearestCentroids {
    /// Sum of the squared distances of the first rows.
    pub(super) fn inertia(&self, rows: usize) -> f64 {
        self.squared_distances[..rows].iter().map(|&distance| f64::from(distance)).sum()
    }
}

/// At most `limit` of `available` rows, ascending: one drawn at random from each of `limit` equal intervals, or all of
/// them where there are no more.
pub(super) fn sample(available: usize, limit: usize, seed: u64) -> Vec<usize> {
    let count = available.min(limit.max(1));
    let mut random = stream(seed, SAMPLE_STREAM);
    let drawn = (0..count).map(|index| {
        let (start, end) = (index * available / count, (index + 1) * available / count);
        start + below(end - start, &mut random)
    });
    drawn.collect()
}

impl Points {
    /// Replaces the rows by the chosen ones, scaled.
    pub(super) fn refill(&mut self, rows: &[f32], scaling: &RowScaling, chosen: impl ExactSizeIterator<Item = usize>) {
        let columns = scaling.columns();
        self.resize(chosen.len(), columns);
        for (index, row) in chosen.enumerate() {
            let group = &mut self.groups[index / SIMD_WIDTH * columns..][..columns];
            for (values, value) in group.iter_mut().zip(scaling.row(&rows[row * columns..][..columns])) {
                values[index % SIMD_WIDTH] = value;
            }
        }
    }

    /// Some of the rows.
    pub(super) fn select(&self, chosen: impl ExactSizeIterator<Item = usize>) -> Self {
        let mut points = Self::default();
        points.resize(chosen.len(), self.columns);
        for (index, row) in chosen.enumerate() {
            let group = &mut points.groups[index / SIMD_WIDTH * self.columns..][..self.columns];
            for (values, value) in group.iter_mut().zip(self.row(row)) {
                values[index % SIMD_WIDTH] = value;
            }
        }
        points
    }

    fn resize(&mut self, count: usize, columns: usize) {
        self.count = count;
        self.columns = columns;
        self.groups.clear();
        self.groups.resize(count.div_ceil(SIMD_WIDTH) * columns, [0.0; SIMD_WIDTH]);
    }

    /// Number of rows.
    pub(super) fn len(&self) -> usize {
        self.count
    }

    /// Values per row.
    pub(super) fn columns(&self) -> usize {
        self.columns
    }

    pub(super) fn group_count(&self) -> usize {
        self.count.div_ceil(SIMD_WIDTH)
    }

    /// Rows in a group.
    pub(super) fn rows_in(&self, group: usize) -> usize {
        SIMD_WIDTH.min(self.count - group * SIMD_WIDTH)
    }

    /// The columns of a group.
    pub(super) fn group(&self, group: usize) -> &[[f32; SIMD_WIDTH]] {
        &self.groups[group * self.columns..(group + 1) * self.columns]
    }

    /// One row.
    pub(super) fn row(&self, row: usize) -> impl Iterator<Item = f32> {
        self.group(row / SIMD_WIDTH).iter().map(move |values| values[row % SIMD_WIDTH])
    }

    /// Variance of each column.
    pub(super) fn variances(&self) -> Vec<f64> {
        let count = self.count as f64;
        let variance = |column: usize| {
            let values = || {
                let groups = self.groups.iter().skip(column).step_by(self.columns);
                groups.flatten().take(self.count).map(|&value| f64::from(value))
            };
            let mean = values().sum::<f64>() / count;
            values().map(|value| (value - mean).powi(2)).sum::<f64>() / count
        };
        (0..self.columns).map(variance).collect()
    }
}

/// Squared distances of a group to a centroid.
#[inline]
pub(super) fn squared_distances(group: &[[f32; SIMD_WIDTH]], centroid: &[f32]) -> [f32; SIMD_WIDTH] {
    let mut distances = [0.0; SIMD_WIDTH];
    for (values, &center) in group.iter().zip(centroid) {
        for (distance, &value) in distances.iter_mut().zip(values) {
            *distance += (value - center) * (value - center);
        }
    }
    distances
}

/// The nearest centroids of a group, the first of equally near ones.
#[inline]
pub(super) fn nearest(group: &[[f32; SIMD_WIDTH]], centroids: &[f32]) -> NearestCentroids {
    let mut nearest = NearestCentroids { labels: [0; SIMD_WIDTH], squared_distances: [f32::INFINITY; SIMD_WIDTH] };
    for (label, centroid) in centroids.chunks_exact(group.len()).enumerate() {
        let distances = squared_distances(group, centroid);
        for (slot, &distance) in distances.iter().enumerate() {
            let closer = distance < nearest.squared_distances[slot];
            nearest.squared_distances[slot] = if closer { distance } else { nearest.squared_distances[slot] };
            nearest.labels[slot] = if closer { label as u32 } else { nearest.labels[slot] };
        }
    }
    nearest
}

/// Rows as they are, for tests.
#[cfg(test)]
pub(super) fn rows_of(values: &[f32], columns: usize) -> Points {
    let scaling = RowScaling::fit(values, columns, crate::spec::Scaling::None);
    let mut points = Points::default();
    points.refill(values, &scaling, 0..values.len() / columns);
    points
}
