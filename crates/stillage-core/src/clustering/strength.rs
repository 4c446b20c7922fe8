//! The number of clusters, by prediction strength: the largest number whose clusters in one half of the rows are found
//! again in the other half.
//!
//! Source: R. Tibshirani and G. Walther, *Cluster validation by prediction strength* (2005, doi
//! 10.1198/106186005X59243). Both halves of a sample are clustered. For each cluster of one half, the share of its
//! pairs of rows is counted that the centroids of the other half put together; the strength is the smallest share. The
//! number of clusters is the largest of at least [`STRONG`] strength. Departure: the median over both directions of
//! several halvings is taken, not the mean, since a few outliers spoil some halvings.
//!
//! Compared on 38 maps (26 of offices and flats, 12 of warehouses, three of these generated), thirteen features,
//! z-scores, 2 to 8 clusters:
//!
//! | criterion | numbers found |
//! | --- | --- |
//! | silhouette (to centroids), Calinski-Harabasz, Davies-Bouldin | 2 or 3 on most: open space against narrow space |
//! | bend of the inertia | 3 or 4 on nearly all: it depends on the range, not on the map |
//! | Bayesian information criterion of a mixture | not tried by itself: it counts neighbouring cells as independent |
//! | prediction strength | 2 on 1 map, 3 on 3, 4 on 7, 5 on 10, 6 on 7, 7 on 5, 8 on 5 |
//!
//! For comparison, the number that agrees best with the true places (V-measure): 5, 5, 5, 2 and 10 on five office maps
//! with drawn rooms, hallways and doors; 4, 3 and 7 on three generated warehouses.
//!
//! Cost: for each number and halving, k-means on two halves of [`HALF`] rows. Limits: rows of one map are not
//! independent, so the strength says whether the clusters are stable on this map, not whether another map has them.
//! Where the strength is near the bound, another seed may find another number, usually one more or less.

use super::kmeans::{self, KMeansOptions};
use super::points::{Points, nearest, sample};
use super::random::{shuffled, stream};
use super::report::Candidate;
use crate::watch::{Stage, Stopped, Watch};

/// Least strength of the clusters: the middle of the range 0.8 to 0.9 that the authors recommend.
const STRONG: f64 = 0.85;
/// Rows in a half.
const HALF: usize = 5_000;
/// Number of halvings.
const HALVINGS: u64 = 5;
/// Stream of random numbers of the first halving; samples and restarts have others.
const FIRST_STREAM: u64 = 1 << 32;

/// The strength of every number of clusters from 2 to `most.k`.
pub(super) fn candidates(points: &Points, most: &KMeansOptions, watch: &Watch<'_>) -> Result<Vec<Candidate>, Stopped> {
    let rows = sample(points.len(), 2 * HALF, most.seed);
    // The time of k-means grows with the number of clusters.
    let all: usize = (2..=most.k).sum();
    let steps = watch.steps(Stage::Clustering, all * HALVINGS as usize);
    let silent = watch.silent();
    (2..=most.k)
        .map(|k| {
            let options = KMeansOptions { k, ..*most };
            let mut strengths = Vec::new();
            for halving in 0..HALVINGS {
                let order = shuffled(rows.len(), &mut stream(most.seed, FIRST_STREAM + halving));
                let (one, other) = order.split_at(order.len() / 2);
                let [one, other] = [one, other].map(|half| points.select(half.iter().map(|&index| rows[index])));
                let of_one = kmeans::fit(&one, &options, &silent)?.centroids;
                let of_other = kmeans::fit(&other, &options, &silent)?.centroids;
                strengths.push(strength(&one, &of_one, &of_other));
                strengths.push(strength(&other, &of_other, &of_one));
                (0..k).for_each(|_| steps.count_one());
            }
            strengths.sort_by(f64::total_cmp);
            let middle = strengths.len() / 2;
            Ok(Candidate { k, prediction_strength: f64::midpoint(strengths[middle - 1], strengths[middle]) })
        })
        .collect()
}

/// The largest strong number of clusters; the strongest where none is strong.
pub(super) fn choose(candidates: &[Candidate]) -> usize {
    let strong = candidates.iter().rev().find(|candidate| candidate.prediction_strength >= STRONG);
    let strongest = || {
        candidates.iter().reduce(
            |best, other| {
                if other.prediction_strength > best.prediction_strength { other } else { best }
            },
        )
    };
    strong.or_else(strongest).map_or(1, |candidate| candidate.k)
}

/// The smallest share, over the clusters of points, of pairs that other centroids put together; 1 for a cluster of one
/// row and without centroids.
fn strength(points: &Points, own: &[f32], others: &[f32]) -> f64 {
    if own.is_empty() || others.is_empty() {
        return 1.0;
    }
    let columns = points.columns();
    let (own_count, other_count) = (own.len() / columns.max(1), others.len() / columns.max(1));
    let mut table = vec![0_u64; own_count * other_count];
    for group in 0..points.group_count() {
        let [own, others] = [own, others].map(|centroids| nearest(points.group(group), centroids).labels);
        for slot in 0..points.rows_in(group) {
            table[own[slot] as usize * other_count + others[slot] as usize] += 1;
        }
    }
    let pairs = |rows: u64| (rows * rows.saturating_sub(1)) as f64;
    let share = |row: &[u64]| {
        let all = pairs(row.iter().sum());
        if all > 0.0 { row.iter().map(|&rows| pairs(rows)).sum::<f64>() / all } else { 1.0 }
    };
    table.chunks_exact(other_count.max(1)).map(share).fold(1.0, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clustering::random::uniform;
    use crate::clustering::scaling::RowScaling;
    use crate::spec::Scaling;

    /// Rows around as many corners of a wide polygon.
    fn blobs(corners: usize) -> Points {
        let mut random = stream(3, 0);
        let rows: Vec<f32> = (0..900)
            .flat_map(|row| {
                let angle = (row % corners) as f64 / corners as f64 * std::f64::consts::TAU;
                [angle.cos(), angle.sin()].map(|center| (9.0 * center + uniform(&mut random)) as f32)
            })
            .collect();
        let mut points = Points::default();
        points.refill(&rows, &RowScaling::fit(&rows, 2, Scaling::None), 0..900);
        points
    }

    const OPTIONS: KMeansOptions =
        KMeansOptions { k: 8, restarts: 8, max_iterations: 100, tolerance: 1e-6, fit_rows: 20_000, seed: 7 };

    #[test]
    fn as_many_clusters_as_there_are_blobs() {
        for corners in 2..=7 {
            let found = candidates(&blobs(corners), &OPTIONS, &Watch::unwatched()).expect("nobody stops it");
            assert_eq!(choose(&found), corners, "{found:?}");
        }
    }

    #[test]
    fn without_two_rows_every_number_is_as_good() {
        for rows in [&[][..], &[1.0, 2.0]] {
            let mut points = Points::default();
            points.refill(rows, &RowScaling::fit(rows, 2, Scaling::None), 0..rows.len() / 2);
            let found = candidates(&points, &OPTIONS, &Watch::unwatched()).expect("nobody stops it");
            assert!(found.iter().all(|candidate| candidate.prediction_strength == 1.0));
        }
        assert_eq!(choose(&[]), 1);
    }
}
