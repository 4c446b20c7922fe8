//! Offices drawn in characters, and which rooms and doors they have.

use expect_test::{Expect, expect};
use proptest::prelude::*;

use super::*;
use crate::annotation::{self, PlannedGround};
use crate::arrangement::{self, CellFaces, FaceId, Subdivision};
use crate::geometry::{OrientedBox, Point, direction, normal};
use crate::grid::{GridFrame, Occupancy, OccupancyGrid};
use crate::plot::PlotKind;
use crate::rooms::RoomMap;
use crate::segmentation::{Region, RegionMap};
use crate::spec::{AnalysisOptions, DecompositionOptions};
use crate::test_maps::{
    self,
    real_maps::{Picture, find_folder},
};
use crate::watch::Watch;

/// Every character of a drawing is so many cells wide and high.
const ENLARGED: usize = 4;
/// Side of a cell, metres: a character is 0.2 m.
const CELL: f64 = 0.05;

fn drawn(picture: &str) -> OccupancyGrid {
    let small = OccupancyGrid::from_ascii(picture, CELL * ENLARGED as f64);
    let (width, height) = (small.width() * ENLARGED, small.height() * ENLARGED);
    let cell = |index: usize| small.row(index / width / ENLARGED)[index % width / ENLARGED];
    let frame = GridFrame { resolution: CELL, origin: Point::origin(), yaw: 0.0 };
    OccupancyGrid::new(width, height, frame, (0..width * height).map(cell).collect())
}

/// A grid of some columns and rows; `at` gives the occupancy at the centre of a cell, metres.
fn grid_of(columns: usize, rows: usize, at: impl Fn(Point) -> Occupancy) -> OccupancyGrid {
    let center = |index: usize| Point::new((index % columns) as f64 + 0.5, (index / columns) as f64 + 0.5) * CELL;
    let frame = GridFrame { resolution: CELL, origin: Point::origin(), yaw: 0.0 };
    OccupancyGrid::new(columns, rows, frame, (0..columns * rows).map(|index| at(center(index))).collect())
}

/// The grid as one region of one direction.
fn one_region(grid: &OccupancyGrid) -> RegionMap {
    let tile_cells = grid.width().max(grid.height()).max(1);
    let bounds = OrientedBox { center: Point::origin(), half_extents: [0.0; 2], angle: 0.0 };
    let region = Region { orientations: vec![0.0], bounds, share: 1.0 };
    RegionMap { tile_cells, columns: 1, rows: 1, tiles: vec![0], regions: vec![region] }
}

/// The plan of a grid, and the rooms and doors of its subdivision.
fn planned(grid: &OccupancyGrid) -> (SitePlan, RoomMap, Subdivision) {
    let (regions, watch) = (one_region(grid), Watch::unwatched());
    let plan = plan(grid, &regions, &DecompositionOptions::default(), &watch).expect("nobody stops it");
    let segments = arrangement::source_segments(grid, &regions, &plan.lines, &plan.rooms.cells, &watch);
    let subdivision = arrangement::arrange(&segments.expect("nobody stops it"), &watch).expect("nobody stops it");
    subdivision.check_invariants().expect("it is sound");
    let cells = CellFaces::of_grid(&subdivision, grid);
    let grounds = plan.rooms.of_faces(subdivision.face_count(), &cells, &watch).expect("nobody stops it");
    let planned = PlannedGround { plots: &plan.plots, grounds: &grounds };
    let options = AnalysisOptions::default().annotation;
    let subdivision = annotation::merge_alike(grid, &regions, subdivision, planned, &options, &watch).expect("no stop");
    let cells = CellFaces::of_grid(&subdivision, grid);
    let grounds = plan.rooms.of_faces(subdivision.face_count(), &cells, &watch).expect("nobody stops it");
    let rooms = RoomMap::of(&plan.rooms, &subdivision, &grounds);
    (plan, rooms, subdivision)
}

/// The area and the faces of every room, and what the doors join.
fn check(grid: &OccupancyGrid, expected: &Expect) {
    let (_, rooms, subdivision) = planned(grid);
    let mut lines = Vec::new();
    for room in 0..rooms.faces.iter().flatten().max().map_or(0, |&last| last + 1) {
        let faces: Vec<FaceId> = subdivision.faces().filter(|&face| rooms.room(face) == Some(room)).collect();
        let area: f64 = faces.iter().map(|&face| subdivision.area(face)).sum();
        lines.push(format!("room {room}: {area:.1} m2 in {} face", faces.len()));
    }
    for door in &rooms.doors {
        let [one, other] =
            door.faces.map(|face| rooms.room(face).map_or("outside".to_owned(), |room| room.to_string()));
        let middle = nalgebra::center(&door.ends[0], &door.ends[1]);
        lines.push(format!("door {one}|{other} of {:.2} m at ({:.1}, {:.1})", door.width(), middle.x, middle.y));
    }
    expected.assert_eq(&(lines.join("\n") + "\n"));
}

#[test]
fn rooms_open_to_a_corridor_through_doors() {
    check(
        &drawn(
            "
            ########################################
            #..................#...................#
            #..................#...................#
            #..................#...................#
            #..................#...................#
            #..................#...................#
            #..................#...................#
            #..................#...................#
            #..................#...................#
            #..................#...................#
            #..................#...................#
            #..................#...................#
            ########....###############....#########
            #......................................#
            #......................................#
            #......................................#
            #......................................#
            #......................................#
            #......................................#
            #......................................#
            ########################################
            ",
        ),
        &expect![[r#"
            room 0: 13.6 m2 in 1 face
            room 1: 9.8 m2 in 1 face
            room 2: 10.2 m2 in 1 face
            door 1|0 of 0.85 m at (2.0, 1.6)
            door 2|0 of 0.85 m at (5.8, 1.6)
        "#]],
    );
}

/// The letter of what every cell is in, a character each: corridor, junction, room, hall, goods.
fn kinds(grid: &OccupancyGrid) -> String {
    let areas = planned(grid).0.rooms;
    let letter = |cell: usize| match (areas.cells[cell] as usize).checked_sub(1).map(|area| {
        match area.checked_sub(areas.count) {
            Some(part) => areas.parts[part].kind,
            None => areas.kinds[area],
        }
    }) {
        Some(PlotKind::Corridor) => 'c',
        Some(PlotKind::Junction) => 'j',
        Some(PlotKind::Room) => 'r',
        Some(PlotKind::OpenFloor) => 'h',
        Some(PlotKind::Place) => 'g',
        _ => ' ',
    };
    let (width, middle) = (grid.width(), ENLARGED / 2);
    let row = |row: usize| {
        (0..width / ENLARGED)
            .map(|column| letter((row * ENLARGED + middle) * width + column * ENLARGED + middle))
            .collect::<String>()
    };
    (0..grid.height() / ENLARGED).rev().map(|number| row(number).trim_end().to_owned() + "\n").collect()
}

#[test]
fn corridors_are_long_and_have_doors_and_meet_in_junctions() {
    expect![[r#"
        rrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrr
        rrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrr
        rrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrr
        rrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrr
        rrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrr
        rrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrr
        rrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrr
        rrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrr
        rrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrr
        rrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrr
        rrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrr
        rrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrr
        rrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrr
        rrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrr
        rrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrr
        rrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrr
        rrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrrr
        ccccccccccccccccccccccccccjjjjjjjjjjcccccccccccccccccccccccccc
        ccccccccccccccccccccccccccjjjjjjjjjjcccccccccccccccccccccccccc
        ccccccccccccccccccccccccccjjjjjjjjjjcccccccccccccccccccccccccc
        ccccccccccccccccccccccccccjjjjjjjjjjcccccccccccccccccccccccccc
        ccccccccccccccccccccccccccjjjjjjjjjjcccccccccccccccccccccccccc
        ccccccccccccccccccccccccccjjjjjjjjjjcccccccccccccccccccccccccc
        ccccccccccccccccccccccccccjjjjjjjjjjcccccccccccccccccccccccccc
        ccccccccccccccccccccccccccjjjjjjjjjjcccccccccccccccccccccccccc
        ccccccccccccccccccccccccccjjjjjjjjjjcccccccccccccccccccccccccc
        ccccccccccccccccccccccccccjjjjjjjjjjcccccccccccccccccccccccccc
        ccccccccrrrrrcccccccccccccccccccccccccccccccccccrrrrrccccccccc
        rrrrrrrrrrrrrrrrrrrrrrrrrcccccccccccrrrrrrrrrrrrrrrrrrrrrrrrrr
        rrrrrrrrrrrrrrrrrrrrrrrrrcccccccccccrrrrrrrrrrrrrrrrrrrrrrrrrr
        rrrrrrrrrrrrrrrrrrrrrrrrrcccccccccccrrrrrrrrrrrrrrrrrrrrrrrrrr
        rrrrrrrrrrrrrrrrrrrrrrrrrcccccccccccrrrrrrrrrrrrrrrrrrrrrrrrrr
        rrrrrrrrrrrrrrrrrrrrrrrrrrccccccccccrrrrrrrrrrrrrrrrrrrrrrrrrr
        rrrrrrrrrrrrrrrrrrrrrrrrrrccccccccccrrrrrrrrrrrrrrrrrrrrrrrrrr
        rrrrrrrrrrrrrrrrrrrrrrrrrrccccccccccrrrrrrrrrrrrrrrrrrrrrrrrrr
        rrrrrrrrrrrrrrrrrrrrrrrrrrccccccccccrrrrrrrrrrrrrrrrrrrrrrrrrr
        rrrrrrrrrrrrrrrrrrrrrrrrrrccccccccccrrrrrrrrrrrrrrrrrrrrrrrrrr
        rrrrrrrrrrrrrrrrrrrrrrrrrrccccccccccrrrrrrrrrrrrrrrrrrrrrrrrrr
        rrrrrrrrrrrrrrrrrrrrrrrrrcccccccccccrrrrrrrrrrrrrrrrrrrrrrrrrr
        rrrrrrrrrrrrrrrrrrrrrrrrrcccccccccccrrrrrrrrrrrrrrrrrrrrrrrrrr
        rrrrrrrrrrrrrrrrrrrrrrrrrcccccccccccrrrrrrrrrrrrrrrrrrrrrrrrrr
        rrrrrrrrrrrrrrrrrrrrrrrrrcccccccccccrrrrrrrrrrrrrrrrrrrrrrrrrr
        rrrrrrrrrrrrrrrrrrrrrrrrrcccccccccccrrrrrrrrrrrrrrrrrrrrrrrrrr
        rrrrrrrrrrrrrrrrrrrrrrrrrcccccccccccrrrrrrrrrrrrrrrrrrrrrrrrrr
        rrrrrrrrrrrrrrrrrrrrrrrrrcccccccccccrrrrrrrrrrrrrrrrrrrrrrrrrr
    "#]]
    .assert_eq(&kinds(&drawn(
        "
        ##############################################################
        #...................#....................#...................#
        #...................#....................#...................#
        #...................#....................#...................#
        #...................#....................#...................#
        #...................#....................#...................#
        #...................#....................#...................#
        #...................#....................#...................#
        #...................#....................#...................#
        #...................#....................#...................#
        #...................#....................#...................#
        #...................#....................#...................#
        #...................#....................#...................#
        #...................#....................#...................#
        #...................#....................#...................#
        #...................#....................#...................#
        ########.....################.....##############.....#########
        #............................................................#
        #............................................................#
        #............................................................#
        #............................................................#
        #............................................................#
        #............................................................#
        #............................................................#
        #............................................................#
        #............................................................#
        #............................................................#
        ########.....#############..........############.....#########
        #........................#..........#........................#
        #........................#..........#........................#
        #........................#..........#........................#
        #........................#..........#........................#
        #...................................#........................#
        #...................................#........................#
        #...................................#........................#
        #...................................#........................#
        #...................................#........................#
        #........................#..........#........................#
        #........................#..........#........................#
        #........................#..........#........................#
        #........................#..........#........................#
        #........................#..........#........................#
        #........................#..........#........................#
        #........................#..........#........................#
        ##############################################################
        ",
    )));
}

#[test]
fn furniture_divides_nothing() {
    check(
        &drawn(
            "
            ##############################
            #............#...............#
            #............#...............#
            #...#..#.....#...####........#
            #............#...####........#
            #...#..#.....#...............#
            #.................#..#..#....#
            #............................#
            #............................#
            #............................#
            #............#....#..#..#....#
            #............#...............#
            ######.......#...............#
            ######.......#...............#
            ##############################
            ",
        ),
        &expect![[r#"
            room 0: 7.7 m2 in 1 face
            room 1: 9.9 m2 in 1 face
            door 0|1 of 0.85 m at (2.8, 1.4)
        "#]],
    );
}

/// A square of 12 m, turned by 30 degrees, with a wall across it that has a door of 1 m.
#[test]
fn slanted_walls_are_as_good_as_any() {
    let turn = 30_f64.to_radians();
    let grid = grid_of(400, 400, |center| {
        let offset = center - Point::new(10.0, 10.0);
        let (along, across) = (direction(turn).dot(&offset), normal(turn).dot(&offset));
        let is_wall = (along.abs().max(across.abs()) > 5.9) || (along - 1.0).abs() < 0.1 && (across - 2.0).abs() > 0.5;
        match along.abs().max(across.abs()) {
            far if far > 6.0 => Occupancy::Unknown,
            _ if is_wall => Occupancy::Occupied,
            _ => Occupancy::Free,
        }
    });
    check(
        &grid,
        &expect![[r#"
        room 0: 88.0 m2 in 1 face
        room 1: 63.3 m2 in 1 face
        door 0|1 of 1.01 m at (9.9, 12.2)
    "#]],
    );
}

#[test]
fn grids_without_ground_have_no_rooms() {
    for picture in ["", "?", "#", ".", "...\n...", "##\n##", "????\n????"] {
        let grid = OccupancyGrid::from_ascii(picture, 0.5);
        let (plan, rooms, _) = planned(&grid);
        assert_eq!((plan.rooms.count, rooms.doors.len()), (0, 0), "{picture}");
    }
}

/// Pallets in rows stay rows behind the wall of an office.
#[test]
fn an_office_in_the_corner_of_a_hall_is_a_room() {
    let grid = grid_of(480, 400, |Point { coords }| {
        let (x, y) = (coords.x, coords.y);
        let is_wall = |x: f64, y: f64| x < 0.1 || y < 0.1 || x > 23.9 || y > 19.9;
        let in_office = x < 5.0 && y < 4.0;
        let is_partition = in_office && (x > 4.9 && !(1.0..2.0).contains(&y) || y > 3.9);
        let (along, across) = (x - 3.0, (y - 7.0).rem_euclid(5.4));
        let in_row = (0.0..18.0).contains(&along) && across < 2.4 && (7.0..18.0).contains(&y);
        let is_block = |offset: f64| [0.1, 0.55, 1.0].iter().any(|&start| (start..start + 0.1).contains(&offset));
        let is_pallet = in_row && is_block(along % 1.2) && is_block(across % 1.2);
        if is_wall(x, y) || is_partition || is_pallet { Occupancy::Occupied } else { Occupancy::Free }
    });
    check(
        &grid,
        &expect![[r#"
        room 0: 19.6 m2 in 1 face
        door 0|outside of 1.05 m at (5.0, 1.5)
    "#]],
    );
    let (plan, ..) = planned(&grid);
    let places = plan.plots.iter().filter(|plot| plot.kind == PlotKind::Place);
    assert!(places.clone().count() >= 50 && places.clone().all(|plot| plot.bounds.center.y > 6.0));
}

/// A hall of pallets on the right, and a trailer at its left wall.
#[test]
fn a_bay_behind_a_gate_is_a_room_where_the_hall_is_one() {
    let hall = |has_pallets: bool| {
        grid_of(600, 400, move |Point { coords }| {
            let (x, y) = (coords.x - 6.0, coords.y);
            let is_gate = (11.0..14.0).contains(&y);
            if x < 0.0 {
                let is_inside = is_gate && x >= -5.0;
                let is_wall = (10.9..14.1).contains(&y) && x >= -5.1;
                return match (is_inside, is_wall) {
                    (true, _) => Occupancy::Free,
                    (_, true) => Occupancy::Occupied,
                    _ => Occupancy::Unknown,
                };
            }
            let is_wall = (x < 0.1 && !is_gate) || y < 0.1 || x > 23.9 || y > 19.9;
            let (along, across) = (x - 3.0, (y - 1.6).rem_euclid(5.4));
            let in_row = (0.0..18.0).contains(&along) && across < 2.4 && (1.6..17.0).contains(&y);
            let is_block = |offset: f64| [0.1, 0.55, 1.0].iter().any(|&start| (start..start + 0.1).contains(&offset));
            let is_pallet = has_pallets && in_row && is_block(along % 1.2) && is_block(across % 1.2);
            if is_wall || is_pallet { Occupancy::Occupied } else { Occupancy::Free }
        })
    };
    check(
        &hall(true),
        &expect![[r#"
        room 0: 18.0 m2 in 1 face
        door 0|outside of 3.05 m at (6.1, 12.5)
    "#]],
    );
    check(
        &hall(false),
        &expect![[r#"
        room 0: 499.8 m2 in 1 face
    "#]],
    );
}

/// White components of a picture of the true rooms, above 100 cells as in the evaluations of room segmentation. (There,
/// light grey walls are no ground; under the usual thresholds they are, which costs the first map a tenth or more.)
fn true_rooms(picture: &OccupancyGrid) -> Vec<u32> {
    let (width, cells) = (picture.width(), picture.cells());
    let mut rooms = vec![0; cells.len()];
    let mut next = 1;
    for first in 0..cells.len() {
        let (mut open, mut members) = (vec![first], Vec::new());
        while let Some(cell) = open.pop() {
            if cells[cell] == Occupancy::Free && rooms[cell] == 0 {
                rooms[cell] = next;
                members.push(cell);
                let around = [cell.wrapping_sub(width), cell.wrapping_sub(1), cell + 1, cell + width];
                open.extend(around.into_iter().filter(|&near| near < cells.len()));
            }
        }
        if members.len() > 100 {
            next += 1;
        } else {
            // Too small for a room, and not looked at again.
            for cell in members {
                rooms[cell] = u32::MAX;
            }
        }
    }
    rooms.into_iter().map(|room| if room == u32::MAX { 0 } else { room }).collect()
}

/// Panoptic quality (A. Kirillov et al. 2019): the overlaps of rooms above one half, over the mean number of
/// rooms.
fn panoptic_quality(found: &[u32], truth: &[u32]) -> f64 {
    use std::collections::BTreeMap;
    let (mut both, mut sizes, mut true_sizes) = (BTreeMap::new(), BTreeMap::new(), BTreeMap::new());
    for pair in found.iter().copied().zip(truth.iter().copied()) {
        *both.entry(pair).or_insert(0.0) += 1.0;
        *sizes.entry(pair.0).or_insert(0.0) += 1.0;
        *true_sizes.entry(pair.1).or_insert(0.0) += 1.0;
    }
    let iou = |(&(room, other), &common): (&(u32, u32), &f64)| common / (sizes[&room] + true_sizes[&other] - common);
    let is_room = |pair: &(&(u32, u32), &f64)| pair.0.0 != 0 && pair.0.1 != 0;
    let hits: f64 = both.iter().filter(is_room).map(iou).filter(|&iou| iou > 0.5).sum();
    let count = |sizes: &BTreeMap<u32, f64>| sizes.keys().filter(|&&room| room != 0).count();
    2.0 * hits / (count(&sizes) + count(&true_sizes)) as f64
}

#[test]
fn rooms_of_real_offices_are_those_that_people_drew() {
    for (name, least) in [("bormann__Freiburg52_scan", 0.80), ("bormann__lab_c_scan", 0.65)] {
        let Some(grid) = test_maps::real(name, CELL) else { return };
        let Some(folder) = find_folder(&format!("dev/{name}")) else { return };
        let truth = true_rooms(&Picture::read(&folder.join("gt_segmentation.png")).grid(CELL, 250, 251));
        let found = planned(&grid).0.rooms.cells;
        let on_ground = found.iter().zip(grid.cells());
        let on_ground = on_ground.map(|(&room, &cell)| if cell == Occupancy::Free { room } else { 0 });
        let quality = panoptic_quality(&on_ground.collect::<Vec<_>>(), &truth);
        assert!(quality > least, "{name}: {quality:.3}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn every_room_is_a_union_of_faces(walls in proptest::collection::vec((0_usize..40, 0_usize..40, any::<bool>()), 0..8)) {
        let side = 40;
        let mut picture = vec![b'.'; side * side];
        for (column, row, is_level) in walls {
            for step in 0..side {
                // A door of five characters.
                if !(10..15).contains(&step) {
                    picture[if is_level { row * side + step } else { step * side + column }] = b'#';
                }
            }
        }
        let rows: Vec<&str> = picture.chunks(side).map(|row| std::str::from_utf8(row).expect("it is ASCII")).collect();
        let grid = drawn(&rows.join("\n"));
        let (plan, rooms, subdivision) = planned(&grid);
        let found = rooms.faces.iter().flatten().max().map_or(0, |&last| last as usize + 1);
        prop_assert!(found <= plan.rooms.count);
        for door in &rooms.doors {
            let [one, other] = door.faces.map(|face| rooms.room(face));
            prop_assert!(one != other && !door.edges.is_empty());
            prop_assert_eq!(subdivision.sides(door.edges[0]), door.faces);
        }
    }
}
