//! Locations of drawn warehouses.

mod access;

use super::*;
use crate::geometry::Point;
use crate::semantics::RuleSet;
use crate::semantics::pictures::DrawnMap;
use expect_test::{Expect, expect};
use std::collections::BTreeSet;

/// Two racks back to back between two aisles, crossed by a junction; single racks above and below.
fn warehouse() -> DrawnMap {
    DrawnMap::new(
        "
        ########....########
        ########....########
        ....................
        ....................
        ....................
        ....................
        ##..####....##  ####
        ##..####....##  ####
        ########....########
        ########....########
        ....................
        ....................
        ....................
        ....................
        ########....########
        ########....########
        ",
        "
        ppqqppqqjjjjppqqppqq
        ppqqppqqjjjjppqqppqq
        ccccccccjjjjcccccccc
        ccccccccjjjjcccccccc
        ccccccccjjjjcccccccc
        ccccccccjjjjcccccccc
        ppqqppqqjjjjppqqppqq
        ppqqppqqjjjjppqqppqq
        qqppqqppjjjjqqppqqpp
        qqppqqppjjjjqqppqqpp
        ccccccccjjjjcccccccc
        ccccccccjjjjcccccccc
        ccccccccjjjjcccccccc
        ccccccccjjjjcccccccc
        ppqqppqqjjjjppqqppqq
        ppqqppqqjjjjppqqppqq
        ",
    )
}

fn check(map: &DrawnMap, expected: &Expect) -> Vec<Location> {
    let semantic = map.semantic(&RuleSet::warehouse());
    let Layout { locations, aisles, rows, .. } = map.layout(&semantic);
    let codes: BTreeSet<&str> = locations.iter().map(|location| location.code.as_str()).collect();
    assert_eq!(codes.len(), locations.len(), "codes are unique");
    assert!(locations.is_sorted_by_key(|location| location.code.clone()), "locations come by code");
    let listed: usize = aisles.iter().map(|aisle| aisle.left.len() + aisle.right.len()).sum();
    let in_rows: usize = rows.iter().map(|row| row.locations.len()).sum();
    let numbered = locations.iter().filter(|location| location.aisle > 0).count();
    assert_eq!([listed, in_rows], [numbered; 2], "aisles and rows name every location that has an aisle");
    let storage = map.analysis.subdivision.faces().filter(|&face| semantic.label(face).is_storage()).count();
    assert_eq!(locations.len(), storage, "every storage face is a location");

    let line = |location: &Location| {
        let approach = location.approach.map_or_else(
            || "no access".to_owned(),
            |pose| format!("from {:.1},{:.1}", pose.position.x, pose.position.y),
        );
        let Point { coords: center } = location.center;
        let degrees = location.heading.to_degrees().round() as i32;
        format!(
            "{} at {:.1},{:.1} {:.1}x{:.1} {degrees:>4} {:?} {approach}\n",
            location.code, center.x, center.y, location.width, location.depth, location.occupancy.state,
        )
    };
    expected.assert_eq(&locations.iter().map(line).collect::<String>());
    locations
}

#[test]
fn locations_are_numbered_aisle_by_aisle_odd_on_the_left() {
    check(
        &warehouse(),
        &expect![[r#"
            01-001 at 0.5,3.5 1.0x1.0   90 Occupied from 0.8,2.8
            01-002 at 0.5,0.5 1.0x1.0  -90 Occupied from 0.5,1.5
            01-003 at 1.5,3.5 1.0x1.0   90 Occupied from 1.8,2.8
            01-004 at 1.5,0.5 1.0x1.0  -90 Occupied from 1.5,1.5
            01-005 at 2.5,3.5 1.0x1.0   90 Occupied from 2.8,2.8
            01-006 at 2.5,0.5 1.0x1.0  -90 Occupied from 2.5,1.5
            01-007 at 3.5,3.5 1.0x1.0   90 Occupied from 3.8,2.8
            01-008 at 3.5,0.5 1.0x1.0  -90 Occupied from 3.5,1.5
            02-001 at 6.5,3.5 1.0x1.0   90 Occupied from 6.8,2.8
            02-002 at 6.5,0.5 1.0x1.0  -90 Occupied from 6.5,1.5
            02-003 at 7.5,3.5 1.0x1.0   90 Occupied from 7.2,2.8
            02-004 at 7.5,0.5 1.0x1.0  -90 Occupied from 7.5,1.5
            02-005 at 8.5,3.5 1.0x1.0   90 Occupied from 8.8,2.8
            02-006 at 8.5,0.5 1.0x1.0  -90 Occupied from 8.5,1.5
            02-007 at 9.5,3.5 1.0x1.0   90 Occupied from 9.8,2.8
            02-008 at 9.5,0.5 1.0x1.0  -90 Occupied from 9.8,1.8
            03-001 at 0.5,7.5 1.0x1.0   90 Occupied from 0.8,6.8
            03-002 at 0.5,4.5 1.0x1.0  -90 Occupied from 0.5,5.5
            03-003 at 1.5,7.5 1.0x1.0   90 Occupied from 1.8,6.8
            03-004 at 1.5,4.5 1.0x1.0  -90 Empty from 1.5,5.5
            03-005 at 2.5,7.5 1.0x1.0   90 Occupied from 2.8,6.8
            03-006 at 2.5,4.5 1.0x1.0  -90 Occupied from 2.5,5.5
            03-007 at 3.5,7.5 1.0x1.0   90 Occupied from 3.2,6.8
            03-008 at 3.5,4.5 1.0x1.0  -90 Occupied from 3.5,5.5
            04-001 at 6.5,7.5 1.0x1.0   90 Occupied from 6.8,6.8
            04-002 at 6.5,4.5 1.0x1.0  -90 Occupied from 6.5,5.5
            04-003 at 7.5,7.5 1.0x1.0   90 Occupied from 7.8,6.8
            04-004 at 7.5,4.5 1.0x1.0  -90 Unknown from 7.5,5.5
            04-005 at 8.5,7.5 1.0x1.0   90 Occupied from 8.8,6.8
            04-006 at 8.5,4.5 1.0x1.0  -90 Occupied from 8.5,5.5
            04-007 at 9.5,7.5 1.0x1.0   90 Occupied from 9.8,6.8
            04-008 at 9.5,4.5 1.0x1.0  -90 Occupied from 9.8,5.8
        "#]],
    );
}

#[test]
fn upright_aisles_are_numbered_from_the_left_and_run_up() {
    let map = DrawnMap::new(
        "
        #...##..#
        #...##..#
        #...##..#
        #...##..#
        ",
        "
        pcccpqddp
        pcccpqddp
        qcccqpddq
        qcccqpddq
        ",
    );
    check(
        &map,
        &expect![[r#"
            01-001 at 0.2,0.5 1.0x0.5  180 Occupied from 1.2,0.2
            01-002 at 2.2,0.5 1.0x0.5    0 Occupied from 1.8,0.2
            01-003 at 0.2,1.5 1.0x0.5  180 Occupied from 1.2,1.8
            01-004 at 2.2,1.5 1.0x0.5    0 Occupied from 1.8,1.8
            02-001 at 2.8,0.5 1.0x0.5  180 Occupied from 3.8,0.8
            02-002 at 4.2,0.5 1.0x0.5    0 Occupied from 3.8,0.2
            02-003 at 2.8,1.5 1.0x0.5  180 Occupied from 3.8,1.8
            02-004 at 4.2,1.5 1.0x0.5    0 Occupied from 3.8,1.8
        "#]],
    );
}

#[test]
fn one_place_of_many_corridors_falls_into_its_aisles() {
    // All drivable ground has one label: both corridors and the way between them are one place.
    let map = DrawnMap::new(
        "
        ####..
        ......
        ......
        ####..
        ####..
        ......
        ......
        ####..
        ",
        "
        ppqqcc
        cccccc
        cccccc
        ppqqcc
        qqppcc
        cccccc
        cccccc
        ppqqcc
        ",
    );
    check(
        &map,
        &expect![[r#"
            01-001 at 0.5,1.8 1.0x0.5   90 Occupied from 0.8,1.2
            01-002 at 0.5,0.2 1.0x0.5  -90 Occupied from 0.8,1.2
            01-003 at 1.5,1.8 1.0x0.5   90 Occupied from 1.8,1.2
            01-004 at 1.5,0.2 1.0x0.5  -90 Occupied from 1.8,1.2
            02-001 at 0.5,3.8 1.0x0.5   90 Occupied from 0.8,3.2
            02-002 at 0.5,2.2 1.0x0.5  -90 Occupied from 0.8,3.2
            02-003 at 1.5,3.8 1.0x0.5   90 Occupied from 1.2,3.2
            02-004 at 1.5,2.2 1.0x0.5  -90 Occupied from 1.8,3.2
        "#]],
    );
}

#[test]
fn the_robot_stands_inside_a_face_too_narrow_for_its_distance() {
    let map = DrawnMap::new(
        "
        ##
        ..
        ..
        ",
        "
        pp
        cc
        dd
        ",
    );
    check(
        &map,
        &expect![[r#"
            01-001 at 0.5,1.2 1.0x0.5   90 Occupied from 0.8,0.8
        "#]],
    );
}

#[test]
fn a_map_without_storage_has_no_locations() {
    let map = DrawnMap::new("..", "cc");
    assert!(map.layout(&map.semantic(&RuleSet::office())).locations.is_empty());
}

#[test]
fn codes_that_would_be_too_long_are_those_of_the_default_template() {
    let map = warehouse();
    let semantic = map.semantic(&RuleSet::warehouse());
    let coded = |template: &str| {
        let code = CodeTemplate::parse(template).expect("it is a template");
        layout(&map.site(&semantic), &LayoutSpec { code, ..LayoutSpec::of(&map.analysis.options) })
    };
    let short = coded("hall 7 {aisle}.{bay:04}");
    assert_eq!((short.locations[0].code.as_str(), short.long_codes.len()), ("hall 7 1.0001", 0));
    let long = coded("hall number seven {aisle}.{bay}");
    assert_eq!((long.locations[0].code.as_str(), long.long_codes.len()), ("01-001", long.locations.len()));
    assert_eq!(long.long_codes[0], "hall number seven 1.1");
}

#[test]
fn a_long_rack_is_cut_into_places_for_a_load() {
    let map = DrawnMap::new(
        "
        ############
        ##....####..
        ............
        ............
        ............
        ",
        "
        pppppppppppp
        pppppppppppp
        cccccccccccc
        cccccccccccc
        cccccccccccc
        ",
    );
    let semantic = map.semantic(&RuleSet::warehouse());
    let spec = LayoutSpec { vehicle_radius: 0.2, ..LayoutSpec::of(&map.analysis.options) };
    let cut = |place_width| layout(&map.site(&semantic), &LayoutSpec { place_width, ..spec.clone() }).locations;
    assert_eq!((cut(None).len(), cut(Some(6.0)).len(), cut(Some(3.0)).len()), (1, 1, 2));
    let places = cut(Some(2.0));
    let line = |place: &Location| format!("{} {:.1} m at {:.1}", place.code, place.width, place.center.x);
    let lines: Vec<String> = places.iter().map(line).collect();
    assert_eq!(lines, ["01-001 2.0 m at 1.0", "01-003 2.0 m at 3.0", "01-005 2.0 m at 5.0"]);
    assert!(places.iter().all(|place| (place.area - 2.0).abs() < 1e-9 && place.outline.len() == 4));
}
