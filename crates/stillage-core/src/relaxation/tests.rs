//! Relaxation of drawn maps: digits are categories, `#` is no measured cell.

use expect_test::{Expect, expect};
use proptest::prelude::*;

use super::*;
use crate::spec::RelaxationOptions;
use crate::watch::Watch;

const CATEGORIES: usize = 3;

/// The measured cells of a picture (first line on top, one line of the grid each), and their categories.
fn read(picture: &str) -> (Vec<u32>, Vec<u8>, usize) {
    let rows: Vec<&str> = picture.lines().map(str::trim).filter(|row| !row.is_empty()).collect();
    let width = rows.iter().map(|row| row.len()).max().unwrap_or(0);
    let symbols = rows.iter().rev().flat_map(|row| row.bytes());
    let measured = symbols.enumerate().filter(|(_, symbol)| symbol.is_ascii_digit());
    let (cells, categories) = measured.map(|(cell, symbol)| (cell as u32, symbol - b'0')).unzip();
    (cells, categories, width)
}

/// Distributions that give each cell's own category a share and the others the rest.
fn memberships(categories: &[u8], own: f32) -> Memberships {
    let mut memberships = Memberships::new(categories.len(), CATEGORIES);
    let shares: Vec<f32> = categories
        .iter()
        .flat_map(|&category| {
            let mut shares = [(1.0 - own) / (CATEGORIES - 1) as f32; CATEGORIES];
            shares[usize::from(category)] = own;
            shares
        })
        .collect();
    Memberships::pack(&shares, memberships.values_mut());
    memberships
}

fn relaxed(picture: &str, own: f32, iterations: usize) -> (Memberships, RelaxationReport) {
    let (cells, categories, width) = read(picture);
    let mut memberships = memberships(&categories, own);
    let lattice = Lattice::new(&cells, width, 1);
    let report = relax_cells(&lattice, &mut memberships, RelaxationOptions { iterations }, &Watch::unwatched())
        .expect("nobody stops it");
    (memberships, report)
}

fn check(picture: &str, own: f32, expected: &Expect) {
    let (memberships, report) = relaxed(picture, own, 10);
    let mut categories = memberships.categories().into_iter();
    let rows: Vec<&str> = picture.lines().map(str::trim).filter(|row| !row.is_empty()).collect();
    let mut lines: Vec<String> = rows
        .iter()
        .rev()
        .map(|row| {
            let symbol = |symbol: char| match symbol {
                '#' => '#',
                _ => char::from(b'0' + categories.next().expect("a digit is a measured cell")),
            };
            row.chars().map(symbol).collect()
        })
        .collect();
    lines.reverse();
    let RelaxationReport { nodes, changed, changed_by_iteration, entropy_before, entropy_after } = report;
    lines.push(format!(
        "{changed} of {nodes} changed {changed_by_iteration:?}, entropy {entropy_before:.2} -> {entropy_after:.2}"
    ));
    expected.assert_eq(&lines.join("\n"));
}

#[test]
fn a_lone_speckle_is_absorbed() {
    check(
        "
        ##################
        #1111111#00000000#
        #1111111#00000000#
        #1111111#00010000#
        #1111111#00000000#
        #1111111#00000000#
        ##################
        ",
        0.9,
        &expect![[r#"
            ##################
            #1111111#00000000#
            #1111111#00000000#
            #1111111#00000000#
            #1111111#00000000#
            #1111111#00000000#
            ##################
            1 of 75 changed [0, 1, 0, 0, 0, 0, 0, 0, 0, 0], entropy 0.57 -> 0.00"#]],
    );
}

#[test]
fn a_corridor_one_cell_wide_survives() {
    check(
        "
        ###########################
        #1111111###########1111111#
        #11111110000000000011111111
        #1111111###########1111111#
        #1111111###########1111111#
        ###########################
        ",
        0.6,
        &expect![[r#"
            ###########################
            #1111111###########1111111#
            #11111111000000000111111111
            #1111111###########1111111#
            #1111111###########1111111#
            ###########################
            2 of 68 changed [0, 0, 0, 2, 0, 0, 0, 0, 0, 0], entropy 1.37 -> 0.04"#]],
    );
}

#[test]
fn where_all_agree_nothing_changes() {
    check(
        "
        2222
        2##2
        2222
        ",
        0.6,
        &expect![[r#"
            2222
            2##2
            2222
            0 of 10 changed [0], entropy 1.37 -> 1.37"#]],
    );
    let (_, report) = relaxed("0#1\n###\n2#0", 1.0, 5);
    assert_eq!((report.changed, report.changed_by_iteration), (0, vec![0]), "cells without neighbours stay");
}

#[test]
fn nothing_is_no_trouble() {
    let (memberships, report) = relaxed("", 0.9, 5);
    assert!(memberships.categories().is_empty());
    assert_eq!(report.nodes, 0);
}

#[test]
fn a_lattice_is_what_the_cells_lie_on() {
    let (cells, categories, width) = read("1#1#1\n#####\n0#2#0");
    let on_lattice = Lattice::new(&cells, width, 2);
    let mut coarse = memberships(&categories, 0.9);
    let options = RelaxationOptions { iterations: 3 };
    let report = relax_cells(&on_lattice, &mut coarse, options, &Watch::unwatched()).expect("nobody stops it");
    assert!(report.entropy_after != report.entropy_before, "two cells apart are neighbours there");
    // One cell off the lattice: every cell was measured.
    assert_eq!(relaxed("1#1\n###\n0#2", 0.9, 1).1.changed_by_iteration, [0]);
}

/// Storage along a corridor; one of its faces was taken for a corridor, with doubts.
#[test]
fn a_face_learns_from_the_pattern_around_it() {
    let places = 12;
    // Face 0 is the corridor, the others lie along it and side by side.
    let mut adjacency: Adjacency = vec![(1..=places).map(|place| (place, 1.0)).collect()];
    for place in 1..=places {
        let beside = [place - 1, place + 1].into_iter().filter(|beside| (1..=places).contains(beside));
        adjacency.push(beside.map(|beside| (beside, 1.0)).chain([(0, 1.0)]).collect());
    }
    let storage = vec![0.1, 0.9];
    let mut faces = vec![storage; places + 1];
    faces[0] = vec![0.9, 0.1];
    faces[5] = vec![0.55, 0.45];
    let options = RelaxationOptions { iterations: 10 };
    let report = relax_faces(&mut faces, &adjacency, 2, options, &Watch::unwatched()).expect("nobody stops it");
    assert!(faces[5][1] > 0.7, "{:?}", faces[5]);
    assert!(faces[0][0] > 0.9, "{:?}", faces[0]);
    assert_eq!((report.nodes, report.changed), (places + 1, 1));
    assert!(report.entropy_after < report.entropy_before);
}

#[test]
fn faces_without_a_distribution_take_no_part() {
    let adjacency = vec![vec![(1, 2.0)], vec![(0, 2.0)]];
    let mut faces = vec![vec![], vec![0.3, 0.7]];
    let options = RelaxationOptions { iterations: 3 };
    let report = relax_faces(&mut faces, &adjacency, 2, options, &Watch::unwatched()).expect("nobody stops it");
    assert!(faces[0].is_empty());
    assert_eq!((report.nodes, report.changed), (1, 0));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn distributions_stay_distributions(
        rows in proptest::collection::vec("[0-2#]{12}", 1..150),
        own in 0.34_f32..1.0,
        iterations in 1_usize..6,
    ) {
        let picture = rows.join("\n");
        let run = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads can be had");
            pool.install(|| relaxed(&picture, own, iterations))
        };
        let (memberships, report) = run(1);
        prop_assert_eq!(&(memberships.clone(), report.clone()), &run(3));
        prop_assert!(report.changed_by_iteration.len() <= iterations);
        prop_assert!(report.changed <= report.changed_by_iteration.iter().sum::<usize>());
        for cell in 0..report.nodes {
            let packed: u32 = memberships.values()[cell * CATEGORIES..][..CATEGORIES].iter().map(|&value| u32::from(value)).sum();
            prop_assert!((65_533..=65_537).contains(&packed), "{packed}");
            let shares: Vec<f32> = memberships.of(cell).collect();
            prop_assert!((shares.iter().sum::<f32>() - 1.0).abs() < 1e-5);
        }
    }

    #[test]
    fn distributions_of_faces_stay_distributions(
        shares in proptest::collection::vec(proptest::collection::vec(0.0_f32..1.0, 3), 2..20),
        borders in proptest::collection::vec((0_usize..20, 0_usize..20, 0.0_f64..5.0), 0..40),
    ) {
        let mut faces: Vec<Vec<f32>> = shares
            .into_iter()
            .map(|shares| {
                let sum: f32 = shares.iter().sum::<f32>().max(1e-3);
                shares.into_iter().map(|share| share / sum).collect()
            })
            .collect();
        let mut adjacency = vec![Vec::new(); faces.len()];
        for (one, other, length) in borders {
            let (one, other) = (one % faces.len(), other % faces.len());
            if one != other {
                adjacency[one].push((other, length));
                adjacency[other].push((one, length));
            }
        }
        let options = RelaxationOptions { iterations: 5 };
        relax_faces(&mut faces, &adjacency, 3, options, &Watch::unwatched()).expect("nobody stops it");
        for shares in faces {
            prop_assert!((shares.iter().sum::<f32>() - 1.0).abs() < 1e-4);
            prop_assert!(shares.iter().all(|share| (0.0..=1.0).contains(share)));
        }
    }
}
