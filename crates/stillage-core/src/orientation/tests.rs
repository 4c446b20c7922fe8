//! Orientations of drawn halls, degenerate grids and real maps.

use std::f64::consts::PI;

use super::energy::OccupiedSample;
use super::*;
use crate::geometry::line_angle_between;
use crate::grid::{GridFrame, Occupancy};
use crate::test_maps::{self, Hall};
use crate::watch::Stage;
use crate::{Point, StopFlag};
use expect_test::expect;
use proptest::prelude::*;

/// In the paper's way, with or without the refinement.
fn find(grid: &OccupancyGrid, refine: bool) -> Orientations {
    let options = OrientationOptions { method: OrientationMethod::Paper, refine, ..OrientationOptions::default() };
    dominant_orientations(grid, &options, &Watch::unwatched()).unwrap()
}

fn find_by_energy(grid: &OccupancyGrid) -> Orientations {
    dominant_orientations(grid, &OrientationOptions::default(), &Watch::unwatched()).unwrap()
}

#[test]
fn energy_finds_turned_racks_and_nothing_else() {
    for angle_deg in [-38.6, -4.2, 0.0, 17.3, 44.9] {
        let found = find_by_energy(&hall(angle_deg));
        let across = if angle_deg > 0.0 { angle_deg - 90.0 } else { angle_deg + 90.0 };
        assert_eq!(found.angles.len(), 2, "{angle_deg}: {:?}", found.angles);
        assert!(error_deg(&found.angles, &[angle_deg, across]) < 0.02, "{angle_deg}: {:?}", found.angles);
        assert!((found.histogram.iter().sum::<f64>() - 1.0).abs() < 1e-9);
    }
}

#[test]
fn lines_tell_hundredths_of_a_degree_from_wherever_the_fit_starts() {
    let grid = hall(17.3);
    let samples = OccupiedSample::of_parts(&grid, 1, |_, _| Some(0), energy::SAMPLE_CELLS, &Watch::unwatched());
    let sample = samples.unwrap().swap_remove(0);
    for start_deg in [17.2_f64, 17.27, 17.36, 17.4] {
        let fitted_deg = slope::fit(&sample, start_deg.to_radians(), true, &Watch::unwatched()).unwrap().to_degrees();
        assert!((fitted_deg - 17.3).abs() < 0.01, "from {start_deg}: {fitted_deg}");
    }
    let nothing = slope::fit(&OccupiedSample::default(), 0.3, true, &Watch::unwatched()).unwrap();
    assert_eq!(nothing.to_bits(), 0.3_f64.to_bits());
}

#[test]
fn energy_finds_the_direction_of_a_part() {
    let part = Hall { center: [150.0, 150.0], size: [60.0, 56.0], angle_deg: 13.0 };
    let rest = [([95.0, 55.0], [180.0, 100.0]), ([55.0, 150.0], [100.0, 80.0])];
    let [low, high] = rest.map(|(center, size)| Hall { center, size, angle_deg: 0.0 });
    let found = find_by_energy(&test_maps::draw(&[low, high, part], [200.0, 200.0], 0.1));
    assert!(error_deg(&found.angles, &[-90.0, -77.0, 0.0, 13.0]) < 0.05, "{:?}", found.angles);
}

#[test]
fn energy_finds_no_direction_in_grids_without_structure() {
    for cell in [Occupancy::Free, Occupancy::Occupied, Occupancy::Unknown] {
        for (width, height) in [(0, 0), (0, 5), (5, 0), (1, 1), (70, 130)] {
            let found = find_by_energy(&grid_of(width, height, |_, _| cell));
            assert_eq!(found, Orientations::default(), "{width} x {height}, {cell:?}");
        }
    }
}

fn hall(angle_deg: f64) -> OccupancyGrid {
    test_maps::draw(&[Hall { center: [20.0, 20.0], size: [30.0, 20.0], angle_deg }], [40.0, 40.0], 0.05)
}

/// Largest error of the angles found against wanted ones, degrees; infinite when their number differs.
fn error_deg(found: &[f64], wanted_deg: &[f64]) -> f64 {
    let nearest = |wanted: f64| {
        found
            .iter()
            .map(|&angle| line_angle_between(angle, wanted.to_radians()).to_degrees())
            .fold(f64::INFINITY, f64::min)
    };
    if found.len() == wanted_deg.len() {
        wanted_deg.iter().copied().map(nearest).fold(0.0, f64::max)
    } else {
        f64::INFINITY
    }
}

fn grid_of(width: usize, height: usize, cell: impl Fn(usize, usize) -> Occupancy) -> OccupancyGrid {
    let cells = (0..width * height).map(|index| cell(index % width, index / width)).collect();
    OccupancyGrid::new(width, height, GridFrame { resolution: 0.05, origin: Point::origin(), yaw: 0.0 }, cells)
}

#[test]
fn turned_racks_are_found_to_a_tenth_of_a_degree() {
    for angle_deg in [0.0, 1.2, 17.3, -33.0, 44.0, 89.0] {
        let found = find(&hall(angle_deg), true);
        let error = error_deg(&found.angles, &[angle_deg, angle_deg + 90.0]);
        assert!(error <= 0.1, "{angle_deg}: {:?} is off by {error}", found.angles);
    }
}

#[test]
fn gradients_alone_are_right_to_a_degree_or_so() {
    for angle_deg in [0.0, 17.3, -33.0] {
        let found = find(&hall(angle_deg), false);
        let error = error_deg(&found.angles, &[angle_deg, angle_deg + 90.0]);
        assert!(error <= 1.5, "{angle_deg}: {:?} is off by {error}", found.angles);
    }
}

#[test]
fn the_signals_are_distributions_over_half_a_turn() {
    let found = find(&hall(17.3), true);
    assert_eq!((found.histogram.len(), found.mixture.len()), (900, 900));
    assert!((found.histogram.iter().sum::<f64>() - 1.0).abs() < 1e-9);
    assert!((found.mixture.iter().sum::<f64>() - 1.0).abs() < 1e-3);
    assert!(found.angles.is_sorted() && found.angles.iter().all(|angle| (-PI / 2.0..PI / 2.0).contains(angle)));
}

#[test]
fn both_sides_of_a_wall_count_for_one_direction() {
    let found =
        find(&grid_of(60, 60, |column, _| if column == 30 { Occupancy::Occupied } else { Occupancy::Free }), false);
    let bin = |angle_deg: f64| ((angle_deg + 90.0) * 5.0) as usize % 900;
    let upright = found.histogram[899] + found.histogram[0];
    assert!(upright > 0.99, "{upright}");
    assert!(found.histogram[bin(0.0)] < 1e-6);
    assert!(error_deg(&found.angles, &[90.0]) < 0.05, "{:?}", found.angles);
}

#[test]
fn parts_have_orientations_of_their_own() {
    let halls = [
        Hall { center: [15.0, 20.0], size: [24.0, 24.0], angle_deg: 5.0 },
        Hall { center: [50.0, 20.0], size: [24.0, 24.0], angle_deg: 35.0 },
    ];
    let grid = test_maps::draw(&halls, [70.0, 40.0], 0.05);
    let part_of = |column: usize, _| Some(usize::from(column > 640));
    let options = OrientationOptions::default();
    let parts = orientations_of_parts(&grid, 2, part_of, &options, &Watch::unwatched()).unwrap();
    assert!(error_deg(&parts[0].angles, &[5.0, 95.0]) <= 0.1, "{:?}", parts[0].angles);
    assert!(error_deg(&parts[1].angles, &[35.0, 125.0]) <= 0.1, "{:?}", parts[1].angles);
    let whole = dominant_orientations(&grid, &options, &Watch::unwatched()).unwrap();
    assert!(error_deg(&whole.angles, &[5.0, 95.0, 35.0, 125.0]) <= 0.1, "{:?}", whole.angles);
}

#[test]
fn a_grid_without_structure_has_no_orientation() {
    let none = Orientations::default();
    for cell in [Occupancy::Free, Occupancy::Occupied, Occupancy::Unknown] {
        for (width, height) in [(0, 0), (0, 5), (5, 0), (1, 1), (1, 40), (70, 130)] {
            for refine in [false, true] {
                assert_eq!(find(&grid_of(width, height, |_, _| cell), refine), none, "{width} x {height}, {cell:?}");
            }
        }
    }
}

#[test]
fn scattered_cells_have_no_orientation() {
    use rand_chacha::rand_core::{Rng, SeedableRng};
    let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(7);
    for (size, one_in) in [(12_usize, 5), (60, 8), (200, 30), (700, 20)] {
        let cells: Vec<Occupancy> = (0..size * size)
            .map(|_| if random.next_u32() % one_in == 0 { Occupancy::Occupied } else { Occupancy::Free })
            .collect();
        let grid = grid_of(size, size, |column, row| cells[row * size + column]);
        assert_eq!(find(&grid, true).angles, [0.0; 0], "{size}, one in {one_in}");
    }
}

#[test]
fn a_drawn_floor_plan_is_enough() {
    let rooms = "
        ####################
        #........#.........#
        #........#.........#
        #........#.........#
        #..................#
        #........#.........#
        #........#.........#
        ####################
        ";
    let racks = "
        ....................
        .########..########.
        .#      #..#      #.
        .########..########.
        ....................
        ....................
        .########..########.
        .#      #..#      #.
        .########..########.
        ....................
        ";
    for (picture, along) in [(rooms, 0.0), (racks, 0.0)] {
        let found = find(&OccupancyGrid::from_ascii(picture, 0.5), true).angles;
        assert!(found.iter().any(|angle| (angle.to_degrees() - along).abs() < 0.5), "{found:?}");
    }
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let grid = hall(17.3);
    let on_threads = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| find(&grid, true))
    };
    let one = on_threads(1);
    assert_eq!(one, on_threads(2));
    assert_eq!(one, on_threads(7));
}

#[test]
fn a_raised_flag_stops_the_search() {
    struct Silent;
    impl crate::watch::Observer for Silent {
        fn progress(&self, _: Stage, _: f64) {}
    }
    let flag = StopFlag::default();
    flag.raise();
    let watch = Watch::new(&flag, &Silent);
    assert_eq!(dominant_orientations(&hall(3.0), &OrientationOptions::default(), &watch), Err(Stopped));
}

#[test]
fn orientations_of_real_maps() {
    let degrees = |name: &str, resolution: f64| {
        let grid = test_maps::real(name, resolution)?;
        Some(
            find(&grid, true)
                .angles
                .iter()
                .map(|angle| format!("{:.2}", angle.to_degrees()))
                .collect::<Vec<_>>()
                .join(" "),
        )
    };
    let check = |name: &str, resolution: f64, wanted: expect_test::Expect| {
        if let Some(found) = degrees(name, resolution) {
            wanted.assert_eq(&found);
        }
    };
    check("office__halmstad_F5_05", 0.02, expect!["-3.89 85.15"]);
    check("office__pal_office", 0.05, expect!["-76.00 13.90"]);
    // Its maker turned this map by the 2.15 degrees of its neighbour `005`, so it stands straight.
    check("warehouse__aws_small_005_rotated", 0.05, expect!["-90.00 0.00"]);
    check("warehouse__svl_warehouse_dt_pallets", 0.05, expect!["-90.00 0.01"]);
    check("warehouse__hunav_small_warehouse", 0.05, expect!["0.12 89.55"]);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn any_grid_and_options_give_sorted_angles_apart(
        width in 0_usize..40,
        cells in proptest::collection::vec(0_u8..3, 0..600),
        bins in 36_usize..400,
        refine: bool,
    ) {
        let height = cells.len().checked_div(width).unwrap_or(0);
        let grid = grid_of(width, height, |column, row| match cells[row * width + column] {
            0 => Occupancy::Free,
            1 => Occupancy::Occupied,
            _ => Occupancy::Unknown,
        });
        let options = OrientationOptions { bins, refine, ..OrientationOptions::default() };
        let found = dominant_orientations(&grid, &options, &Watch::unwatched()).unwrap();
        prop_assert!(found.angles.is_sorted());
        prop_assert!(found.angles.iter().all(|angle| (-PI / 2.0..PI / 2.0).contains(angle)));
        for (index, &angle) in found.angles.iter().enumerate() {
            for &other in &found.angles[..index] {
                prop_assert!(line_angle_between(angle, other).to_degrees() > options.min_separation_deg - 180.0 / bins as f64);
            }
        }
    }
}
