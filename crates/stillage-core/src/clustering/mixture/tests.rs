//! Mixtures of known rows.

use super::*;
use crate::clustering::points::{Points, rows_of};
use crate::clustering::random::{stream, uniform};
use crate::spec::Covariance;
use crate::watch::Watch;

/// Two stripes along x, rows by turns at y = 0 and y = 3.
fn stripes(count: usize) -> Points {
    let mut random = stream(5, 0);
    let mut bell = || (0..12).map(|_| uniform(&mut random)).sum::<f64>() - 6.0;
    let rows: Vec<f32> = (0..count)
        .flat_map(|row| {
            let across = 3.0 * (row % 2) as f64;
            [(4.0 * bell()) as f32, (across + 0.3 * bell()) as f32]
        })
        .collect();
    rows_of(&rows, 2)
}

fn fitted(points: &Points, centroids: &[f32], covariance: Covariance) -> Fitted {
    fit(points, centroids, covariance, 1e-6, 200, &Watch::unwatched()).expect("nobody stops it")
}

#[test]
fn stripes_are_two_components() {
    let points = stripes(4_000);
    for covariance in [Covariance::Diagonal, Covariance::Full] {
        let found = fitted(&points, &[0.0, 0.0, 0.0, 3.0], covariance);
        let weights = found.mixture.weights();
        assert!(weights.iter().all(|weight| (weight - 0.5).abs() < 0.03), "{weights:?}");
        // Entropy of two separate stripes: that of their normals and of the choice between them.
        let entropy = (4.0_f64 * 0.3).ln() + (std::f64::consts::TAU * std::f64::consts::E).ln() + 2.0_f64.ln();
        assert!((found.log_likelihood + entropy).abs() < 0.03, "{} {entropy}", found.log_likelihood);
    }
}

#[test]
fn slanted_stripes_need_full_covariances() {
    let mut random = stream(6, 0);
    let mut bell = || (0..12).map(|_| uniform(&mut random)).sum::<f64>() - 6.0;
    let rows: Vec<f32> = (0..2_000)
        .flat_map(|_| {
            let (along, across) = (bell(), 0.1 * bell());
            [(along + across) as f32, (along - across) as f32]
        })
        .collect();
    let points = rows_of(&rows, 2);
    let [diagonal, full] =
        [Covariance::Diagonal, Covariance::Full].map(|covariance| fitted(&points, &[0.0; 2], covariance));
    assert!(full.log_likelihood > diagonal.log_likelihood + 1.0);
    assert!(full.criterion(2_000) < diagonal.criterion(2_000));
}

#[test]
fn a_component_without_rows_is_given_up() {
    let points = stripes(600);
    for covariance in [Covariance::Diagonal, Covariance::Full] {
        let found = fitted(&points, &[0.0, 0.0, 900.0, 900.0, 0.1, 0.1], covariance);
        assert_eq!(found.mixture.len(), 2);
        assert!((found.mixture.weights().iter().sum::<f64>() - 1.0).abs() < 1e-12);
    }
}

#[test]
fn equal_rows_are_no_trouble() {
    for covariance in [Covariance::Diagonal, Covariance::Full] {
        for rows in [&[5.0, 5.0][..], &[5.0; 80]] {
            let found = fitted(&rows_of(rows, 2), &[5.0, 5.0], covariance);
            assert_eq!(found.mixture.len(), 1);
            assert!(found.log_likelihood.is_finite());
        }
    }
}

#[test]
fn memberships_far_away_still_sum_to_one() {
    let found = fitted(&stripes(600), &[0.0, 0.0, 0.0, 3.0], Covariance::Full);
    let mut scratch = Scratch::default();
    let log_densities = found.mixture.memberships(rows_of(&[3e7, 1.0], 2).group(0), &mut scratch);
    let sum: f64 = scratch.memberships.iter().map(|numbers| numbers[0]).sum();
    assert!((sum - 1.0).abs() < 1e-12 && log_densities[0].is_finite());
}
