use proptest::prelude::*;

use super::*;
use crate::geometry::{Point, Vector, direction};
use crate::grid::{GridFrame, Occupancy};
use crate::test_maps::real_maps::{self, Picture};
use crate::test_maps::{Hall, draw, real};

fn aligned(new: &OccupancyGrid, old: &OccupancyGrid) -> Result<SiteAlignment, NotSameSite> {
    align(new, old, &Watch::unwatched()).expect("nobody stops it")
}

/// A hall of 24 m x 17 m with a smaller one at its end, turned about the middle of the larger one.
fn site(center: [f64; 2], angle_deg: f64, resolution: f64) -> OccupancyGrid {
    let beside = direction(angle_deg.to_radians()) * 17.0;
    let halls = [
        Hall { center, size: [24.0, 17.0], angle_deg },
        Hall { center: [center[0] + beside.x, center[1] + beside.y], size: [10.0, 13.0], angle_deg },
    ];
    draw(&halls, [60.0, 60.0], resolution)
}

/// The grid without the goods of every `nth` square of 2 m, but for a rim: free there.
fn cleared(grid: &OccupancyGrid, nth: usize) -> OccupancyGrid {
    let square = (2.0 / grid.resolution()) as usize;
    let clear = |index: usize| {
        let (column, row) = (index % grid.width() / square, index / grid.width() / square);
        (column + 3 * row).is_multiple_of(nth)
    };
    let walls = crate::walls::find(grid, &Watch::unwatched()).expect("nobody stops it");
    let cells = grid.cells().iter().enumerate().map(|(index, &cell)| match cell {
        Occupancy::Occupied if clear(index) && !walls[index] => Occupancy::Free,
        cell => cell,
    });
    OccupancyGrid::new(grid.width(), grid.height(), *grid.frame(), cells.collect())
}

/// Fails where the motion carries a corner of the hall elsewhere than from one pose to the other.
fn assert_carries(found: &SiteAlignment, [from, to]: [([f64; 2], f64); 2]) {
    for corner in [Vector::new(-12.0, -8.5), Vector::new(22.0, 6.5)] {
        let place = |(center, angle_deg): ([f64; 2], f64)| {
            let motion = RigidMotion { shift: Point::from(center).coords, turn: f64::to_radians(angle_deg) };
            motion.apply(Point::from(corner))
        };
        let error = (found.motion.apply(place(from)) - place(to)).norm();
        assert!(error < 0.05, "{error} m off at {corner}: {found:?}");
    }
}

#[test]
fn a_site_is_found_again_shifted_turned_in_other_cells_and_with_other_goods() {
    let (old, new) = (([25.0, 25.0], 10.0), ([31.0, 28.0], 152.0));
    let found = aligned(&cleared(&site(new.0, new.1, 0.06), 3), &site(old.0, old.1, 0.05)).expect("it is one site");
    assert_carries(&found, [new, old]);
    assert!(!found.ambiguous && found.residual < 0.05 && found.agreement > 0.8, "{found:?}");
}

#[test]
fn the_motion_is_one_between_map_frames() {
    let grid = site([25.0, 25.0], 10.0, 0.1);
    let frame = GridFrame { origin: Point::new(-7.0, 3.0), yaw: 0.4, ..*grid.frame() };
    let moved = OccupancyGrid::new(grid.width(), grid.height(), frame, grid.cells().to_vec());
    let found = aligned(&grid, &moved).expect("it is one site");
    let place = Point::new(30.0, 20.0);
    assert!((found.motion.apply(place) - frame.to_map(place)).norm() < 0.01, "{found:?}");
}

#[test]
fn a_hall_that_looks_alike_from_both_ends_is_ambiguous() {
    let hall = |angle_deg| draw(&[Hall { center: [20.0, 20.0], size: [24.0, 17.1], angle_deg }], [40.0, 40.0], 0.1);
    let found = aligned(&hall(30.0), &hall(0.0)).expect("it is one site");
    assert!(found.ambiguous, "{found:?}");
}

#[test]
fn different_sites_are_refused() {
    let other = draw(
        &[
            Hall { center: [20.0, 20.0], size: [30.0, 9.0], angle_deg: 5.0 },
            Hall { center: [28.0, 30.0], size: [9.0, 12.0], angle_deg: 5.0 },
        ],
        [50.0, 50.0],
        0.05,
    );
    let refusal = aligned(&other, &site([25.0, 25.0], 10.0, 0.05)).expect_err("they are two sites");
    assert!(refusal.to_string().starts_with("the maps show different sites: at best "), "{refusal}");
}

#[test]
fn what_shows_nothing_is_no_site() {
    let nothing = OccupancyGrid::from_ascii("..\n..", 0.05);
    assert!(aligned(&nothing, &nothing).is_err());
    assert!(aligned(&nothing, &site([25.0, 25.0], 10.0, 0.2)).is_err());
    assert!(aligned(&OccupancyGrid::from_ascii("", 0.05), &nothing).is_err());
}

#[test]
fn two_runs_of_a_simulated_warehouse_are_one_site() {
    let Some(one) = real("warehouse__aws_small_005_rotated", 0.05) else { return };
    let Some(other) = real("warehouse__hunav_small_warehouse", 0.05) else { return };
    let (there, back) = (aligned(&one, &other), aligned(&other, &one));
    let (there, back) = (there.expect("it is one site"), back.expect("it is one site"));
    let place = Point::new(7.0, 10.0);
    let error = (back.motion.apply(there.motion.apply(place)) - place).norm();
    assert!(error < 0.05 && !there.ambiguous && there.residual < 0.05, "{error} m: {there:?}, {back:?}");
}

#[test]
fn two_runs_of_the_authors_building_are_one_site_and_another_building_is_not() {
    let Some(drawn) = real_maps::find("golden/categories-2017/F5_04.png") else { return };
    let Some(scan) = real("office__halmstad_F5_05", 0.02) else { return };
    let Some(other) = real("office__halmstad_E5_07", 0.02) else { return };
    let drawn = Picture::read(&drawn).grid(0.02, 89, 206);
    let found = aligned(&drawn, &scan).expect("it is one building");
    // Measured by hand in both pictures: the corridor goes up in one and to the right in the other.
    assert!((found.motion.turn.to_degrees() - 77.0).abs() < 1.5 && !found.ambiguous, "{found:?}");
    assert!(aligned(&scan, &other).is_err());
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let (old, new) = (site([25.0, 25.0], 10.0, 0.1), site([30.0, 25.0], 60.0, 0.1));
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| aligned(&new, &old))
    };
    assert_eq!(on(1), on(3));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(8))]

    #[test]
    fn any_shift_and_turn_is_found(x in 22.0..38.0, y in 22.0..38.0, angle in -180.0..180.0_f64, nth in 2_usize..6) {
        let old = ([28.0, 27.0], 25.0);
        let found = aligned(&cleared(&site([x, y], angle, 0.1), nth), &site(old.0, old.1, 0.1));
        assert_carries(&found.expect("it is one site"), [([x, y], angle), old]);
    }
}
