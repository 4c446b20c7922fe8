//! Routes through drawn warehouses.

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

/// Aisles of 2 m and one of 1 m between them, which leads to the upper part on the shorter way.
fn two_ways() -> DrawnMap {
    DrawnMap::new(
        "
        ....................
        ....................
        ....................
        ....................
        ....................
        ######..########....
        ######..########....
        ######..########....
        ######..########....
        ....................
        ....................
        ....................
        ....................
        ....................
        ",
        "
        cccccccccccccccccccc
        cccccccccccccccccccc
        cccccccccccccccccccc
        cccccccccccccccccccc
        cccccccccccccccccccc
        ppppppddppppppppjjjj
        ppppppddppppppppjjjj
        qqqqqqddqqqqqqqqjjjj
        qqqqqqddqqqqqqqqjjjj
        cccccccccccccccccccc
        cccccccccccccccccccc
        cccccccccccccccccccc
        cccccccccccccccccccc
        cccccccccccccccccccc
        ",
    )
}

/// The route of a vehicle, and whether it goes through the narrow aisle.
fn route_of(
    map: &DrawnMap,
    radius: f64,
    blocked: Blocked,
    preferences: &Preferences,
) -> Result<(Route, bool), NoRoute> {
    let semantic = map.semantic(&RuleSet::warehouse());
    let site = map.site(&semantic);
    let router = Router::new(&site, radius);
    let router = if blocked.is_empty() { router } else { std::sync::Arc::new(router).around(&site, blocked) };
    let route = router.route(&site, &point(map, 3, 2), &point(map, 3, 11), preferences)?;
    let is_narrow = route.faces.contains(&map.face_at(6, 6));
    Ok((route, is_narrow))
}

#[test]
fn wide_vehicles_take_the_wide_aisle_and_keep_clear() {
    let map = two_ways();
    let plain = Preferences::default();
    let (through, is_narrow) = route_of(&map, 0.2, Blocked::default(), &plain).unwrap();
    assert!(is_narrow && through.clearance >= 0.2, "{through:?}");
    let (around, is_narrow) = route_of(&map, 0.6, Blocked::default(), &plain).unwrap();
    assert!(!is_narrow && around.clearance >= 0.6 && around.length > through.length, "{around:?}");
    let Err(NoRoute::TooNarrow { clearance, at }) = route_of(&map, 0.9, Blocked::default(), &plain) else {
        panic!("nothing is wide enough")
    };
    assert!(clearance < 0.9 && (2.0..5.0).contains(&at.y), "{clearance} at {at}");
}

#[test]
fn long_vehicles_pass_where_they_cannot_turn() {
    let map = two_ways();
    let semantic = map.semantic(&RuleSet::warehouse());
    let site = map.site(&semantic);
    let route = |half_length: f64| {
        let corners = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
        let corners = corners.map(|(x, y)| Point::new(x * half_length, y * 0.2));
        let outline = VehicleOutline::new(&corners).unwrap();
        let [turning, passing] =
            [outline.turning_radius(), outline.passing_radius()].map(|radius| Router::new(&site, radius));
        let routers = OutlineRouters { turning: &turning, passing: &passing };
        routers.route(&site, &outline, &point(&map, 3, 2), &point(&map, 3, 11), &Preferences::default())
    };
    let narrow = map.face_at(6, 6);
    for half_length in [0.45, 0.55, 0.6] {
        let short = route(half_length).unwrap();
        assert!(short.faces.contains(&narrow), "{short:?}");
        assert!(!is_touched(&map, &short.path, half_length), "{short:?}");
        let disc = route_of(&map, half_length.hypot(0.2), Blocked::default(), &Preferences::default()).unwrap();
        assert!(!disc.1, "the circle around it does not fit into the narrow aisle");
    }
    assert!(matches!(route(1.5), Err(NoRoute::CannotTurn { .. })), "{:?}", route(1.5));
}

/// Whether a vehicle of 0.4 m width touches a cell anywhere on a path: points of its sides at small steps and angles.
fn is_touched(map: &DrawnMap, path: &[Point], half_length: f64) -> bool {
    let sides = (-10..=10).map(f64::from).flat_map(|share| {
        let (x, y) = (share / 10.0 * half_length, share / 10.0 * 0.2);
        [(x, 0.2), (x, -0.2), (half_length, y), (-half_length, y)]
    });
    let sides: Vec<(f64, f64)> = sides.collect();
    let touches = |at: Point, angle: f64| {
        let is_free = |&(x, y): &(f64, f64)| {
            let corner = at + crate::geometry::direction(angle) * x + crate::geometry::normal(angle) * y;
            map.grid.cell_at(corner).is_some_and(|(column, row)| map.grid.row(row)[column] == Occupancy::Free)
        };
        !sides.iter().all(is_free)
    };
    let angles: Vec<f64> = path.windows(2).map(|pair| pair[1] - pair[0]).map(|way| way.y.atan2(way.x)).collect();
    let along = path.windows(2).zip(&angles).any(|(pair, &angle)| {
        (0..=50).any(|step| touches(pair[0] + (pair[1] - pair[0]) * (f64::from(step) / 50.0), angle))
    });
    let turning = angles.windows(2).zip(&path[1..]).any(|(pair, &at)| {
        let turn = (pair[1] - pair[0]).sin().atan2((pair[1] - pair[0]).cos());
        (0..=20).any(|step| touches(at, pair[0] + turn * f64::from(step) / 20.0))
    });
    along || turning
}

#[test]
fn what_is_blocked_is_driven_around_until_nothing_is_left() {
    let map = two_ways();
    let plain = Preferences::default();
    let narrow = Blocked { faces: [map.face_at(6, 6)].into(), ..Blocked::default() };
    assert!(!route_of(&map, 0.2, narrow.clone(), &plain).unwrap().1);
    let edges = map.analysis.graph.links(map.face_at(6, 6)).iter().map(|&(edge, _)| edge).collect();
    assert!(!route_of(&map, 0.2, Blocked { edges, ..Blocked::default() }, &plain).unwrap().1);
    let both = Blocked { faces: [map.face_at(6, 6), map.face_at(17, 6)].into(), ..Blocked::default() };
    assert_eq!(route_of(&map, 0.2, both, &plain), Err(NoRoute::CutOff));
    let here = Blocked { faces: [map.face_at(3, 2)].into(), ..Blocked::default() };
    assert!(matches!(route_of(&map, 0.2, here, &plain), Err(NoRoute::EndBlocked { end: RouteEnd::Start, .. })));
}

#[test]
fn preferences_may_cost_a_longer_way() {
    let map = two_ways();
    let semantic = map.semantic(&RuleSet::warehouse());
    let corridor = semantic.labels[map.face_at(6, 6).index()];
    let mut label_costs = vec![1.0; semantic.rule_set.labels().len()];
    label_costs[usize::from(corridor.0)] = 1.0;
    let plain = Preferences { label_costs, ..Preferences::default() };
    assert!(route_of(&map, 0.2, Blocked::default(), &plain).unwrap().1);
    let clear = Preferences { profile: RouteProfile::Clearance, ..Preferences::default() };
    let (route, _) = route_of(&map, 0.2, Blocked::default(), &clear).unwrap();
    let (shortest, _) = route_of(&map, 0.2, Blocked::default(), &Preferences::default()).unwrap();
    assert!(route.clearance >= shortest.clearance && route.length >= shortest.length);
}

#[test]
fn alternatives_differ() {
    // Three tiles wide, so that the ways do not share theirs.
    let picture = |free: char, wall: char| {
        let line = |is_open: bool| {
            (0..200).map(|column| if is_open || !(8..192).contains(&column) { free } else { wall }).collect::<String>()
        };
        (0..140).map(|row| line(!(8..132).contains(&row))).collect::<Vec<_>>().join("\n")
    };
    let map = DrawnMap::new(&picture('.', '#'), &picture('c', 'p'));
    let semantic = map.semantic(&RuleSet::warehouse());
    let site = map.site(&semantic);
    let router = Router::new(&site, 0.4);
    let ends = [Waypoint::Point(map.point_at(3, 3)), Waypoint::Point(map.point_at(196, 136))];
    let routes = router.alternatives(&site, &ends[0], &ends[1], &Preferences::default(), 3).unwrap();
    assert_eq!(routes.len(), 2, "there are two ways around");
    let middle = |route: &Route| route.path.iter().any(|point| point.x < 10.0 && point.y < 10.0);
    assert_ne!(middle(&routes[0]), middle(&routes[1]));
}

#[test]
fn a_matrix_has_the_lengths_of_routes() {
    let map = warehouse();
    let semantic = map.semantic(&RuleSet::warehouse());
    let site = map.site(&semantic);
    let router = Router::new(&site, 0.2);
    let layout = map.layout(&semantic);
    let mut ends: Vec<Waypoint<'_>> = layout.locations.iter().map(Waypoint::Location).collect();
    ends.push(Waypoint::Point(Point::new(-5.0, 0.0)));
    let matrix = router.matrix(&site, &ends, &ends);
    for (from, row) in ends.iter().zip(&matrix) {
        for (to, &length) in ends.iter().zip(row) {
            let route = router.route(&site, from, to, &Preferences::default()).ok().map(|route| route.length);
            match (length, route) {
                (Some(length), Some(route)) => assert!(length >= route - 0.05 && length <= 1.1 * route + 0.5),
                (length, route) => assert_eq!(length.is_some(), route.is_some()),
            }
        }
    }
}
