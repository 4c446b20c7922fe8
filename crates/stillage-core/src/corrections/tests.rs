//! Corrections of maps drawn in characters: a character is a cell of 0.5 m, the lower left corner is [0, 0].

use expect_test::{Expect, expect};

use super::*;
use crate::arrangement::FaceId;
use crate::geometry::Point;
use crate::layout::{LayoutSpec, layout};
use crate::routing::{Preferences, Router, Waypoint};
use crate::semantics::pictures::{DrawnMap, VEHICLE_RADIUS};
use crate::semantics::{self, Assignment, RuleSet, SemanticMap};
use crate::site_map::SiteCells;

/// Reads a correction as a client writes it.
fn read(json: &str) -> Correction {
    serde_json::from_str(json).unwrap_or_else(|error| panic!("{json} is no correction: {error}"))
}

fn read_all(list: &[&str]) -> Vec<Correction> {
    list.iter().map(|json| read(json)).collect()
}

fn corrected(map: &DrawnMap, list: &[&str]) -> Corrected {
    let corrected = apply(&map.grid, &map.analysis, &map.cells.faces, &read_all(list));
    corrected.analysis.subdivision.check_invariants().expect("the arrangement is sound");
    assert_eq!(corrected.faces, crate::arrangement::CellFaces::of_grid(&corrected.analysis.subdivision, &map.grid));
    corrected
}

/// A letter for each face, what people said of the faces, and what became of the corrections.
fn told(map: &DrawnMap, corrected: &Corrected) -> String {
    let letter = |face: FaceId| char::from(b'`' + face.0 as u8);
    let letters = |faces: &[FaceId]| faces.iter().map(|&face| letter(face)).collect::<String>();
    let picture = map.draw(|column, row| match corrected.faces.at(column, row) {
        FaceId::OUTER => ' ',
        face => letter(face),
    });
    let labels = corrected.labels.iter().map(|(face, label)| format!("{} is {label}\n", letter(*face)));
    let names = corrected.names.iter().map(|(face, name)| format!("{} is called {name}\n", letter(*face)));
    let outcomes = corrected.outcomes.iter().zip(1..).map(|(outcome, number)| match outcome {
        Outcome::Applied { faces } => format!("{number}: {}\n", letters(faces)),
        Outcome::Unfit(problem) => format!("{number}: unfit, {problem}\n"),
    });
    std::iter::once(picture).chain(labels).chain(names).chain(outcomes).collect()
}

fn check(map: &DrawnMap, list: &[&str], expected: &Expect) {
    expected.assert_eq(&told(map, &corrected(map, list)));
}

/// A floor without anything on it.
fn floor() -> DrawnMap {
    DrawnMap::new(&"............\n".repeat(8), &"cccccccccccc\n".repeat(8))
}

/// Two rooms, o and c, with a wall between them that has a gap of 1 m.
fn two_rooms() -> DrawnMap {
    DrawnMap::new(
        "
        .....#......
        .....#......
        .....#......
        ............
        ............
        .....#......
        .....#......
        .....#......
        ",
        &"oooooccccccc\n".repeat(8),
    )
}

/// What labels the rules and people give.
fn labelled(corrected: &Corrected) -> SemanticMap {
    let rules = RuleSet::warehouse();
    let names = ["co", "ju", "pc"].iter().zip(0..).map(|(id, category)| (category, (*id).to_owned()));
    let overrides = corrected.labels.iter().map(|(face, label)| (face.0, label.clone())).collect();
    let assignment = Assignment { assignment: names.collect(), overrides };
    semantics::apply(&corrected.analysis, &rules, &assignment).expect("labels that exist")
}

#[test]
fn a_polygon_becomes_a_face_whatever_was_there() {
    let rack = r#"{"kind":"draw","ring":[[2,1],[4,1],[4,3],[2,3]],"label":"pc","name":"Rack 12"}"#;
    let over_it = r#"{"kind":"draw","ring":[[3,1],[5,1],[5,3],[3,3],[3,1]],"label":"of"}"#;
    check(
        &floor(),
        &[rack],
        &expect![[r#"
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        aaaabbbbaaaa
        aaaabbbbaaaa
        aaaabbbbaaaa
        aaaabbbbaaaa
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        b is pc
        b is called Rack 12
        1: b
    "#]],
    );
    check(
        &floor(),
        &[rack, over_it],
        &expect![[r#"
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        aaaabbccccaa
        aaaabbccccaa
        aaaabbccccaa
        aaaabbccccaa
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        b is pc
        c is of
        b is called Rack 12
        1: b
        2: c
    "#]],
    );
}

#[test]
fn what_is_drawn_within_a_cell_of_a_border_leaves_no_sliver() {
    let beside = r#"{"kind":"draw","ring":[[0.2,0.3],[2.1,0.4],[1.9,3.8],[0.1,3.7]],"label":"pc"}"#;
    let next = r#"{"kind":"draw","ring":[[2.3,0.1],[4,0.2],[4,3.9],[2.2,3.6]],"label":"pc"}"#;
    let corrected = corrected(&floor(), &[beside, next]);
    let areas: Vec<f64> = corrected.analysis.faces.iter().skip(1).map(|face| face.area.round()).collect();
    assert_eq!(areas, [8.0, 8.0, 8.0]);
    assert_eq!(
        corrected.analysis.subdivision.faces().map(|face| corrected.analysis.subdivision.rings(face).len()).max(),
        Some(1)
    );
}

/// The corners of the face that a correction drew, rounded to centimetres, the lowest of the leftmost first.
fn corners_of_drawn(map: &DrawnMap, correction: &str) -> Vec<[f64; 2]> {
    let corrected = corrected(map, &[correction]);
    let Outcome::Applied { faces } = &corrected.outcomes[0] else { panic!("{correction} does not fit") };
    let ring = corrected.analysis.subdivision.rings(faces[0]).swap_remove(0);
    ring.iter().map(|corner| [corner.x, corner.y].map(|along| (along * 100.0).round() / 100.0)).collect()
}

#[test]
fn what_is_drawn_keeps_its_shape_when_it_joins_what_is_there() {
    let drawn = |ring: &str| corners_of_drawn(&floor(), &format!(r#"{{"kind":"draw","ring":{ring},"label":"pc"}}"#));
    // The side within a cell of the border moves onto it.
    assert_eq!(drawn("[[0.3,1.1],[1.8,1.1],[1.8,2.6],[0.3,2.6]]"), [[0.0, 1.1], [1.8, 1.1], [1.8, 2.6], [0.0, 2.6]]);
    // Three of the corners lie within a cell of different things: it moves as a whole to the nearest of them.
    assert_eq!(drawn("[[0.4,0.1],[1.6,0.4],[1.5,1.6],[0.3,1.3]]"), [[0.1, 0.1], [1.3, 0.4], [1.2, 1.6], [0.0, 1.3]]);
    // Both long sides lie within a cell of the border: they stay two.
    assert_eq!(drawn("[[1,0.1],[5,0.1],[5,0.45],[1,0.45]]"), [[1.0, 0.0], [5.0, 0.0], [5.0, 0.35], [1.0, 0.35]]);
}

#[test]
fn a_side_bends_to_what_lies_beside_its_middle_and_not_beside_its_end() {
    let upper = r#"{"kind":"draw","ring":[[2,2],[4,2],[4,3],[2,3]],"label":"pc"}"#;
    // Half a cell above the lower corners of the other one: both lie beside the middle of its upper side.
    let below = r#"{"kind":"draw","ring":[[0,0],[6,0],[6,1.75],[0,1.75]],"label":"co"}"#;
    let corners = |list: &[&str]| {
        let corrected = corrected(&floor(), list);
        let Some(Outcome::Applied { faces }) = corrected.outcomes.last() else { panic!("it fits") };
        corrected.analysis.subdivision.rings(faces[0])[0].len()
    };
    assert_eq!(corners(&[upper, below]), 6);
    let beside_end = r#"{"kind":"draw","ring":[[1.2,0],[4.8,0],[4.8,1.75],[1.2,1.75]],"label":"co"}"#;
    assert_eq!(corners(&[upper, beside_end]), 4);
}

#[test]
fn a_line_cuts_the_faces_that_it_crosses_from_border_to_border() {
    check(
        &floor(),
        &[r#"{"kind":"split","line":[[0,2],[6,2]]}"#, r#"{"kind":"split","line":[[3,4],[3,1]]}"#],
        &expect![[r#"
            bbbbbbcccccc
            bbbbbbcccccc
            bbbbbbcccccc
            bbbbbbcccccc
            aaaaaaaaaaaa
            aaaaaaaaaaaa
            aaaaaaaaaaaa
            aaaaaaaaaaaa
            1: abc
            2: bc
        "#]],
    );
    check(
        &floor(),
        &[r#"{"kind":"split","line":[[1.5,2],[4.5,2]]}"#],
        &expect![[r#"
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        1: unfit, /line: the line cuts no face in two: draw it on until it meets the border of a face at both ends
    "#]],
    );
}

#[test]
fn a_line_that_ends_just_before_a_border_is_drawn_on() {
    let short = corrected(&floor(), &[r#"{"kind":"split","line":[[0.8,1.8],[5.2,2.2]]}"#]);
    let areas: Vec<f64> = short.analysis.faces.iter().skip(1).map(|face| face.area.round()).collect();
    assert_eq!(areas, [12.0, 12.0]);
}

#[test]
fn parts_keep_what_was_said_of_the_whole() {
    let name = r#"{"kind":"name","at":[1,1],"name":"Cold store"}"#;
    let label = r#"{"kind":"label","at":[1,1],"label":"of"}"#;
    check(
        &floor(),
        &[name, label, r#"{"kind":"split","line":[[3,0],[3,4]]}"#, r#"{"kind":"label","at":[5,1],"label":"ju"}"#],
        &expect![[r#"
            aaaaaabbbbbb
            aaaaaabbbbbb
            aaaaaabbbbbb
            aaaaaabbbbbb
            aaaaaabbbbbb
            aaaaaabbbbbb
            aaaaaabbbbbb
            aaaaaabbbbbb
            a is of
            b is ju
            a is called Cold store
            b is called Cold store
            1: ab
            2: ab
            3: ab
            4: b
        "#]],
    );
}

#[test]
fn faces_side_by_side_become_one() {
    let map = DrawnMap::new(&"............\n".repeat(4), &"ccccjjjjdddd\n".repeat(4));
    let label = r#"{"kind":"label","at":[3,1],"label":"of"}"#;
    check(
        &map,
        &[label, r#"{"kind":"merge","at":[[1,1],[3,1]]}"#],
        &expect![[r#"
        aaaaaaaabbbb
        aaaaaaaabbbb
        aaaaaaaabbbb
        aaaaaaaabbbb
        a is of
        1: a
        2: a
    "#]],
    );
    check(
        &map,
        &[r#"{"kind":"merge","at":[[1,1],[5,1]]}"#, r#"{"kind":"merge","at":[[1,1],[1,1.5]]}"#],
        &expect![[r#"
        aaaabbbbcccc
        aaaabbbbcccc
        aaaabbbbcccc
        aaaabbbbcccc
        1: unfit, /at/1: the face at this point shares no border with the others: name points in the faces between, too
        2: unfit, /at: all these points lie in one face already
    "#]],
    );
}

#[test]
fn a_row_is_cut_into_places_that_have_codes_and_access() {
    let map = floor();
    let row = r#"{"kind":"row","rectangle":[[0,4],[6,4],[6,2],[0,2]],"pitchM":2,"layers":2,"label":"pc"}"#;
    let corrected = corrected(&map, &[row]);
    expect![[r#"
        eeeeffffgggg
        eeeeffffgggg
        bbbbccccdddd
        bbbbccccdddd
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        b is pc
        c is pc
        d is pc
        e is pc
        f is pc
        g is pc
        1: bcdefg
    "#]]
    .assert_eq(&told(&map, &corrected));
    let semantic = labelled(&corrected);
    let cells = SiteCells { faces: corrected.faces, clearance: map.cells.clearance.clone() };
    let spec = LayoutSpec { vehicle_radius: VEHICLE_RADIUS, ..LayoutSpec::of(&corrected.analysis.options) };
    let layout = layout(&cells.map(&map.grid, &corrected.analysis, &semantic), &spec);
    let codes: Vec<String> = layout
        .locations
        .iter()
        .map(|location| {
            format!("{} {:.1}x{:.1} {}", location.code, location.width, location.depth, location.approach.is_some())
        })
        .collect();
    expect![[r#"
        01-001 2.0x1.0 true
        01-001-2 2.0x1.0 true
        01-003 2.0x1.0 true
        01-003-2 2.0x1.0 true
        01-005 2.0x1.0 true
        01-005-2 2.0x1.0 true
    "#]]
    .assert_eq(&(codes.join("\n") + "\n"));
}

#[test]
fn what_is_no_rack_joins_the_floor_around_it() {
    let map = DrawnMap::new(
        &"............\n".repeat(8),
        "
        jjjjjjjjjjjj
        jjjjjjjjjjjj
        ccppqqppcccc
        ccppqqppcccc
        cccccccccccc
        cccccccccccc
        cccccccccccc
        cccccccccccc
        ",
    );
    let around = r#"{"kind":"erase","ring":[[0.7,1.7],[4.2,1.7],[4.2,3.3],[0.7,3.3]]}"#;
    check(
        &map,
        &[around],
        &expect![[r#"
        bbbbbbbbbbbb
        bbbbbbbbbbbb
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        1: a
    "#]],
    );
    let around_a_border = r#"{"kind":"erase","ring":[[0,2.8],[6,2.8],[6,3.2],[0,3.2]]}"#;
    check(
        &map,
        &[around, around_a_border],
        &expect![[r#"
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        1: a
        2: a
    "#]],
    );
    check(
        &map,
        &[r#"{"kind":"erase","ring":[[4.8,0.5],[5.6,0.5],[5.6,1.2]]}"#],
        &expect![[r#"
        eeeeeeeeeeee
        eeeeeeeeeeee
        aabbccddaaaa
        aabbccddaaaa
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        1: unfit, /ring: nothing to erase: no face lies in the polygon for most of its area, and no border lies wholly in it
    "#]],
    );
}

#[test]
fn what_was_erased_has_the_category_of_the_floor_that_it_joined() {
    let map = DrawnMap::new(
        &"............\n".repeat(4),
        "
        pppppppppppp
        pppppppppppp
        pppppppppppp
        cccccccccccc
        ",
    );
    let category = |corrected: &Corrected| corrected.analysis.faces[1].category;
    let erased = corrected(&map, &[r#"{"kind":"erase","ring":[[0,0.5],[6,0.5],[6,2],[0,2]]}"#]);
    let merged = corrected(&map, &[r#"{"kind":"merge","at":[[1,0.2],[1,1]]}"#]);
    assert_eq!((erased.analysis.faces.len(), merged.analysis.faces.len()), (2, 2));
    assert_eq!((category(&erased), category(&merged)), (0, 2));
}

#[test]
fn vehicles_pass_doors_that_people_drew_unless_they_are_shut() {
    let map = two_rooms();
    let length = |list: &[&str]| {
        let corrected = corrected(&map, list);
        let semantic = labelled(&corrected);
        let cells = SiteCells { faces: corrected.faces, clearance: map.cells.clearance.clone() };
        let site = cells.map(&map.grid, &corrected.analysis, &semantic);
        let ends = [Point::new(0.75, 2.25), Point::new(5.25, 2.25)].map(Waypoint::Point);
        let route = Router::new(&site, VEHICLE_RADIUS).route(&site, &ends[0], &ends[1], &Preferences::default());
        (route.ok().map(|route| route.length), corrected.analysis.rooms.doors.len())
    };
    let (drivable, open, shut) = (
        r#"{"kind":"label","at":[1,1],"label":"co"}"#,
        r#"{"kind":"door","line":[[2.6,1.5],[2.6,2.5]],"isOpen":true}"#,
        r#"{"kind":"door","line":[[2.6,1.5],[2.6,2.5]],"isOpen":false}"#,
    );
    assert_eq!(length(&[drivable]), (Some(4.5), 0));
    assert_eq!(length(&[drivable, open]), (Some(4.5), 1));
    assert_eq!(length(&[drivable, shut]), (None, 0));
    assert_eq!(length(&[drivable, shut, open]), (Some(4.5), 1));
    check(
        &map,
        &[open, r#"{"kind":"door","line":[[1,1.5],[1,2.5]],"isOpen":true}"#],
        &expect![[r#"
        aaaaabbbbbbb
        aaaaabbbbbbb
        aaaaabbbbbbb
        aaaaabbbbbbb
        aaaaabbbbbbb
        aaaaabbbbbbb
        aaaaabbbbbbb
        aaaaabbbbbbb
        1: ab
        2: unfit, /line: no border between two faces runs along this line: draw it on the border, from jamb to jamb
    "#]],
    );
}

#[test]
fn what_does_not_fit_is_told_and_changes_nothing() {
    let map = floor();
    let list = [
        r#"{"kind":"label","at":[9,1],"label":"co"}"#,
        r#"{"kind":"draw","ring":[[1,1],[2,1],[2,-3]],"label":"pc"}"#,
        r#"{"kind":"merge","at":[[1,1],[2,2]]}"#,
        r#"{"kind":"door","line":[[1,1],[2,1]],"isOpen":false}"#,
    ];
    check(
        &map,
        &list,
        &expect![[r#"
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        1: unfit, /at: the point lies 3.00 m outside the map
        2: unfit, /ring/2: the point lies 3.00 m outside the map
        3: unfit, /at: all these points lie in one face already
        4: unfit, /line: no border between two faces runs along this line: draw it on the border, from jamb to jamb
    "#]],
    );
    assert_eq!(corrected(&map, &list).analysis, map.analysis);
}

#[test]
fn corrections_of_a_scan_fit_onto_the_next_one_or_are_told() {
    let (split, door) =
        (r#"{"kind":"split","line":[[0,2],[6,2]]}"#, r#"{"kind":"door","line":[[2.5,1.5],[2.5,2.5]],"isOpen":false}"#);
    check(
        &two_rooms(),
        &[split, door],
        &expect![[r#"
        cccccddddddd
        cccccddddddd
        cccccddddddd
        cccccddddddd
        aaaaabbbbbbb
        aaaaabbbbbbb
        aaaaabbbbbbb
        aaaaabbbbbbb
        1: abcd
        2: abcd
    "#]],
    );
    check(
        &floor(),
        &[split, door],
        &expect![[r#"
        bbbbbbbbbbbb
        bbbbbbbbbbbb
        bbbbbbbbbbbb
        bbbbbbbbbbbb
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        aaaaaaaaaaaa
        1: ab
        2: unfit, /line: no border between two faces runs along this line: draw it on the border, from jamb to jamb
    "#]],
    );
}
