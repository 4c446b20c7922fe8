//! Regions of drawn halls, degenerate grids and real maps.

use expect_test::{Expect, expect};

use super::*;
use crate::geometry::Point;
use crate::grid::{GridFrame, Occupancy};
use crate::orientation::dominant_orientations;
use crate::spec::RegionOptions;
use crate::test_maps::{self, Hall};

/// Options of the texture method.
fn texture() -> RegionOptions {
    RegionOptions { method: RegionMethod::Gabor, ..RegionOptions::default() }
}

fn find(grid: &OccupancyGrid, regions: RegionOptions) -> RegionMap {
    let options = AnalysisOptions { regions, ..AnalysisOptions::default() };
    let global = dominant_orientations(grid, &options.orientation, &Watch::unwatched()).unwrap();
    segment(grid, &global, &options, &Watch::unwatched()).unwrap()
}

/// Two halls side by side, turned against each other.
fn two_halls() -> OccupancyGrid {
    let halls = [
        Hall { center: [24.0, 22.0], size: [40.0, 34.0], angle_deg: 5.0 },
        Hall { center: [66.0, 22.0], size: [40.0, 34.0], angle_deg: -28.0 },
    ];
    test_maps::draw(&halls, [92.0, 44.0], 0.1)
}

fn one_hall() -> OccupancyGrid {
    test_maps::draw(&[Hall { center: [30.0, 25.0], size: [50.0, 36.0], angle_deg: 17.3 }], [60.0, 50.0], 0.1)
}

/// One character per tile, highest row on top.
fn picture(map: &RegionMap) -> String {
    let character = |&region: &u8| if region == RegionMap::NONE { '.' } else { char::from(b'A' + region) };
    let rows = map.tiles.chunks(map.columns).rev();
    rows.map(|row| row.iter().map(character).collect::<String>() + "\n").collect()
}

/// Orientations and share of each region, a line each.
fn summary(map: &RegionMap) -> String {
    let line = |region: &Region| {
        let angles: Vec<String> =
            region.orientations.iter().map(|angle| format!("{:.1}", angle.to_degrees())).collect();
        format!("{:.2} at {}\n", region.share, angles.join(" "))
    };
    map.regions.iter().map(line).collect()
}

#[test]
fn two_halls_are_two_regions() {
    let map = find(&two_halls(), RegionOptions::default());
    expect![[r#"
        0.48 at -27.9 62.1
        0.52 at -85.1 4.9
    "#]]
    .assert_eq(&summary(&map));
    expect![[r#"
        ...........................AAAAAA.............
        .................BBBBB....AAAAAAAAA...........
        ......BBBBBBBBBBBBBBBB...AAAAAAAAAAA..........
        .BBBBBBBBBBBBBBBBBBBBB...AAAAAAAAAAAAA........
        .BBBBBBBBBBBBBBBBBBBBB..AAAAAAAAAAAAAAAA......
        .BBBBBBBBBBBBBBBBBBBBB..AAAAAAAAAAAAAAAAAA....
        .BBBBBBBBBBBBBBBBBBBBB.AAAAAAAAAAAAAAAAAAAAA..
        .BBBBBBBBBBBBBBBBBBBBB.AAAAAAAAAAAAAAAAAAAAAAA
        .BBBBBBBBBBBBBBBBBBBBBAAAAAAAAAAAAAAAAAAAAAAAA
        .BBBBBBBBBBBBBBBBBBBBBBAAAAAAAAAAAAAAAAAAAAAAA
        .BBBBBBBBBBBBBBBBBBBBBBAAAAAAAAAAAAAAAAAAAAAA.
        .BBBBBBBBBBBBBBBBBBBBBBAAAAAAAAAAAAAAAAAAAAAA.
        ..BBBBBBBBBBBBBBBBBBBBBAAAAAAAAAAAAAAAAAAAAA..
        ..BBBBBBBBBBBBBBBBBBBBBAAAAAAAAAAAAAAAAAAAAA..
        ..BBBBBBBBBBBBBBBBBBBBBAAAAAAAAAAAAAAAAAAAA...
        ..BBBBBBBBBBBBBBBBBBBBBAAAAAAAAAAAAAAAAAAAA...
        ..BBBBBBBBBBBBBBBBBBBBB.AAAAAAAAAAAAAAAAAA....
        ..BBBBBBBBBBBBBBBBBBBBB...AAAAAAAAAAAAAAAA....
        ..BBBBBBBBBBBBBBBBBBBBB.....AAAAAAAAAAAAA.....
        ..BBBBBBBBBBBBBBBB............AAAAAAAAAAA.....
        ..BBBBB........................AAAAAAAAA......
        .................................AAAAAA.......
    "#]]
    .assert_eq(&picture(&map));
}

#[test]
fn a_hall_of_one_pattern_is_one_region() {
    let map = find(&one_hall(), RegionOptions::default());
    expect![[r#"
        1.00 at -72.8 17.2
    "#]]
    .assert_eq(&summary(&map));
}

#[test]
fn the_box_of_a_region_holds_its_known_cells_tightly() {
    let map = find(&one_hall(), RegionOptions::default());
    let bounds = map.regions[0].bounds;
    assert!((bounds.center - Point::new(30.0, 25.0)).norm() < 0.2, "{bounds:?}");
    let mut sides = bounds.half_extents;
    sides.sort_by(f64::total_cmp);
    assert!((sides[0] - 18.0).abs() < 0.2 && (sides[1] - 25.0).abs() < 0.2, "{bounds:?}");
}

#[test]
fn a_given_number_of_regions_is_kept_and_a_single_one_is_the_whole_map() {
    let two = find(&one_hall(), RegionOptions { count: Some(2), ..texture() });
    assert_eq!(two.regions.len(), 2);
    let one = find(&two_halls(), RegionOptions { method: RegionMethod::Single, ..RegionOptions::default() });
    expect![[r#"
        1.00 at -85.0 -28.0 5.0 62.0
    "#]]
    .assert_eq(&summary(&one));
    assert_eq!(find(&two_halls(), RegionOptions { count: Some(1), ..texture() }), one);
}

#[test]
fn every_known_cell_has_a_region_and_the_shares_are_whole() {
    let grid = two_halls();
    for count in [None, Some(3), Some(16)] {
        let map = find(&grid, RegionOptions { count, ..texture() });
        for row in 0..grid.height() {
            for (column, &cell) in grid.row(row).iter().enumerate() {
                let region = map.region_of_cell(column, row);
                assert!(cell == Occupancy::Unknown || usize::from(region.unwrap()) < map.regions.len());
            }
        }
        assert!((map.regions.iter().map(|region| region.share).sum::<f64>() - 1.0).abs() < 1e-9);
    }
}

#[test]
fn a_region_without_orientations_takes_those_of_the_map() {
    let halls = [Hall { center: [20.0, 22.0], size: [36.0, 34.0], angle_deg: 5.0 }];
    let grid = test_maps::draw(&halls, [92.0, 44.0], 0.1);
    // The right half is an empty yard.
    let cells = (0..grid.height()).flat_map(|row| {
        let yard = move |column: usize| (480..900).contains(&column) && (60..400).contains(&row);
        let cells = grid.row(row).iter().enumerate();
        cells.map(move |(column, &cell)| if yard(column) { Occupancy::Free } else { cell })
    });
    let grid = OccupancyGrid::new(grid.width(), grid.height(), *grid.frame(), cells.collect());
    let map = find(&grid, RegionOptions { count: Some(2), ..texture() });
    expect![[r#"
        0.42 at -85.1 5.0
        0.58 at -85.0 5.0
    "#]]
    .assert_eq(&summary(&map));
}

#[test]
fn degenerate_grids_have_no_or_one_region() {
    let frame = GridFrame { resolution: 0.05, origin: Point::origin(), yaw: 0.0 };
    for (width, height) in [(0, 0), (0, 7), (7, 0), (1, 1), (3, 200), (90, 70)] {
        for cell in [Occupancy::Free, Occupancy::Occupied, Occupancy::Unknown] {
            let grid = OccupancyGrid::new(width, height, frame, vec![cell; width * height]);
            for count in [None, Some(1), Some(5)] {
                let map = find(&grid, RegionOptions { count, ..texture() });
                let known = cell != Occupancy::Unknown && width * height > 0;
                assert_eq!(map.regions.is_empty(), !known, "{width} x {height}, {cell:?}, {count:?}");
                assert_eq!(map.tiles.len(), map.columns * map.rows);
            }
        }
    }
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let grid = two_halls();
    let on_threads = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| find(&grid, RegionOptions::default()))
    };
    let one = on_threads(1);
    assert_eq!(one, on_threads(2));
    assert_eq!(one, on_threads(7));
}

#[test]
fn regions_of_real_maps() {
    let check = |name: &str, resolution: f64, wanted: Expect| {
        if let Some(grid) = test_maps::real(name, resolution) {
            wanted.assert_eq(&summary(&find(&grid, RegionOptions::default())));
        }
    };
    check(
        "office__halmstad_F5_05",
        0.02,
        expect![[r#"
            1.00 at -4.8 85.2
        "#]],
    );
    check(
        "office__pal_office",
        0.05,
        expect![[r#"
            1.00 at -76.0 14.0
        "#]],
    );
    check(
        "warehouse__aws_small_005_rotated",
        0.05,
        expect![[r#"
        1.00 at -90.0 0.0
    "#]],
    );
    check(
        "warehouse__svl_warehouse_dt_pallets",
        0.05,
        expect![[r#"
        1.00 at -90.0 0.0
    "#]],
    );
}
