//! Routes through drawn warehouses.

mod vehicles;

use super::*;
use crate::arrangement::FaceId;
use crate::geometry::Point;
use crate::grid::Occupancy;
use crate::layout::Location;
use crate::semantics::pictures::{DrawnMap, RESOLUTION};
use crate::semantics::{Assignment, RuleSet, SemanticMap, apply};
use expect_test::{Expect, expect};
use proptest::prelude::*;

/// Two racks that hold free ground, an aisle above, between and below, joined by a cross aisle on the right.
fn warehouse() -> DrawnMap {
    DrawnMap::new(
        "
        ..............
        ..............
        ..##..####....
        ..##..####....
        ..............
        ..............
        ####..####....
        ####..####....
        ..............
        ......#.......
        ",
        "
        ccccccccccjjjj
        ccccccccccjjjj
        ppqqppqqppjjjj
        ppqqppqqppjjjj
        ddddddddddjjjj
        ddddddddddjjjj
        ppqqppqqppjjjj
        ppqqppqqppjjjj
        ccccccccccjjjj
        ccccccccccjjjj
        ",
    )
}

/// Whether a segment passes through the inside of a cell: clips it to the cell, slab by slab.
fn passes_through(start: Point, end: Point, column: usize, row: usize) -> bool {
    let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
    for (axis, cell) in [column, row].into_iter().enumerate() {
        let (low, high) = (cell as f64 * RESOLUTION, (cell + 1) as f64 * RESOLUTION);
        let way = end[axis] - start[axis];
        if way == 0.0 {
            if start[axis] <= low || start[axis] >= high {
                return false;
            }
            continue;
        }
        let (first, second) = ((low - start[axis]) / way, (high - start[axis]) / way);
        enters = enters.max(first.min(second));
        leaves = leaves.min(first.max(second));
    }
    leaves - enters > 1e-9
}

/// Every cell that a path passes through is free and drivable, and the route gives its own length and faces.
fn check_invariants(map: &DrawnMap, semantic: &SemanticMap, route: &Route) {
    assert!(route.path.len() >= 2);
    for pair in route.path.windows(2) {
        for (row, column) in (0..map.grid.height()).flat_map(|row| (0..map.grid.width()).map(move |c| (row, c))) {
            if passes_through(pair[0], pair[1], column, row) {
                assert_eq!(map.grid.row(row)[column], Occupancy::Free, "cell {column},{row} of {pair:?}");
                let face = map.cells.faces.at(column, row);
                let is_lead = [route.faces[0], route.faces[route.faces.len() - 1]].contains(&face);
                assert!(is_lead || semantic.label(face).is_drivable(), "cell {column},{row} of {pair:?}");
            }
        }
    }
    let subdivision = &map.analysis.subdivision;
    assert_eq!(route.edges.len() + 1, route.faces.len());
    for (pair, &edge) in route.faces.windows(2).zip(&route.edges) {
        let mut sides = subdivision.sides(edge);
        sides.sort_unstable();
        let mut pair = [pair[0], pair[1]];
        pair.sort_unstable();
        assert_eq!(sides, pair, "an edge lies between the faces before and after it");
    }
}

/// Draws a path over the cells: `o` where it passes.
fn draw(map: &DrawnMap, route: &Route) -> String {
    map.draw(|column, row| {
        let on_path = route.path.windows(2).any(|pair| passes_through(pair[0], pair[1], column, row));
        match map.grid.row(row)[column] {
            _ if on_path => 'o',
            Occupancy::Free => '.',
            Occupancy::Occupied => '#',
            Occupancy::Unknown => ' ',
        }
    })
}

/// The route of a point.
fn shortest(map: &DrawnMap, semantic: &SemanticMap, from: &Waypoint<'_>, to: &Waypoint<'_>) -> Result<Route, NoRoute> {
    let site = map.site(semantic);
    Router::new(&site, 0.0).route(&site, from, to, &Preferences::default())
}

fn check(map: &DrawnMap, from: &Waypoint<'_>, to: &Waypoint<'_>, expected: &Expect) {
    let semantic = map.semantic(&RuleSet::warehouse());
    let report = match shortest(map, &semantic, from, to) {
        Ok(route) => {
            check_invariants(map, &semantic, &route);
            let faces: String = route.faces.iter().map(|&face| map.letter(face)).collect();
            let edges: Vec<u32> = route.edges.iter().map(|edge| edge.0).collect();
            format!("{}{:.2} m, faces {faces}, edges {edges:?}\n", draw(map, &route), route.length)
        }
        Err(problem) => format!("{problem:?}\n"),
    };
    expected.assert_eq(&report);
}

fn point(map: &DrawnMap, column: usize, line: usize) -> Waypoint<'static> {
    Waypoint::Point(map.point_at(column, line))
}

fn location(map: &DrawnMap, column: usize, line: usize) -> Location {
    let face = map.face_at(column, line);
    let locations = map.layout(&map.semantic(&RuleSet::warehouse())).locations;
    locations.into_iter().find(|location| location.face == face).unwrap()
}

#[test]
fn routes_lead_around_racks_and_never_through_storage() {
    let map = warehouse();
    // Straight down through the empty place would be 2 m.
    check(
        &map,
        &point(&map, 0, 1),
        &point(&map, 0, 4),
        &expect![[r#"
        ..............
        ooooooooooo...
        ..##..####o...
        ..##..####o...
        ooooooooooo...
        ..............
        ####..####....
        ####..####....
        ..............
        ......#.......
        11.50 m, faces cjd, edges [40, 22]
    "#]],
    );
    check(
        &map,
        &point(&map, 0, 0),
        &point(&map, 5, 9),
        &expect![[r#"
        oooooo........
        .....oooooo...
        ..##..####o...
        ..##..####o...
        ..........o...
        ..........o...
        ####..####o...
        ####..####o...
        .....oooooo...
        .....o#.......
        11.52 m, faces cjc, edges [40, 3]
    "#]],
    );
}

#[test]
fn a_route_to_a_location_ends_at_its_access_edge() {
    let map = warehouse();
    check(
        &map,
        &Waypoint::Location(&location(&map, 0, 2)),
        &Waypoint::Location(&location(&map, 2, 6)),
        &expect![[r#"
            ..............
            ..............
            ..##..####....
            ..##..####....
            .ooooo........
            ......ooooo...
            ####..####o...
            ####..####o...
            ..ooooooooo...
            ......#.......
            10.03 m, faces djc, edges [22, 3]
        "#]],
    );
}

#[test]
fn a_route_may_end_where_it_begins() {
    let map = warehouse();
    check(
        &map,
        &point(&map, 0, 0),
        &point(&map, 0, 0),
        &expect![[r#"
        o.............
        ..............
        ..##..####....
        ..##..####....
        ..............
        ..............
        ####..####....
        ####..####....
        ..............
        ......#.......
        0.00 m, faces c, edges []
    "#]],
    );
    check(
        &map,
        &point(&map, 0, 0),
        &Waypoint::Face(map.face_at(0, 0)),
        &expect![[r#"
            oooooo........
            ..............
            ..##..####....
            ..##..####....
            ..............
            ..............
            ####..####....
            ####..####....
            ..............
            ......#.......
            2.50 m, faces c, edges []
        "#]],
    );
}

#[test]
fn a_face_whose_node_is_blocked_is_entered_beside_it() {
    let map = DrawnMap::new(
        "
        .....
        .###.
        .....
        ",
        "
        cjjjj
        cjjjj
        cjjjj
        ",
    );
    check(
        &map,
        &point(&map, 0, 1),
        &Waypoint::Face(map.face_at(1, 0)),
        &expect![[r#"
        .....
        o###.
        ooo..
        1.50 m, faces cj, edges [3]
    "#]],
    );
}

#[test]
fn corners_are_not_cut() {
    let map = DrawnMap::new(
        "
        .#.
        #..
        ...
        ",
        "
        ccc
        ccc
        ccc
        ",
    );
    check(
        &map,
        &point(&map, 0, 0),
        &point(&map, 1, 1),
        &expect![[r#"
            Disconnected { from: FaceId(1), to: FaceId(1) }
        "#]],
    );
    check(
        &map,
        &point(&map, 0, 2),
        &point(&map, 2, 0),
        &expect![[r#"
            .#o
            #oo
            oo.
            1.62 m, faces c, edges []
        "#]],
    );
}

#[test]
fn a_face_thinner_than_a_cell_is_crossed_if_it_is_drivable() {
    // Two lines between the centres of the first and the second column.
    let lines = [0.3, 0.4].map(|x| [Point::new(x, 0.0), Point::new(x, 0.5)]);
    let map = DrawnMap::with_lines("...", "ccc", &lines);
    let (rules, sliver) = (RuleSet::warehouse(), map.analysis.face_categories.unknown());
    let ends = [0, 2].map(|column| point(&map, column, 0));
    let through = |label: &str| {
        let assignment = [(0, "co".to_owned()), (sliver, label.to_owned())].into();
        let semantic = apply(&map.analysis, &rules, &Assignment { assignment, ..Assignment::default() }).unwrap();
        shortest(&map, &semantic, &ends[0], &ends[1])
    };
    let route = through("ju").unwrap();
    assert_eq!((route.faces.len(), route.edges.len()), (3, 2));
    assert!(matches!(through("pc"), Err(NoRoute::Disconnected { .. })));
}

#[test]
fn each_reason_for_no_route_is_told() {
    let map = DrawnMap::new(
        "
        ..#..##..
        ..#..##..
        .#.....#.
        .#.....#.
        ",
        "
        ccccjpqdd
        ccccjpqdd
        cccwwwwdd
        cccwwwwdd
        ",
    );
    let here = point(&map, 0, 0);
    check(
        &map,
        &Waypoint::Point(Point::new(-1.0, 0.0)),
        &here,
        &expect![[r#"
            CannotStand { end: Start, ground: Outside, nearest: Some([0.25, 0.25]) }
        "#]],
    );
    check(
        &map,
        &here,
        &Waypoint::Face(FaceId(99)),
        &expect![[r#"
            CannotStand { end: Goal, ground: Outside, nearest: None }
        "#]],
    );
    check(
        &map,
        &here,
        &point(&map, 3, 3),
        &expect![[r#"
            Disconnected { from: FaceId(1), to: FaceId(1) }
        "#]],
    );
    check(
        &map,
        &here,
        &point(&map, 2, 0),
        &expect![[r#"
            CannotStand { end: Goal, ground: Occupied, nearest: Some([0.75, 1.75]) }
        "#]],
    );
    check(
        &map,
        &here,
        &Waypoint::Location(&location(&map, 5, 0)),
        &expect![[r#"
            Disconnected { from: FaceId(1), to: FaceId(3) }
        "#]],
    );
    check(
        &map,
        &here,
        &point(&map, 8, 0),
        &expect![[r#"
            Disconnected { from: FaceId(1), to: FaceId(3) }
        "#]],
    );
    check(
        &map,
        &here,
        &point(&map, 4, 0),
        &expect![[r#"
            Disconnected { from: FaceId(1), to: FaceId(4) }
        "#]],
    );
}

#[test]
fn all_pairs_of_faces_and_locations_have_sound_routes() {
    let map = warehouse();
    let semantic = map.semantic(&RuleSet::warehouse());
    let faces = map.analysis.subdivision.faces().filter(|&face| semantic.label(face).is_drivable());
    let locations = map.layout(&semantic).locations;
    let mut ends: Vec<Waypoint<'_>> = faces.map(Waypoint::Face).collect();
    ends.extend(locations.iter().map(Waypoint::Location));
    for from in &ends {
        for to in &ends {
            let there = shortest(&map, &semantic, from, to).unwrap();
            check_invariants(&map, &semantic, &there);
            let back = shortest(&map, &semantic, to, from).unwrap();
            assert!((there.length - back.length).abs() < 0.1 * there.length + 0.1, "{from:?} {to:?}");
        }
    }
}

proptest! {
    /// Whatever stands in the way: a path is sound, at least as long as the straight line, and missing only where
    /// the cells do not hang together.
    #[test]
    fn paths_are_sound_among_any_obstacles(
        cells in proptest::collection::vec(0_u8..10, 15 * 12),
        ends in [(0_usize..15, 0_usize..12), (0_usize..15, 0_usize..12)],
        shift in [0.0_f64..1.0, 0.0_f64..1.0],
    ) {
        let rows: Vec<String> = cells
            .chunks(15)
            .map(|row| row.iter().map(|&cell| if cell < 3 { '#' } else { '.' }).collect())
            .collect();
        let faces = ["ccccccccjjjjjjj", "ccccccccjjjjjjj", "ddddddddjjjjjjj", "ddddpqddjjjjjjj"];
        let faces: Vec<&str> = (0..12).map(|line| faces[line / 3]).collect();
        let map = DrawnMap::new(&rows.join("\n"), &faces.join("\n"));
        let semantic = map.semantic(&RuleSet::warehouse());
        let end = |(column, line): (usize, usize)| {
            let offset = crate::geometry::Vector::new(shift[0] - 0.5, shift[1] - 0.5) * RESOLUTION;
            map.point_at(column, line) + offset
        };
        let [start, goal] = ends.map(end);
        match shortest(&map, &semantic, &Waypoint::Point(start), &Waypoint::Point(goal)) {
            Ok(route) => {
                check_invariants(&map, &semantic, &route);
                // Off ground that is not drivable it begins at the middle of a cell.
                prop_assert!(route.length >= (goal - start).norm() - 2.0 * RESOLUTION);
                let are_drivable = [start, goal].iter().all(|&end| map.site(&semantic).is_drivable(map.site(&semantic).face_at(end)));
                if are_drivable {
                    prop_assert_eq!((route.path[0], *route.path.last().unwrap()), (start, goal));
                    prop_assert!(hang_together(&map, &semantic, start, goal));
                }
            }
            Err(NoRoute::TooNarrow { .. } | NoRoute::Disconnected { .. }) => {
                prop_assert!(!hang_together(&map, &semantic, start, goal));
            }
            Err(NoRoute::CannotStand { .. } | NoRoute::NotDrivable { .. }) => {}
            Err(other) => prop_assert!(false, "{:?}", other),
        }
    }
}

/// Whether drivable free cells join two points over their sides.
fn hang_together(map: &DrawnMap, semantic: &SemanticMap, start: Point, goal: Point) -> bool {
    let cell = |point| map.grid.cell_at(point).unwrap();
    let mut seen = vec![cell(start)];
    let mut next = 0;
    while let Some(&(column, row)) = seen.get(next) {
        next += 1;
        for (right, up) in [(1, 0), (-1, 0), (0, 1), (0, -1)] {
            let (column, row) = (column as i64 + right, row as i64 + up);
            let side = (column as usize, row as usize);
            let free = map.grid.at(column, row) == Occupancy::Free;
            if free && semantic.label(map.cells.faces.at(side.0, side.1)).is_drivable() && !seen.contains(&side) {
                seen.push(side);
            }
        }
    }
    seen.contains(&cell(goal))
}
