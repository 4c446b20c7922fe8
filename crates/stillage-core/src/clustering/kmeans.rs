//! k-means: seeded k-means++ with restarts, Lloyd's iterations, on a sample where there are many rows.
//!
//! Sources: S. Lloyd 1982 (doi 10.1109/TIT.1982.1056489); D. Arthur and S. Vassilvitskii, *k-means++* (SODA 2007).
//!
//! Where there are many rows, restarts compete on a small sample, the best one is finished on a larger one, and all
//! rows are then given to the nearest centroid. A sample holds one row, drawn by the seed, of each of as many equal
//! stretches. Where there are fewer distinct rows than clusters, there are fewer clusters; a cluster that loses its
//! last row takes the row farthest from its own centroid.
//!
//! Deterministic: random numbers come from the seed alone (`ChaCha`, the same on every machine), sums are taken over
//! fixed blocks of rows and combined in order, ties go to the lower number.
//!
//! Cost: O(iterations x sample x k x columns) and O(rows x k x columns) once. Limits: 255 clusters.

use std::ops::Range;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use rayon::prelude::*;

use super::scaling::ScaledRows;
use crate::watch::{Stopped, Watch};

/// Stream of random numbers that draws the samples; restarts have the streams from 0 on.
const SAMPLE_STREAM: u64 = u64::MAX;

/// Rows that are compared with a centroid at once.
const LANES: usize = 16;
/// Groups of [`LANES`] rows whose sums are taken together.
const GROUPS_PER_BLOCK: usize = 256;

/// How to look for clusters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KMeansOptions {
    /// Number of clusters, 1 to 255.
    pub k: usize,
    /// Restarts, the best one wins.
    pub restarts: usize,
    /// Most iterations of one run.
    pub max_iterations: usize,
    /// A run ends when the centroids move by less: sum of their squared moves, over the mean variance of the columns.
    pub tolerance: f64,
    /// Most rows that centroids are fitted to. Restarts compete on a tenth of that.
    pub fit_rows: usize,
    /// Seed of the samples and of the first centroids.
    pub seed: u64,
}

/// Clusters of rows.
#[derive(Debug, Clone, PartialEq)]
pub struct Clusters {
    /// Cluster of each row.
    pub labels: Vec<u8>,
    /// Centroids, one row each, scaled as the rows are.
    pub centroids: Vec<f32>,
    /// Number of clusters: `k`, or fewer where there are fewer distinct rows.
    pub count: usize,
    /// Sum over all rows of the squared distance to their centroid.
    pub inertia: f64,
}

/// Finds clusters of rows.
///
/// # Errors
/// [`Stopped`] when the watch says so.
///
/// # Panics
/// When `k` is 0 or above 255.
pub fn k_means(rows: &ScaledRows<'_>, options: &KMeansOptions, watch: &Watch<'_>) -> Result<Clusters, Stopped> {
    assert!((1..=255).contains(&options.k), "clusters are numbered by a byte");
    if rows.is_empty() {
        return Ok(Clusters { labels: Vec::new(), centroids: Vec::new(), count: 0, inertia: 0.0 });
    }
    let compete_rows = options.fit_rows / 10;
    let competition = Points::sample(rows, compete_rows, options.seed);
    let runs: Result<Vec<Run>, Stopped> = (0..options.restarts.max(1))
        .into_par_iter()
        .map(|restart| {
            let mut random = ChaCha8Rng::seed_from_u64(options.seed);
            random.set_stream(restart as u64);
            competition.lloyd(competition.first_centroids(options.k, &mut random), options, watch)
        })
        .collect();
    let best = runs?.into_iter().reduce(|best, run| if run.inertia < best.inertia { run } else { best });
    let mut centroids = best.expect("there is at least one restart").centroids;
    if rows.len() > compete_rows {
        let sample = Points::sample(rows, options.fit_rows, options.seed);
        centroids = sample.lloyd(centroids, options, watch)?.centroids;
    }
    assign_all(rows, centroids, watch)
}

/// Gives every row to its nearest centroid.
fn assign_all(rows: &ScaledRows<'_>, centroids: Vec<f32>, watch: &Watch<'_>) -> Result<Clusters, Stopped> {
    let mut labels = vec![0; rows.len()];
    let inertias: Result<Vec<f64>, Stopped> = labels
        .par_chunks_mut(LANES * GROUPS_PER_BLOCK)
        .enumerate()
        .map(|(block, labels)| {
            watch.check()?;
            let first = block * LANES * GROUPS_PER_BLOCK;
            let points = Points::of(rows, first..first + labels.len());
            let mut inertia = 0.0;
            for (group, labels) in labels.chunks_mut(LANES).enumerate() {
                let nearest = points.nearest(group, &centroids);
                labels.copy_from_slice(&nearest.labels[..labels.len()]);
                inertia += nearest.inertia(labels.len());
            }
            Ok(inertia)
        })
        .collect();
    let inertia = inertias?.iter().sum();
    Ok(Clusters { labels, count: centroids.len() / rows.columns(), centroids, inertia })
}

/// Rows in groups of [`LANES`], column by column within a group; the last group is filled up with zeros.
struct Points {
    count: usize,
    columns: usize,
    groups: Vec<[f32; LANES]>,
}

/// The outcome of one run.
struct Run {
    centroids: Vec<f32>,
    inertia: f64,
}

/// The nearest centroids of a group of rows.
struct Nearest {
    labels: [u8; LANES],
    squared_distances: [f32; LANES],
}

impl Nearest {
    /// Sum of the squared distances of the first rows.
    fn inertia(&self, rows: usize) -> f64 {
        self.squared_distances[..rows].iter().map(|&distance| f64::from(distance)).sum()
    }
}

/// Sums of the rows of each cluster.
struct ClusterSums {
    sums: Vec<f64>,
    counts: Vec<usize>,
    inertia: f64,
}

impl ClusterSums {
    fn new(clusters: usize, columns: usize) -> Self {
        Self { sums: vec![0.0; clusters * columns], counts: vec![0; clusters], inertia: 0.0 }
    }

    fn add(&mut self, other: &Self) {
        self.sums.iter_mut().zip(&other.sums).for_each(|(sum, other)| *sum += other);
        self.counts.iter_mut().zip(&other.counts).for_each(|(count, other)| *count += other);
        self.inertia += other.inertia;
    }
}

impl Points {
    /// At most `limit` rows, one of each of as many stretches; all of them where there are no more.
    fn sample(rows: &ScaledRows<'_>, limit: usize, seed: u64) -> Self {
        let count = rows.len().min(limit.max(1));
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(SAMPLE_STREAM);
        Self::collect(rows, count, |index| {
            let (start, end) = (index * rows.len() / count, (index + 1) * rows.len() / count);
            start + below(end - start, &mut random)
        })
    }

    /// Consecutive rows.
    fn of(rows: &ScaledRows<'_>, range: Range<usize>) -> Self {
        Self::collect(rows, range.len(), |index| range.start + index)
    }

    fn collect(rows: &ScaledRows<'_>, count: usize, mut row_of: impl FnMut(usize) -> usize) -> Self {
        let columns = rows.columns();
        let mut groups = vec![[0.0; LANES]; count.div_ceil(LANES) * columns];
        for index in 0..count {
            let group = &mut groups[index / LANES * columns..][..columns];
            for (values, value) in group.iter_mut().zip(rows.row(row_of(index))) {
                values[index % LANES] = value;
            }
        }
        Self { count, columns, groups }
    }

    fn group_count(&self) -> usize {
        self.count.div_ceil(LANES)
    }

    /// Rows in a group.
    fn rows_in(&self, group: usize) -> usize {
        LANES.min(self.count - group * LANES)
    }

    /// The columns of a group.
    fn group(&self, group: usize) -> &[[f32; LANES]] {
        &self.groups[group * self.columns..(group + 1) * self.columns]
    }

    /// One row.
    fn row(&self, row: usize) -> impl Iterator<Item = f32> {
        self.group(row / LANES).iter().map(move |values| values[row % LANES])
    }

    /// Squared distances of a group to a centroid.
    fn squared_distances(&self, group: usize, centroid: &[f32]) -> [f32; LANES] {
        let mut distances = [0.0; LANES];
        for (values, &center) in self.group(group).iter().zip(centroid) {
            for (distance, &value) in distances.iter_mut().zip(values) {
                *distance += (value - center) * (value - center);
            }
        }
        distances
    }

    /// The nearest centroids of a group.
    fn nearest(&self, group: usize, centroids: &[f32]) -> Nearest {
        let mut nearest = Nearest { labels: [0; LANES], squared_distances: [f32::INFINITY; LANES] };
        for (label, centroid) in centroids.chunks_exact(self.columns).enumerate() {
            let distances = self.squared_distances(group, centroid);
            for (lane, &distance) in distances.iter().enumerate() {
                let closer = distance < nearest.squared_distances[lane];
                nearest.squared_distances[lane] = if closer { distance } else { nearest.squared_distances[lane] };
                nearest.labels[lane] = if closer { label as u8 } else { nearest.labels[lane] };
            }
        }
        nearest
    }

    /// k-means++: each further centroid is a row drawn with a probability in proportion to its squared distance to the
    /// nearest one so far. Ends early when every row is a centroid.
    fn first_centroids(&self, k: usize, random: &mut ChaCha8Rng) -> Vec<f32> {
        let mut centroids: Vec<f32> = self.row(below(self.count, random)).collect();
        let mut nearest = vec![f32::INFINITY; self.count];
        while centroids.len() < k * self.columns {
            let newest = &centroids[centroids.len() - self.columns..];
            let mut total = 0.0;
            for (group, nearest) in nearest.chunks_mut(LANES).enumerate() {
                let distances = self.squared_distances(group, newest);
                for (nearest, distance) in nearest.iter_mut().zip(distances) {
                    *nearest = nearest.min(distance);
                    total += f64::from(*nearest);
                }
            }
            if total <= 0.0 {
                break;
            }
            let row = draw(&nearest, uniform(random) * total);
            centroids.extend(self.row(row).collect::<Vec<f32>>());
        }
        centroids
    }

    /// Moves centroids to the means of their rows until they rest.
    fn lloyd(&self, mut centroids: Vec<f32>, options: &KMeansOptions, watch: &Watch<'_>) -> Result<Run, Stopped> {
        let rest = options.tolerance * self.mean_variance();
        for _ in 0..options.max_iterations {
            watch.check()?;
            let sums = self.cluster_sums(&centroids);
            let moved = self.move_centroids(&mut centroids, &sums);
            if moved <= rest && !sums.counts.contains(&0) {
                break;
            }
        }
        let inertia = self.cluster_sums(&centroids).inertia;
        Ok(Run { centroids, inertia })
    }

    /// Mean over the columns of their variance.
    fn mean_variance(&self) -> f64 {
        let count = self.count as f64;
        let variance = |column: usize| {
            let values = || {
                let groups = self.groups.iter().skip(column).step_by(self.columns);
                groups.flatten().take(self.count).map(|&value| f64::from(value))
            };
            let mean = values().sum::<f64>() / count;
            values().map(|value| (value - mean).powi(2)).sum::<f64>() / count
        };
        (0..self.columns).map(variance).sum::<f64>() / self.columns as f64
    }

    /// Sums the rows by their nearest centroid.
    fn cluster_sums(&self, centroids: &[f32]) -> ClusterSums {
        let clusters = centroids.len() / self.columns;
        let groups: Vec<usize> = (0..self.group_count()).collect();
        let blocks: Vec<ClusterSums> = groups
            .par_chunks(GROUPS_PER_BLOCK)
            .map(|groups| {
                let mut sums = ClusterSums::new(clusters, self.columns);
                for &group in groups {
                    self.add_group(group, centroids, &mut sums);
                }
                sums
            })
            .collect();
        blocks.iter().fold(ClusterSums::new(clusters, self.columns), |mut total, block| {
            total.add(block);
            total
        })
    }

    fn add_group(&self, group: usize, centroids: &[f32], sums: &mut ClusterSums) {
        let nearest = self.nearest(group, centroids);
        let rows = self.rows_in(group);
        sums.inertia += nearest.inertia(rows);
        for (lane, &label) in nearest.labels[..rows].iter().enumerate() {
            let label = usize::from(label);
            sums.counts[label] += 1;
            let cluster = &mut sums.sums[label * self.columns..(label + 1) * self.columns];
            for (sum, values) in cluster.iter_mut().zip(self.group(group)) {
                *sum += f64::from(values[lane]);
            }
        }
    }

    /// Moves each centroid to the mean of its rows; one without rows to the row that is farthest from its own. Gives
    /// the sum of the squared moves of the former.
    fn move_centroids(&self, centroids: &mut [f32], sums: &ClusterSums) -> f64 {
        let mut moved = 0.0;
        let clusters = || centroid_ranges(&sums.counts, self.columns);
        for (range, count) in clusters().filter(|&(_, count)| count > 0) {
            for (center, sum) in centroids[range.clone()].iter_mut().zip(&sums.sums[range]) {
                let mean = sum / count as f64;
                moved += (mean - f64::from(*center)).powi(2);
                *center = mean as f32;
            }
        }
        for (range, _) in clusters().filter(|&(_, count)| count == 0) {
            let farthest: Vec<f32> = self.row(self.farthest(centroids)).collect();
            centroids[range].copy_from_slice(&farthest);
        }
        moved
    }

    /// The row farthest from its nearest centroid, the first of equals.
    fn farthest(&self, centroids: &[f32]) -> usize {
        let mut farthest = (0, -1.0);
        for group in 0..self.group_count() {
            let distances = self.nearest(group, centroids).squared_distances;
            for (lane, &distance) in distances[..self.rows_in(group)].iter().enumerate() {
                if distance > farthest.1 {
                    farthest = (group * LANES + lane, distance);
                }
            }
        }
        farthest.0
    }
}

/// Where each centroid is among all, and how many rows it has.
fn centroid_ranges(counts: &[usize], columns: usize) -> impl Iterator<Item = (Range<usize>, usize)> {
    counts.iter().enumerate().map(move |(cluster, &count)| (cluster * columns..(cluster + 1) * columns, count))
}

/// A number in `[0, 1)`.
fn uniform(random: &mut ChaCha8Rng) -> f64 {
    const BITS: u32 = f64::MANTISSA_DIGITS;
    (random.next_u64() >> (u64::BITS - BITS)) as f64 / (1_u64 << BITS) as f64
}

/// A whole number below `end`, which is not 0.
fn below(end: usize, random: &mut ChaCha8Rng) -> usize {
    ((uniform(random) * end as f64) as usize).min(end - 1)
}

/// The first row at which the running sum of weights exceeds `target`; never one without weight.
fn draw(weights: &[f32], target: f64) -> usize {
    let mut sum = 0.0;
    let mut drawn = 0;
    for (row, &weight) in weights.iter().enumerate().filter(|(_, weight)| **weight > 0.0) {
        drawn = row;
        sum += f64::from(weight);
        if sum > target {
            break;
        }
    }
    drawn
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec::Scaling;
    use proptest::prelude::*;

    const OPTIONS: KMeansOptions =
        KMeansOptions { k: 3, restarts: 4, max_iterations: 100, tolerance: 1e-6, fit_rows: 20_000, seed: 7 };

    fn clusters(values: &[f32], columns: usize, options: &KMeansOptions) -> Clusters {
        let rows = ScaledRows::new(values, columns, Scaling::None);
        k_means(&rows, options, &Watch::unwatched()).expect("nobody stops it")
    }

    /// Points around (0, 0), (10, 0) and (0, 10), by turns.
    fn blobs(count: usize) -> Vec<f32> {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        (0..count)
            .flat_map(|row| {
                let center = [[0.0, 0.0], [10.0, 0.0], [0.0, 10.0]][row % 3];
                center.map(|center: f64| (center + uniform(&mut random)) as f32)
            })
            .collect()
    }

    #[test]
    fn separate_blobs_are_told_apart() {
        // More rows than either sample holds.
        let found = clusters(&blobs(30_000), 2, &OPTIONS);
        let first = [found.labels[0], found.labels[1], found.labels[2]];
        assert!(first[0] != first[1] && first[1] != first[2] && first[0] != first[2]);
        assert!(found.labels.chunks_exact(3).all(|labels| labels == first));
        // Two coordinates with the variance 1/12 of a unit interval.
        assert!((found.inertia / 30_000.0 - 1.0 / 6.0).abs() < 2e-3);
    }

    #[test]
    fn any_number_of_threads_gives_the_same_clusters() {
        let values = blobs(9_000);
        let run = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads can be had");
            pool.install(|| clusters(&values, 2, &KMeansOptions { k: 7, ..OPTIONS }))
        };
        let one = run(1);
        assert_eq!(one, run(2));
        assert_eq!(one, run(7));
    }

    #[test]
    fn fewer_distinct_rows_give_fewer_clusters() {
        let found = clusters(&[1.0, 1.0, 2.0, 1.0, 2.0], 1, &OPTIONS);
        assert_eq!((found.count, found.inertia), (2, 0.0));
        assert_eq!(clusters(&[4.0], 1, &OPTIONS).count, 1);
        assert_eq!(clusters(&[], 1, &OPTIONS).count, 0);
    }

    #[test]
    fn a_cluster_without_rows_takes_the_farthest_row() {
        let rows = ScaledRows::new(&[0.0, 1.0, 2.0, 50.0], 1, Scaling::None);
        let points = Points::of(&rows, 0..4);
        let run = points.lloyd(vec![0.0, 1_000.0], &OPTIONS, &Watch::unwatched()).expect("nobody stops it");
        assert_eq!(run.centroids, [1.0, 50.0]);
    }

    proptest! {
        #[test]
        fn every_row_is_with_its_nearest_centroid(
            values in proptest::collection::vec(-9.0_f32..9.0, 1..80),
            k in 1_usize..9,
        ) {
            let found = clusters(&values, 1, &KMeansOptions { k, ..OPTIONS });
            let distance = |value: f32, label: usize| (value - found.centroids[label]).powi(2);
            for (&value, &label) in values.iter().zip(&found.labels) {
                let nearest = (0..found.count).map(|label| distance(value, label)).fold(f32::INFINITY, f32::min);
                prop_assert_eq!(distance(value, usize::from(label)), nearest);
            }
            prop_assert!(found.count <= k);
            prop_assert!((0..found.count).all(|label| found.labels.contains(&(label as u8))));
        }
    }
}
