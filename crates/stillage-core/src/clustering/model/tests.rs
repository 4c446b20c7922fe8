//! What a model says of rows.

use super::*;
use crate::clustering::{FitOptions, Method, fit};
use crate::spec::{CategoryCount, Covariance, Scaling};
use proptest::prelude::*;

const METHODS: [Method; 3] =
    [Method::KMeans, Method::GaussianMixture(Covariance::Diagonal), Method::GaussianMixture(Covariance::Full)];

fn fitted(rows: &[f32], columns: usize, k: usize, method: Method) -> PlaceModel {
    let options = FitOptions {
        method,
        count: CategoryCount::Fixed(k),
        max_count: 8,
        scaling: Scaling::ZScore,
        restarts: 4,
        max_iterations: 100,
        tolerance: 1e-6,
        fit_rows: 20_000,
        seed: 1,
    };
    fit(rows, columns, &options, &Watch::unwatched()).expect("nobody stops it").0
}

#[test]
fn clusters_are_numbered_by_their_first_column() {
    let rows = [7.0, 0.0, 7.5, 0.0, 1.0, 5.0, 1.5, 5.0, 4.0, 9.0, 4.5, 9.0];
    for method in [Method::KMeans, Method::GaussianMixture(Covariance::Diagonal)] {
        let model = fitted(&rows, 2, 3, method);
        let mut labels = [9; 6];
        model.assign(&rows, &mut labels);
        assert_eq!(labels, [2, 2, 0, 0, 1, 1], "{method:?}");
    }
}

#[test]
fn a_row_between_two_centroids_belongs_to_both() {
    let rows = [0.0, 1.0, 10.0, 11.0];
    let model = fitted(&rows, 1, 2, Method::KMeans);
    let shares = |value: f32| {
        let mut shares = [0.0; 2];
        model.memberships(&[value], &mut [0], &mut shares);
        shares.map(|share| (share * 100.0).round())
    };
    // Half a unit of deviation on either side of 0.5 and 10.5.
    assert_eq!(
        [shares(0.0), shares(5.5), shares(5.52), shares(11.0)],
        [[100.0, 0.0], [50.0, 50.0], [31.0, 69.0], [0.0, 100.0]]
    );
}

#[test]
fn a_model_of_nothing_says_nothing() {
    for method in METHODS {
        let model = fitted(&[], 2, 3, method);
        assert!(model.is_empty());
        model.assign(&[], &mut []);
        let mut labels = [7];
        model.memberships(&[1.0, 2.0], &mut labels, &mut []);
        assert_eq!(labels, [0]);
    }
}

#[test]
fn without_spread_the_nearest_has_it_all() {
    let model = fitted(&[1.0, 1.0, 3.0, 3.0], 1, 2, Method::KMeans);
    let mut shares = [0.0; 6];
    model.memberships(&[1.0, 1.9, 2.1], &mut [0; 3], &mut shares);
    assert_eq!(shares, [1.0, 0.0, 1.0, 0.0, 0.0, 1.0]);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn blocks_of_any_size_give_the_same_distributions(
        rows in proptest::collection::vec(-9.0_f32..9.0, 2..900),
        k in 1_usize..7,
        block in 1_usize..400,
        method in proptest::sample::select(&METHODS),
    ) {
        let rows = &rows[..rows.len() / 2 * 2];
        let (model, count) = (fitted(rows, 2, k, method), rows.len() / 2);
        let clusters = model.len();
        prop_assert!((1..=k).contains(&clusters));
        let (mut labels, mut shares) = (vec![0; count], vec![0.0; count * clusters]);
        model.memberships(rows, &mut labels, &mut shares);
        for (first, part) in rows.chunks(2 * block).enumerate().map(|(index, part)| (index * block, part)) {
            let (mut again, mut plain) = (vec![0; part.len() / 2], vec![0; part.len() / 2]);
            let mut part_shares = vec![0.0; again.len() * clusters];
            model.memberships(part, &mut again, &mut part_shares);
            model.assign(part, &mut plain);
            prop_assert_eq!(&again, &labels[first..first + again.len()]);
            prop_assert_eq!(&again, &plain);
            prop_assert_eq!(&part_shares, &shares[first * clusters..(first + again.len()) * clusters]);
        }
        for (row, &label) in shares.chunks_exact(clusters).zip(&labels) {
            prop_assert!((row.iter().sum::<f32>() - 1.0).abs() < 1e-5);
            prop_assert!(row.iter().all(|share| (0.0..=row[usize::from(label)]).contains(share)));
        }
    }
}
