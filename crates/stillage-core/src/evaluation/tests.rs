use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use expect_test::{Expect, expect};

use super::*;
use crate::geometry::{Point, direction, normal};
use crate::semantics::apply;
use crate::semantics::pictures::{DrawnMap, RESOLUTION, VEHICLE_RADIUS};

/// Two rows of places (letters p and q) along a corridor (c), and a junction (j); cells of half a metre.
fn map() -> DrawnMap {
    DrawnMap::new(
        "
        ####....
        ####....
        ........
        ........
        #.##....
        #.##....
        ",
        "
        ppqqjjjj
        ppqqjjjj
        ccccjjjj
        ccccjjjj
        ppqqjjjj
        ppqqjjjj
        ",
    )
}

/// The area of a rectangle of the drawing: columns and lines, the first line on top.
fn area(map: &DrawnMap, columns: std::ops::Range<usize>, lines: std::ops::Range<usize>) -> TrueArea {
    let height = map.grid.height();
    let corner = |column: usize, line: usize| Point::new(column as f64, (height - line) as f64) * RESOLUTION;
    let ring = vec![
        corner(columns.start, lines.end),
        corner(columns.end, lines.end),
        corner(columns.end, lines.start),
        corner(columns.start, lines.start),
    ];
    TrueArea::new(vec![vec![ring]])
}

fn place(map: &DrawnMap, columns: std::ops::Range<usize>, lines: std::ops::Range<usize>, region: &str) -> TruePlace {
    TruePlace { area: area(map, columns, lines), region: region.to_owned(), occupied: true, observed: 1.0 }
}

/// The truth that the map was drawn after.
fn truth(map: &DrawnMap) -> GroundTruth {
    GroundTruth {
        places: vec![
            place(map, 0..2, 0..2, "A"),
            place(map, 2..4, 0..2, "A"),
            place(map, 0..2, 4..6, "B"),
            place(map, 2..4, 4..6, "B"),
        ],
        corridors: vec![area(map, 0..4, 2..4)],
        junctions: vec![area(map, 4..8, 0..6)],
        regions: vec![TrueRegion { name: "A".to_owned(), angle: 0.0 }],
    }
}

fn report(map: &DrawnMap, truth: &GroundTruth, semantic: &SemanticMap) -> String {
    let evaluator = Evaluator::new(&map.analysis, truth, &Watch::unwatched()).unwrap();
    let scores = evaluator.score(semantic).unwrap();
    let places = |places: &PlaceScores| {
        let PlaceScores { places, strict, lax, area, geometry, systematic } = places;
        format!(
            "{places} places: strict {strict:.2} lax {lax:.2} area {area:.2} geometry {geometry:.2} systematic {systematic:.2}"
        )
    };
    let LabelOverlap { corridor, junction, pallet_cell, drivable } = scores.overlap;
    let mut lines = vec![scores.places.as_ref().map_or("no places".to_owned(), places)];
    lines.extend(scores.regions.iter().map(|(name, scores)| format!("{name} {}", places(scores))));
    lines.push(format!(
        "precision {:.2} f1 {:.2}, {} false, {} slivers",
        scores.precision, scores.f1, scores.false_cells, scores.slivers
    ));
    lines.push(format!("co {corridor:.4} ju {junction:.4} pc {pallet_cell:.4} drivable {drivable:.4}"));
    lines.push(format!("cogency {:.4}", scores.cogency.unwrap_or(f64::NAN)));
    lines.join("\n")
}

fn check(map: &DrawnMap, truth: &GroundTruth, expected: &Expect) {
    expected.assert_eq(&report(map, truth, &map.semantic(&RuleSet::warehouse())));
}

#[test]
fn what_is_drawn_after_the_truth_is_right() {
    let map = map();
    check(
        &map,
        &truth(&map),
        &expect![[r#"
            4 places: strict 1.00 lax 1.00 area 1.00 geometry 1.00 systematic 0.00
            A 2 places: strict 1.00 lax 1.00 area 1.00 geometry 1.00 systematic 0.00
            B 2 places: strict 1.00 lax 1.00 area 1.00 geometry 1.00 systematic 0.00
            precision 1.00 f1 1.00, 0 false, 0 slivers
            co 1.0000 ju 1.0000 pc 1.0000 drivable 1.0000
            cogency 1.0000"#]],
    );
}

#[test]
fn places_cut_in_two_pass_by_area_and_fail_strictly() {
    let map = DrawnMap::new(
        "
        ####....
        ####....
        ........
        ........
        #.##....
        #.##....
        ",
        "
        pqpqjjjj
        pqpqjjjj
        ccccjjjj
        ccccjjjj
        ppqqjjjj
        ppqqjjjj
        ",
    );
    check(
        &map,
        &truth(&map),
        &expect![[r#"
            4 places: strict 0.50 lax 1.00 area 1.00 geometry 0.50 systematic 0.00
            A 2 places: strict 0.00 lax 1.00 area 1.00 geometry 0.00 systematic 0.00
            B 2 places: strict 1.00 lax 1.00 area 1.00 geometry 1.00 systematic 0.00
            precision 0.33 f1 0.40, 4 false, 0 slivers
            co 1.0000 ju 1.0000 pc 1.0000 drivable 1.0000
            cogency 1.0000"#]],
    );
}

#[test]
fn empty_places_taken_for_corridor_are_systematic_and_unseen_ones_do_not_count() {
    let map = DrawnMap::new(
        "
        ####....
        ####....
        ........
        ........
        ..##....
        ..##....
        ",
        "
        ppqqjjjj
        ppqqjjjj
        ccccjjjj
        ccccjjjj
        ccqqjjjj
        ccqqjjjj
        ",
    );
    let mut truth = truth(&map);
    truth.places[2].occupied = false;
    truth.places[1].observed = 0.2;
    check(
        &map,
        &truth,
        &expect![[r#"
            3 places: strict 0.67 lax 0.67 area 0.67 geometry 0.67 systematic 0.33
            A 1 places: strict 1.00 lax 1.00 area 1.00 geometry 1.00 systematic 0.00
            B 2 places: strict 0.50 lax 0.50 area 0.50 geometry 0.50 systematic 0.50
            precision 1.00 f1 0.80, 0 false, 0 slivers
            co 0.6667 ju 1.0000 pc 0.7500 drivable 0.8889
            cogency 1.0000"#]],
    );
}

/// A polygon in metres of the grid frame, its outline first.
fn polygon(rings: &[&[(f64, f64)]]) -> TrueArea {
    let ring = |ring: &&[(f64, f64)]| ring.iter().map(|&(x, y)| Point::new(x, y)).collect();
    TrueArea::new(vec![rings.iter().map(ring).collect()])
}

/// The figures that the reference implementation (on shapely 2.2) gives for the same faces and truth.
#[test]
fn truth_that_lies_askew_gives_the_figures_of_the_reference() {
    let map = map();
    let askew = |ring: &[(f64, f64)], region: &str, observed: f64| TruePlace {
        area: polygon(&[ring]),
        region: region.to_owned(),
        occupied: true,
        observed,
    };
    let truth = GroundTruth {
        places: vec![
            askew(&[(0.1, 2.05), (1.05, 2.15), (0.95, 3.1), (0.0, 3.0)], "A", 1.0),
            askew(&[(1.4, 2.0), (2.3, 2.0), (2.3, 3.0), (1.4, 3.0)], "A", 1.0),
            TruePlace { occupied: false, ..askew(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)], "B", 0.6) },
            askew(&[(1.2, -0.2), (2.9, -0.2), (2.9, 0.9), (1.2, 0.9)], "B", 0.9),
        ],
        corridors: vec![polygon(&[&[(-0.2, 0.9), (2.4, 1.1), (2.4, 2.0), (1.5, 1.5), (-0.2, 2.0)]])],
        junctions: vec![polygon(&[
            &[(2.0, 0.0), (4.0, 0.0), (4.0, 3.0), (2.5, 3.0)],
            &[(3.0, 1.0), (3.5, 1.0), (3.5, 1.5), (3.0, 1.5)],
        ])],
        regions: Vec::new(),
    };
    // One face is labelled wrong.
    let storage = [2, 5, 6].map(|category| (category, "pc".to_owned()));
    let floor = [(0, "co".to_owned()), (1, "ju".to_owned())];
    let assignment = Assignment {
        assignment: storage.into_iter().chain(floor).collect(),
        overrides: [(map.face_at(0, 5).0, "co".to_owned())].into(),
    };
    let semantic = apply(&map.analysis, &RuleSet::warehouse(), &assignment).unwrap();
    expect![[r#"
        4 places: strict 0.25 lax 0.50 area 0.50 geometry 0.50 systematic 0.25
        A 2 places: strict 0.50 lax 1.00 area 1.00 geometry 0.50 systematic 0.00
        B 2 places: strict 0.00 lax 0.00 area 0.00 geometry 0.50 systematic 0.50
        precision 0.33 f1 0.29, 2 false, 0 slivers
        co 0.4004 ju 0.8333 pc 0.3973 drivable 0.7313
        cogency 0.7778"#]]
    .assert_eq(&report(&map, &truth, &semantic));
}

#[test]
fn a_person_takes_one_decision_per_category() {
    let map = map();
    let truth = truth(&map);
    let evaluator = Evaluator::new(&map.analysis, &truth, &Watch::unwatched()).unwrap();
    let decision = evaluator.decision(&RuleSet::warehouse()).unwrap();
    // 0 corridors, 1 junctions, 2 pallet cells, 5 faces without free cells.
    expect![[r#"{0: "co", 1: "ju", 2: "pc", 5: "pc"}"#]].assert_eq(&format!("{:?}", decision.assignment));
    let semantic = apply(&map.analysis, &RuleSet::warehouse(), &decision).unwrap();
    assert_eq!(evaluator.score(&semantic).unwrap().f1, 1.0);
    assert_eq!(evaluator.decision(&RuleSet::office()), Err(MissingLabel { id: "pc" }));
}

#[test]
fn the_decomposition_is_compared_whatever_the_labels() {
    let map = map();
    let evaluator =
        |truth: &GroundTruth| *Evaluator::new(&map.analysis, truth, &Watch::unwatched()).unwrap().geometry();
    let geometry = evaluator(&truth(&map));
    assert_eq!((geometry.faces, geometry.places, geometry.faces_per_place), (6, 4, Some(1.5)));
    assert_eq!(geometry.boundary_recall, Some(1.0));
    // The border between corridor and junction begins at a place and leads away from it.
    assert!((0.9..1.0).contains(&geometry.boundary_precision.unwrap()), "{geometry:?}");
    // Places half a metre beside their faces: the borders along the row stay.
    let mut shifted = truth(&map);
    shifted.places = vec![place(&map, 1..3, 0..2, "A")];
    let geometry = evaluator(&shifted);
    assert!((0.5..0.7).contains(&geometry.boundary_recall.unwrap()), "{geometry:?}");
    assert!((0.5..0.7).contains(&geometry.boundary_precision.unwrap()), "{geometry:?}");
    let nothing = evaluator(&GroundTruth::default());
    assert_eq!(nothing.occupancy, None);
    assert_eq!((nothing.faces_per_place, nothing.boundary_recall, nothing.orientation_error), (None, None, None));
}

#[test]
fn occupancy_is_compared_on_the_places_that_one_face_fits() {
    let map = map();
    let evaluator =
        |truth: &GroundTruth| *Evaluator::new(&map.analysis, truth, &Watch::unwatched()).unwrap().geometry();
    let found = |truth: &GroundTruth| evaluator(truth).occupancy.map(|it| (it.places, it.occupied, it.empty));
    let mut truth = truth(&map);
    expect!["Some((4, [4, 0, 0], [0, 0, 0]))"].assert_eq(&format!("{:?}", found(&truth)));
    truth.places.iter_mut().for_each(|place| place.occupied = !place.occupied);
    expect!["Some((4, [0, 0, 0], [4, 0, 0]))"].assert_eq(&format!("{:?}", found(&truth)));
}

#[test]
fn directions_are_compared_along_and_across_the_rows() {
    let mut map = map();
    map.analysis.frame.yaw = FRAC_PI_4;
    map.analysis.orientations.angles = vec![-1.4, 0.01, 0.5];
    let mut truth = truth(&map);
    truth.regions[0].angle = FRAC_PI_4;
    let geometry = *Evaluator::new(&map.analysis, &truth, &Watch::unwatched()).unwrap().geometry();
    let across = FRAC_PI_2 - 1.4;
    assert!((geometry.orientation_error.unwrap() - across).abs() < 1e-9);
    assert_eq!(geometry.false_orientations, Some(2));
}

#[test]
fn the_truth_is_read_in_the_frame_of_the_map() {
    let mut map = map();
    let expected = report(&map, &truth(&map), &map.semantic(&RuleSet::warehouse()));
    let (yaw, origin) = (0.3, Point::new(7.0, -2.0));
    let moved = |point: Point| origin + direction(yaw) * point.x + normal(yaw) * point.y;
    let mut truth = truth(&map);
    let areas = truth.places.iter_mut().map(|place| &mut place.area);
    for area in areas.chain(&mut truth.corridors).chain(&mut truth.junctions) {
        let rings = area.in_grid(&map.analysis.frame);
        // Turning the other way round as well: either sense is read.
        let turned = rings.into_iter().map(|ring| ring.into_iter().rev().map(moved).collect()).collect();
        *area = TrueArea::new(vec![turned]);
    }
    map.analysis.frame.yaw = yaw;
    map.analysis.frame.origin = origin;
    assert_eq!(report(&map, &truth, &map.semantic(&RuleSet::warehouse())), expected);
}

#[test]
fn a_map_without_faces_finds_nothing() {
    let mut map = map();
    let truth = truth(&map);
    map.analysis.subdivision = crate::arrangement::Subdivision::default();
    (map.analysis.faces, map.analysis.edges) = (Vec::new(), Vec::new());
    let semantic = apply(&map.analysis, &RuleSet::warehouse(), &Assignment::default()).unwrap();
    let report = report(&map, &truth, &semantic);
    expect![[r#"
        4 places: strict 0.00 lax 0.00 area 0.00 geometry 0.00 systematic 0.00
        A 2 places: strict 0.00 lax 0.00 area 0.00 geometry 0.00 systematic 0.00
        B 2 places: strict 0.00 lax 0.00 area 0.00 geometry 0.00 systematic 0.00
        precision 0.00 f1 0.00, 0 false, 0 slivers
        co 0.0000 ju 0.0000 pc 0.0000 drivable 0.0000
        cogency NaN"#]]
    .assert_eq(&report);
}

#[test]
fn a_comparison_can_be_stopped() {
    struct Nobody;
    impl crate::watch::Observer for Nobody {
        fn progress(&self, _: crate::watch::Stage, _: f64) {}
    }
    let map = map();
    let stop = crate::watch::StopFlag::default();
    stop.raise();
    assert!(Evaluator::new(&map.analysis, &truth(&map), &Watch::new(&stop, &Nobody)).is_err());
}

#[test]
fn a_layout_is_compared_place_by_place_and_code_by_code() {
    use crate::routing::Router;

    let map = map();
    let semantic = map.semantic(&RuleSet::warehouse());
    let (site, layout) = (map.site(&semantic), map.layout(&semantic));
    let router = Router::new(&site, VEHICLE_RADIUS);
    let scored = |truth: &GroundTruth, layout: &crate::layout::Layout| {
        let scores = LayoutScores::of(&site, layout, &router, truth, &Watch::unwatched()).unwrap();
        let LayoutScores { places, found, locations, false_locations, approaches, standing, reachable, .. } = scores;
        let orders: Vec<String> =
            scores.orders.iter().map(|order| format!("{}: {:.1} of {}", order.aisle, order.tau, order.pairs)).collect();
        format!(
            "{found} of {places} found, {false_locations} of {locations} false, {standing} of {approaches} standing, {reachable} reachable, {orders:?}"
        )
    };
    expect![[r#"4 of 4 found, 0 of 4 false, 4 of 4 standing, 4 reachable, ["1: 1.0 of 2"]"#]]
        .assert_eq(&scored(&truth(&map), &layout));
    // A place that is not there, one seen too little, and codes against the order of the places.
    let mut wrong = truth(&map);
    wrong.places[0].area = area(&map, 5..7, 0..2);
    wrong.places[1].observed = 0.1;
    expect![[r#"2 of 3 found, 1 of 4 false, 4 of 4 standing, 4 reachable, ["1: 1.0 of 1"]"#]]
        .assert_eq(&scored(&wrong, &layout));
    let mut swapped = layout.clone();
    let codes: Vec<String> = layout.locations.iter().map(|location| location.code.clone()).collect();
    swapped.locations[0].code.clone_from(&codes[2]);
    swapped.locations[2].code.clone_from(&codes[0]);
    expect![[r#"4 of 4 found, 0 of 4 false, 4 of 4 standing, 4 reachable, ["1: 0.0 of 2"]"#]]
        .assert_eq(&scored(&truth(&map), &swapped));
}
