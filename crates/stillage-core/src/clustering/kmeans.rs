//! k-means: seeded k-means++ with restarts, then Lloyd's iterations.
//!
//! Sources: S. Lloyd 1982 (doi 10.1109/TIT.1982.1056489); D. Arthur and S. Vassilvitskii, *k-means++* (SODA 2007), with
//! the greedy choice among several candidates that its authors propose and scikit-learn makes.
//!
//! Restarts run on a small sample; the one that fits the whole sample best is continued there. Where there are fewer
//! distinct rows than clusters, there are fewer clusters; a cluster that loses its last row takes the row farthest from
//! its own centroid.
//!
//! Deterministic: random numbers come from the seed alone, sums are taken over fixed blocks of rows and combined in
//! order, ties go to the lower number.
//!
//! Cost: O(iterations x sample x k x columns). Limits: 255 clusters; a local optimum, within 1 % of the best of twenty
//! runs of scikit-learn on rows of real maps (see the tests).

use std::ops::Range;

use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use super::points::{GROUPS_PER_BLOCK, Points, SIMD_WIDTH, nearest, sample, squared_distances};
use super::random::{below, draw, stream, uniform};
use super::scaling::RowScaling;
use crate::spec::Scaling;
use crate::watch::{Stage, Stopped, Watch};

/// Restarts are compared on a sample of so many times fewer rows.
const COMPARISON_DIVISOR: usize = 10;

/// Share of the time of a fit after which the restarts are run. No measurement is recorded for this value.
const RESTARTS_DONE: f64 = 0.4;

/// Share of the time of a fit after which the restarts are compared on the whole sample. No measurement is recorded for
/// this value.
const COMPARISON_DONE: f64 = 0.7;

/// How to look for centroids.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KMeansOptions {
    /// Number of clusters, 1 to 255.
    pub k: usize,
    /// Restarts; the best one is kept.
    pub restarts: usize,
    /// Most iterations of one run.
    pub max_iterations: usize,
    /// A run ends when the centroids move by less: sum of their squared moves, over the mean variance of the columns.
    pub tolerance: f64,
    /// Most rows that centroids are fitted to.
    pub fit_rows: usize,
    /// Seed of the samples and of the first centroids.
    pub seed: u64,
}

/// Finds clusters of rows as they are, `columns` numbers each, and gives the cluster of each row.
///
/// # Errors
/// [`Stopped`] when the watch says so.
///
/// # Panics
/// When `k` is 0 or above 255, or the values are not whole rows.
pub fn k_means(rows: &[f32], columns: usize, options: &KMeansOptions, watch: &Watch<'_>) -> Result<Vec<u8>, Stopped> {
    let scaling = RowScaling::fit(rows, columns, Scaling::None);
    let mut points = Points::default();
    points.refill(rows, &scaling, sample(rows.len() / columns, options.fit_rows, options.seed).into_iter());
    let centroids = fit(&points, options, &watch.silent())?.centroids;
    points.refill(rows, &scaling, 0..rows.len() / columns);
    let labels = |group| nearest(points.group(group), &centroids).labels.into_iter().take(points.rows_in(group));
    Ok((0..points.group_count()).flat_map(labels).map(|label| label as u8).collect())
}

/// Centroids and how well they fit.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct KMeansRun {
    /// One row each, scaled as the points are: `k`, or fewer where there are fewer distinct points.
    pub centroids: Vec<f32>,
    /// Sum over the points of the squared distance to their centroid.
    pub inertia: f64,
}

/// Finds the centroids of points. Reports its progress as that of [`Stage::Clustering`].
pub(super) fn fit(points: &Points, options: &KMeansOptions, watch: &Watch<'_>) -> Result<KMeansRun, Stopped> {
    assert!((1..=255).contains(&options.k), "clusters are numbered by a byte");
    if points.len() == 0 {
        return Ok(KMeansRun { centroids: Vec::new(), inertia: 0.0 });
    }
    // Restarts run on a smaller sample where there are more rows than it holds.
    let few = options.fit_rows / COMPARISON_DIVISOR;
    let smaller = (points.len() > few).then(|| points.select(sample(points.len(), few, options.seed).into_iter()));
    let restarts = options.restarts.max(1);
    let (run_done, comparison_done) = if smaller.is_some() { (RESTARTS_DONE, COMPARISON_DONE) } else { (1.0, 1.0) };
    let steps = watch.part(0.0, run_done).steps(Stage::Clustering, restarts);
    let runs: Result<Vec<KMeansRun>, Stopped> = (0..restarts)
        .into_par_iter()
        .map(|restart| {
            let mut random = stream(options.seed, restart as u64);
            let points = smaller.as_ref().unwrap_or(points);
            // Greedy starts are usually better, plain ones differ more: the restarts use both in turn.
            let candidates = if restart % 2 == 0 { greedy_candidates(options.k) } else { 1 };
            let run = lloyd(points, first_centroids(points, options.k, candidates, &mut random), options, watch)?;
            steps.count_one();
            Ok(run)
        })
        .collect();
    let mut runs = runs?;
    if smaller.is_some() {
        let steps = watch.part(run_done, comparison_done).steps(Stage::Clustering, restarts);
        for run in &mut runs {
            run.inertia = cluster_sums(points, &run.centroids, watch)?.inertia;
            steps.count_one();
        }
    }
    let best = runs.into_iter().reduce(|best, run| if run.inertia < best.inertia { run } else { best });
    let best = best.expect("there is at least one restart");
    if smaller.is_some() { lloyd(points, best.centroids, options, watch) } else { Ok(best) }
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

    fn add_group(&mut self, points: &Points, group: usize, centroids: &[f32]) {
        let (columns, rows) = (points.columns(), points.rows_in(group));
        let nearest = nearest(points.group(group), centroids);
        self.inertia += nearest.inertia(rows);
        for (slot, &label) in nearest.labels[..rows].iter().enumerate() {
            let label = label as usize;
            self.counts[label] += 1;
            let cluster = &mut self.sums[label * columns..(label + 1) * columns];
            for (sum, values) in cluster.iter_mut().zip(points.group(group)) {
                *sum += f64::from(values[slot]);
            }
        }
    }
}

/// Sums the rows by their nearest centroid.
fn cluster_sums(points: &Points, centroids: &[f32], watch: &Watch<'_>) -> Result<ClusterSums, Stopped> {
    let empty = || ClusterSums::new(centroids.len() / points.columns(), points.columns());
    let groups: Vec<usize> = (0..points.group_count()).collect();
    let blocks: Result<Vec<ClusterSums>, Stopped> = groups
        .par_chunks(GROUPS_PER_BLOCK)
        .map(|groups| {
            watch.check()?;
            let mut sums = empty();
            for &group in groups {
                sums.add_group(points, group, centroids);
            }
            Ok(sums)
        })
        .collect();
    Ok(blocks?.iter().fold(empty(), |mut total, block| {
        total.add(block);
        total
    }))
}

/// Candidates for each further first centroid, as many as in scikit-learn.
fn greedy_candidates(k: usize) -> usize {
    2 + (k as f64).ln() as usize
}

/// k-means++: each further centroid is a row drawn with a probability in proportion to its squared distance to the
/// nearest one so far; of several such rows the one that leaves the least inertia. Ends early when every row is a
/// centroid.
fn first_centroids(points: &Points, k: usize, candidates: usize, random: &mut ChaCha8Rng) -> Vec<f32> {
    let mut centroids: Vec<f32> = points.row(below(points.len(), random)).collect();
    let mut distances = vec![f32::INFINITY; points.len()];
    let mut total = lower_distances(points, &centroids, &mut distances);
    while centroids.len() < k * points.columns() && total > 0.0 {
        let tries = (0..candidates).map(|_| {
            let candidate: Vec<f32> = points.row(draw(&distances, uniform(random) * total)).collect();
            let mut distances = distances.clone();
            let total = lower_distances(points, &candidate, &mut distances);
            (total, candidate, distances)
        });
        let best = tries.reduce(|best, other| if other.0 < best.0 { other } else { best });
        let (left, candidate, nearer) = best.expect("there is at least one candidate");
        centroids.extend(candidate);
        (total, distances) = (left, nearer);
    }
    centroids
}

/// Lowers the squared distances to the nearest centroid to those to a new one; gives their sum.
fn lower_distances(points: &Points, centroid: &[f32], distances: &mut [f32]) -> f64 {
    let mut total = 0.0;
    for (group, distances) in distances.chunks_mut(SIMD_WIDTH).enumerate() {
        let news = squared_distances(points.group(group), centroid);
        for (distance, new) in distances.iter_mut().zip(news) {
            *distance = distance.min(new);
            total += f64::from(*distance);
        }
    }
    total
}

/// Moves centroids to the means of their rows until they move less than the tolerance.
fn lloyd(
    points: &Points,
    mut centroids: Vec<f32>,
    options: &KMeansOptions,
    watch: &Watch<'_>,
) -> Result<KMeansRun, Stopped> {
    let variances = points.variances();
    let least_move = options.tolerance * variances.iter().sum::<f64>() / variances.len() as f64;
    for _ in 0..options.max_iterations {
        let sums = cluster_sums(points, &centroids, watch)?;
        let moved = move_centroids(points, &mut centroids, &sums);
        if moved <= least_move && !sums.counts.contains(&0) {
            break;
        }
    }
    let inertia = cluster_sums(points, &centroids, watch)?.inertia;
    Ok(KMeansRun { centroids, inertia })
}

/// Moves each centroid to the mean of its rows, and one without rows to the row that is farthest from its centroid.
/// Gives the sum of the squared moves of those with rows.
fn move_centroids(points: &Points, centroids: &mut [f32], sums: &ClusterSums) -> f64 {
    let mut moved = 0.0;
    let clusters = || centroid_ranges(&sums.counts, points.columns());
    for (range, count) in clusters().filter(|&(_, count)| count > 0) {
        for (center, sum) in centroids[range.clone()].iter_mut().zip(&sums.sums[range]) {
            let mean = sum / count as f64;
            moved += (mean - f64::from(*center)).powi(2);
            *center = mean as f32;
        }
    }
    for (range, _) in clusters().filter(|&(_, count)| count == 0) {
        let farthest: Vec<f32> = points.row(farthest(points, centroids)).collect();
        centroids[range].copy_from_slice(&farthest);
    }
    moved
}

/// The row farthest from its nearest centroid, the first of equals.
fn farthest(points: &Points, centroids: &[f32]) -> usize {
    let mut farthest = (0, -1.0);
    for group in 0..points.group_count() {
        let distances = nearest(points.group(group), centroids).squared_distances;
        for (slot, &distance) in distances[..points.rows_in(group)].iter().enumerate() {
            if distance > farthest.1 {
                farthest = (group * SIMD_WIDTH + slot, distance);
            }
        }
    }
    farthest.0
}

/// Where the numbers of each centroid are, and how many rows it has.
fn centroid_ranges(counts: &[usize], columns: usize) -> impl Iterator<Item = (Range<usize>, usize)> {
    counts.iter().enumerate().map(move |(cluster, &count)| (cluster * columns..(cluster + 1) * columns, count))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clustering::points::rows_of;
    use proptest::prelude::*;

    const OPTIONS: KMeansOptions =
        KMeansOptions { k: 3, restarts: 4, max_iterations: 100, tolerance: 1e-6, fit_rows: 20_000, seed: 7 };

    fn clusters(values: &[f32], columns: usize, options: &KMeansOptions) -> KMeansRun {
        fit(&rows_of(values, columns), options, &Watch::unwatched()).expect("nobody stops it")
    }

    /// Points around (0, 0), (10, 0) and (0, 10), by turns.
    fn blobs(count: usize) -> Vec<f32> {
        let mut random = stream(1, 0);
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
        let labels = k_means(&blobs(30_000), 2, &OPTIONS, &Watch::unwatched()).expect("nobody stops it");
        let first = [labels[0], labels[1], labels[2]];
        assert!(first[0] != first[1] && first[1] != first[2] && first[0] != first[2]);
        assert!(labels.chunks_exact(3).all(|labels| labels == first));
        // Two coordinates with the variance 1/12 of a unit interval.
        let found = clusters(&blobs(30_000), 2, &OPTIONS);
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
        assert_eq!((found.centroids.len(), found.inertia), (2, 0.0));
        assert_eq!(clusters(&[4.0], 1, &OPTIONS).centroids, [4.0]);
        assert!(clusters(&[], 1, &OPTIONS).centroids.is_empty());
        assert!(k_means(&[], 1, &OPTIONS, &Watch::unwatched()).expect("nobody stops it").is_empty());
    }

    #[test]
    fn a_cluster_without_rows_takes_the_farthest_row() {
        let points = rows_of(&[0.0, 1.0, 2.0, 50.0], 1);
        let run = lloyd(&points, vec![0.0, 1_000.0], &OPTIONS, &Watch::unwatched()).expect("nobody stops it");
        assert_eq!(run.centroids, [1.0, 50.0]);
    }

    proptest! {
        #[test]
        fn every_row_is_with_its_nearest_centroid(
            values in proptest::collection::vec(-9.0_f32..9.0, 1..80),
            k in 1_usize..9,
        ) {
            let options = KMeansOptions { k, ..OPTIONS };
            let labels = k_means(&values, 1, &options, &Watch::unwatched()).expect("nobody stops it");
            let centroids = clusters(&values, 1, &options).centroids;
            let distance = |value: f32, label: usize| (value - centroids[label]).powi(2);
            for (&value, &label) in values.iter().zip(&labels) {
                let nearest = (0..centroids.len()).map(|label| distance(value, label)).fold(f32::INFINITY, f32::min);
                prop_assert_eq!(distance(value, usize::from(label)), nearest);
            }
            prop_assert!(centroids.len() <= k);
            prop_assert!((0..centroids.len()).all(|label| labels.contains(&(label as u8))));
        }
    }
}
