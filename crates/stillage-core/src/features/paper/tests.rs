//! The running sums against the definitions, and the features of known rooms.

use super::*;
use crate::features::FeatureSource;
use crate::raycast::PLANE_LENGTH;
use crate::test_maps::real_maps;
use proptest::prelude::*;

fn features(grid: &OccupancyGrid, options: &CategorizationOptions) -> CellFeatures {
    let watch = Watch::unwatched();
    let source = FeatureSource::new(grid, options, Vectors::widest(), &watch).expect("nobody stops it");
    source.all(&watch).expect("nobody stops it")
}

/// The lengths (cells) of all beams of all measured cells of a tile, by row, column and beam.
fn beams_of_tile(sweep: &Sweep, tile: &Tile, beams: usize) -> Vec<((usize, usize), Vec<f64>)> {
    let (mut scratch, mut plane) = (TileScratch::default(), vec![0; PLANE_LENGTH]);
    let mut cells: Vec<((usize, usize), Vec<f64>)> = tile
        .measured_rows()
        .flat_map(|row| tile.measured_columns().map(move |column| ((column, row), Vec::new())))
        .collect();
    for beam in 0..beams {
        sweep.cast(tile, beam, &mut scratch, &mut plane);
        let columns = tile.measured_columns().len();
        for (index, (_, lengths)) in cells.iter_mut().enumerate() {
            let (row, column) = (index / columns, index % columns);
            let place = if sweep.is_transposed(beam) { column * PLANE_PITCH + row } else { row * PLANE_PITCH + column };
            lengths.push(f64::from((f32::from(plane[place]) * sweep.unit(beam)).min(sweep.limit())));
        }
    }
    cells
}

fn sweep_of(grid: &OccupancyGrid, options: &CategorizationOptions) -> Sweep {
    Sweep::new(grid, &BeamOptions::from(options), Vectors::widest(), &Watch::unwatched(), |_| ())
        .expect("nobody stops it")
}

/// The features by their definitions, in double precision.
fn by_definition(lengths: &[f64], gap: f64, resolution: f64) -> [f64; 13] {
    let count = lengths.len();
    let mean_of = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let moment = |values: &[f64], power: i32| {
        let mean = mean_of(values);
        mean_of(&values.iter().map(|value| (value - mean).powi(power)).collect::<Vec<f64>>())
    };
    let around = |index: usize| (index + 1) % count;
    let changes: Vec<f64> = (0..count).map(|index| (lengths[around(index)] - lengths[index]).abs()).collect();
    let points: Vec<_> =
        lengths.iter().enumerate().map(|(beam, length)| beam_direction(beam, count) * *length).collect();
    let area: f64 = (0..count).map(|index| points[index].perp(&points[around(index)]) / 2.0).sum();
    let perimeter: f64 = (0..count).map(|index| (points[index] - points[around(index)]).norm()).sum();
    let center = points.iter().sum::<crate::Vector>() / count as f64;
    let covariance =
        points.iter().map(|point| (point - center) * (point - center).transpose()).sum::<nalgebra::Matrix2<f64>>()
            / count as f64;
    let mut spreads = covariance.symmetric_eigenvalues().map(|value| value.max(0.0).sqrt());
    spreads.as_mut_slice().sort_by(f64::total_cmp);
    let variance = moment(lengths, 2);
    let kurtosis = if variance < 1e-4 { 0.0 } else { moment(lengths, 4) / variance.powi(2) - 3.0 };
    [
        mean_of(lengths) * resolution,
        variance.sqrt() * resolution,
        mean_of(&changes) * resolution,
        moment(&changes, 2).sqrt() * resolution,
        area * resolution * resolution,
        perimeter * resolution,
        perimeter * perimeter / area,
        changes.iter().filter(|&&change| change > gap).count() as f64,
        kurtosis,
        spreads[1] * resolution,
        spreads[0] * resolution,
        spreads[1] / spreads[0],
        center.norm() * resolution,
    ]
}

/// Compares all features of a grid with their definitions; gives the largest relative difference of each.
fn worst_differences(grid: &OccupancyGrid, options: &CategorizationOptions) -> [f64; 13] {
    let found = features(grid, options);
    let sweep = sweep_of(grid, options);
    let gap = f64::from((options.gap_m / grid.resolution()) as f32);
    let mut worst = [0.0_f64; 13];
    for tile in &sweep.tiles(options.stride) {
        for ((column, row), lengths) in beams_of_tile(&sweep, tile, options.beams) {
            let cell = (row * grid.width() + column) as u32;
            let Ok(index) = found.cells.binary_search(&cell) else { continue };
            let values = &found.values[index * 13..(index + 1) * 13];
            let expected = by_definition(&lengths, gap, grid.resolution());
            for ((worst, &value), expected) in worst.iter_mut().zip(values).zip(expected) {
                // Differences are taken relative to a cell at least.
                let scale = expected.abs().max(grid.resolution());
                *worst = worst.max((f64::from(value) - expected).abs() / scale);
            }
        }
    }
    worst
}

#[test]
fn running_sums_give_the_defined_features_of_a_real_map() {
    let Some(path) = real_maps::find("dev/office__rmf_office_scan/map.png") else { return };
    let grid = real_maps::Picture::read(&path).grid(0.05, 89, 230);
    let options = CategorizationOptions { stride: 5, ..CategorizationOptions::default() };
    let worst = worst_differences(&grid, &options);
    println!("largest relative differences: {worst:?}");
    assert!(worst.iter().all(|&difference| difference < 1e-3), "{worst:?}");
}

#[test]
fn the_middle_of_a_square_room_has_the_features_of_a_square() {
    // 41 x 41 cells of 0.1 m: half a side is 2.05 m.
    let grid = OccupancyGrid::from_ascii(&vec![".".repeat(41); 41].join("\n"), 0.1);
    let options = CategorizationOptions { stride: 20, ..CategorizationOptions::default() };
    let found = features(&grid, &options);
    assert_eq!(found.cells.len(), 9);
    let middle = &found.values[4 * 13..5 * 13];
    let near = |index: usize, expected: f32, tolerance: f32| {
        assert!((middle[index] - expected).abs() <= tolerance, "{} is {}", NAMES[index], middle[index]);
    };
    // The mean of 1 / cos over an eighth of a turn is 4 / pi ln(1 + sqrt 2).
    near(0, 2.05 * 1.1222, 0.01);
    near(4, 16.81, 0.2);
    near(5, 16.4, 0.4);
    near(6, 16.0, 0.6);
    near(7, 0.0, 0.0);
    near(11, 1.0, 0.01);
    near(12, 0.0, 0.01);
}

#[test]
fn a_range_limit_makes_open_places_round() {
    let grid = OccupancyGrid::from_ascii(&vec![".".repeat(41); 41].join("\n"), 0.1);
    let options = CategorizationOptions { stride: 20, max_range_m: Some(1.5), ..CategorizationOptions::default() };
    let found = features(&grid, &options);
    let middle = &found.values[4 * 13..5 * 13];
    assert_eq!((middle[0], middle[1], middle[7], middle[8]), (1.5, 0.0, 0.0, 0.0));
}

#[test]
fn the_features_of_a_cell_do_not_depend_on_the_stride() {
    let grid = OccupancyGrid::from_ascii(&vec!["...#....".repeat(20); 140].join("\n"), 0.1);
    let all = features(&grid, &CategorizationOptions::default());
    for stride in [2, 3, 50, 64] {
        let some = features(&grid, &CategorizationOptions { stride, ..CategorizationOptions::default() });
        assert!(!some.cells.is_empty());
        for (index, cell) in some.cells.iter().enumerate() {
            let same = all.cells.binary_search(cell).expect("every free cell is among all cells");
            assert_eq!(some.values[index * 13..][..13], all.values[same * 13..][..13]);
        }
    }
}

#[test]
fn any_number_of_threads_and_any_vectors_give_the_same_bytes() {
    let grid = OccupancyGrid::from_ascii(&vec!["...#......##.".repeat(23); 270].join("\n"), 0.05);
    let options = CategorizationOptions { beams: 45, ..CategorizationOptions::default() };
    let bytes = |threads, vectors| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads can be had");
        let watch = Watch::unwatched();
        let found = pool.install(|| FeatureSource::new(&grid, &options, vectors, &watch)?.all(&watch));
        found.expect("nobody stops it").values.iter().map(|value| value.to_bits()).collect::<Vec<u32>>()
    };
    let first = bytes(1, Vectors::Portable);
    for vectors in Vectors::available() {
        for threads in [1, 2, 7] {
            assert!(first == bytes(threads, vectors), "{vectors:?}, {threads} threads");
        }
    }
}

#[test]
fn a_raised_flag_stops_the_work() {
    struct Nobody;
    impl crate::watch::Observer for Nobody {
        fn progress(&self, _: Stage, _: f64) {}
    }
    let stop = crate::StopFlag::default();
    stop.raise();
    let grid = OccupancyGrid::from_ascii("...", 0.1);
    let watch = Watch::new(&stop, &Nobody);
    let stopped = FeatureSource::new(&grid, &CategorizationOptions::default(), Vectors::widest(), &watch);
    assert!(stopped.is_err());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn every_vector_width_gives_the_same_features_of_random_maps(
        rows in proptest::collection::vec("[.]{4,200}[.#?]{0,30}", 1..150),
        beams in 8_usize..40,
        stride in 1_usize..4,
    ) {
        let grid = OccupancyGrid::from_ascii(&rows.join("\n"), 0.1);
        let options = CategorizationOptions { beams, stride, ..CategorizationOptions::default() };
        let watch = Watch::unwatched();
        let features = |vectors| FeatureSource::new(&grid, &options, vectors, &watch)?.all(&watch);
        let portable = features(Vectors::Portable).expect("nobody stops it");
        for vectors in Vectors::available() {
            prop_assert_eq!(&portable, &features(vectors).expect("nobody stops it"));
        }
    }

    #[test]
    fn running_sums_give_the_defined_features_of_random_maps(
        rows in proptest::collection::vec("[.]{4,20}[.#]{0,10}", 1..40),
        beams in 8_usize..80,
        range in proptest::option::of(0.2..5.0),
    ) {
        let grid = OccupancyGrid::from_ascii(&rows.join("\n"), 0.1);
        let options = CategorizationOptions { beams, max_range_m: range, ..CategorizationOptions::default() };
        let worst = worst_differences(&grid, &options);
        prop_assert!(worst.iter().all(|&difference| difference < 1e-3), "{worst:?}");
    }
}
