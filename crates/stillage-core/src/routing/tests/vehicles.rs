//! Routes of vehicles with a width, around what is blocked, as people prefer them, and between many ends.

use super::*;

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
