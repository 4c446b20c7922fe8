//! The same rows clustered by scikit-learn 1.9.1: `KMeans(k, n_init=20, tol=1e-6)` and `GaussianMixture(k, tol=1e-4,
//! reg_covar=1e-2)`, the best of five seeds, on z-scored rows, all else as it comes. Inertia must agree within 1 %; the
//! mean log-likelihood of a row may be better.

use super::*;
use crate::features::FeatureSource;
use crate::spec::{CategorizationOptions, CategoryCount, Covariance, Scaling};
use crate::test_maps;
use crate::vectors::Vectors;
use crate::watch::Watch;

const ROWS: usize = 2_000;
const COLUMNS: usize = 13;

/// A number in `[0, 1)` that any language computes alike: the top 24 bits of `splitmix64`.
fn noise(index: u64) -> f64 {
    let mut bits = index.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((bits ^ (bits >> 31)) >> 40) as f64 / f64::from(1 << 24)
}

/// Six blobs of unequal size and spread; the last columns follow the first.
fn rows() -> Vec<f32> {
    let mut rows = Vec::new();
    for row in 0..ROWS {
        let blob = [0, 0, 0, 1, 1, 2, 2, 3, 4, 5][row % 10];
        let mut first = 0.0;
        for column in 0..COLUMNS {
            let index = (row * COLUMNS + column) as u64;
            let center = 3.0 * noise((1 << 32) + (blob * COLUMNS + column) as u64);
            let bell = noise(4 * index + 1) + noise(4 * index + 2) + noise(4 * index + 3) - 1.5;
            let spread = 0.5 + 0.25 * blob as f64;
            let value = center + spread * bell + if column >= 9 { 0.5 * first } else { 0.0 };
            if column == 0 {
                first = value;
            }
            rows.push(value as f32);
        }
    }
    rows
}

fn report(rows: &[f32], k: usize, method: Method) -> FitReport {
    let options = FitOptions {
        method,
        count: CategoryCount::Fixed(k),
        max_count: 8,
        scaling: Scaling::ZScore,
        restarts: CategorizationOptions::default().restarts,
        max_iterations: 300,
        tolerance: 1e-6,
        fit_rows: 200_000,
        seed: 1,
    };
    fit(rows, COLUMNS, &options, &Watch::unwatched()).expect("nobody stops it").1
}

fn assert_near(found: f64, reference: f64, what: &str) {
    let difference = (found - reference) / reference.abs();
    println!("{what}: {found:.4}, scikit-learn {reference:.4}, {:+.3} %", 100.0 * difference);
    assert!(difference.abs() < 0.01, "{what}: {found} instead of {reference}");
}

/// A mixture has many local optima: a better one than the reference is welcome.
fn assert_as_likely(found: f64, reference: f64, what: &str) {
    println!("{what}: {found:.4}, scikit-learn {reference:.4}");
    assert!(found >= reference - 0.01 * reference.abs(), "{what}: {found} instead of {reference}");
}

#[test]
fn the_inertia_of_blobs_is_that_of_scikit_learn() {
    let references = [20049.5, 16054.1, 14235.1, 12604.2, 11096.0, 10706.1, 10432.5];
    for (k, reference) in (2..).zip(references) {
        let found = report(&rows(), k, Method::KMeans).mean_squared_distance;
        assert_near(found * ROWS as f64, reference, &format!("k = {k}"));
    }
}

#[test]
fn the_likelihood_of_mixtures_of_blobs_is_that_of_scikit_learn() {
    for (covariance, references) in
        [(Covariance::Diagonal, [-18.4465, -12.0893, -11.7263]), (Covariance::Full, [-15.7993, -11.2869, -11.1576])]
    {
        for (k, reference) in [1, 5, 6].into_iter().zip(references) {
            let found = report(&rows(), k, Method::GaussianMixture(covariance)).mixture.expect("there is one");
            assert_as_likely(found.log_likelihood, reference, &format!("k = {k}, {covariance:?}"));
            if k == 1 {
                assert_near(found.log_likelihood, reference, "one component, where there is but one answer");
            }
        }
    }
}

/// Thirteen features of every fourth free cell of a real warehouse: heavy tails, columns that go together.
#[test]
fn the_inertia_of_real_features_is_that_of_scikit_learn() {
    let Some(grid) = test_maps::real("warehouse__tuw_warehouse_grid", 0.066_667) else { return };
    let options = CategorizationOptions { stride: 4, ..CategorizationOptions::default() };
    let watch = Watch::unwatched();
    let source = FeatureSource::new(&grid, &options, Vectors::widest(), &watch).expect("nobody stops it");
    let features = source.all(&watch).expect("nobody stops it");
    let rows = &features.values;
    for (k, reference) in [(2, 5.3007), (5, 2.0311), (8, 1.3382)] {
        let found = report(rows, k, Method::KMeans).mean_squared_distance;
        assert_near(found, reference, &format!("k = {k}, {} rows", features.cells.len()));
    }
    let found = report(rows, 5, Method::GaussianMixture(Covariance::Diagonal)).mixture.expect("there is one");
    assert_as_likely(found.log_likelihood, -1.3246, "k = 5, diagonal");
}
