//! Locations of drawn warehouses.

use super::aisles::Slot;
use super::codes::Codes;
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
    let locations = map.locations(&semantic);
    let codes: BTreeSet<&str> = locations.iter().map(|location| location.code.as_str()).collect();
    assert_eq!(codes.len(), locations.len(), "codes are unique");
    assert!(locations.is_sorted_by_key(|location| location.code.clone()), "locations come by code");
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
            location.code, center.x, center.y, location.width, location.depth, location.occupancy,
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
            01-001 at 0.5,3.5 1.0x1.0   90 Occupied from 0.5,2.2
            01-002 at 0.5,0.5 1.0x1.0  -90 Occupied from 0.5,1.8
            01-003 at 1.5,3.5 1.0x1.0   90 Occupied from 1.5,2.2
            01-004 at 1.5,0.5 1.0x1.0  -90 Occupied from 1.5,1.8
            01-005 at 2.5,3.5 1.0x1.0   90 Occupied from 2.5,2.2
            01-006 at 2.5,0.5 1.0x1.0  -90 Occupied from 2.5,1.8
            01-007 at 3.5,3.5 1.0x1.0   90 Occupied from 3.5,2.2
            01-008 at 3.5,0.5 1.0x1.0  -90 Occupied from 3.5,1.8
            02-001 at 6.5,3.5 1.0x1.0   90 Occupied from 6.5,2.2
            02-002 at 6.5,0.5 1.0x1.0  -90 Occupied from 6.5,1.8
            02-003 at 7.5,3.5 1.0x1.0   90 Occupied from 7.5,2.2
            02-004 at 7.5,0.5 1.0x1.0  -90 Occupied from 7.5,1.8
            02-005 at 8.5,3.5 1.0x1.0   90 Occupied from 8.5,2.2
            02-006 at 8.5,0.5 1.0x1.0  -90 Occupied from 8.5,1.8
            02-007 at 9.5,3.5 1.0x1.0   90 Occupied from 9.5,2.2
            02-008 at 9.5,0.5 1.0x1.0  -90 Occupied from 9.5,1.8
            03-001 at 0.5,7.5 1.0x1.0   90 Occupied from 0.5,6.2
            03-002 at 0.5,4.5 1.0x1.0  -90 Occupied from 0.5,5.8
            03-003 at 1.5,7.5 1.0x1.0   90 Occupied from 1.5,6.2
            03-004 at 1.5,4.5 1.0x1.0  -90 Empty from 1.5,5.8
            03-005 at 2.5,7.5 1.0x1.0   90 Occupied from 2.5,6.2
            03-006 at 2.5,4.5 1.0x1.0  -90 Occupied from 2.5,5.8
            03-007 at 3.5,7.5 1.0x1.0   90 Occupied from 3.5,6.2
            03-008 at 3.5,4.5 1.0x1.0  -90 Occupied from 3.5,5.8
            04-001 at 6.5,7.5 1.0x1.0   90 Occupied from 6.5,6.2
            04-002 at 6.5,4.5 1.0x1.0  -90 Occupied from 6.5,5.8
            04-003 at 7.5,7.5 1.0x1.0   90 Occupied from 7.5,6.2
            04-004 at 7.5,4.5 1.0x1.0  -90 Unknown from 7.5,5.8
            04-005 at 8.5,7.5 1.0x1.0   90 Occupied from 8.5,6.2
            04-006 at 8.5,4.5 1.0x1.0  -90 Occupied from 8.5,5.8
            04-007 at 9.5,7.5 1.0x1.0   90 Occupied from 9.5,6.2
            04-008 at 9.5,4.5 1.0x1.0  -90 Occupied from 9.5,5.8
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
        01-001 at 0.2,0.5 1.0x0.5  180 Occupied from 1.2,0.5
        01-002 at 2.2,0.5 1.0x0.5    0 Occupied from 1.2,0.5
        01-003 at 0.2,1.5 1.0x0.5  180 Occupied from 1.2,1.5
        01-004 at 2.2,1.5 1.0x0.5    0 Occupied from 1.2,1.5
        02-001 at 2.8,0.5 1.0x0.5  180 Occupied from 3.5,0.5
        02-002 at 4.2,0.5 1.0x0.5    0 Occupied from 3.5,0.5
        02-003 at 2.8,1.5 1.0x0.5  180 Occupied from 3.5,1.5
        02-004 at 4.2,1.5 1.0x0.5    0 Occupied from 3.5,1.5
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
        01-001 at 0.5,1.8 1.0x0.5   90 Occupied from 0.5,1.0
        01-002 at 0.5,0.2 1.0x0.5  -90 Occupied from 0.5,1.0
        01-003 at 1.5,1.8 1.0x0.5   90 Occupied from 1.5,1.0
        01-004 at 1.5,0.2 1.0x0.5  -90 Occupied from 1.5,1.0
        02-001 at 0.5,3.8 1.0x0.5   90 Occupied from 0.5,3.0
        02-002 at 0.5,2.2 1.0x0.5  -90 Occupied from 0.5,3.0
        02-003 at 1.5,3.8 1.0x0.5   90 Occupied from 1.5,3.0
        02-004 at 1.5,2.2 1.0x0.5  -90 Occupied from 1.5,3.0
    "#]],
    );
}

#[test]
fn a_location_behind_another_has_no_access() {
    let map = DrawnMap::new(
        "
        ##
        ##
        ..
        ..
        ",
        "
        pp
        qq
        cc
        cc
        ",
    );
    let locations = check(
        &map,
        &expect![[r#"
        00-001 at 0.5,1.8 0.5x1.0    0 Occupied no access
        01-001 at 0.5,1.2 1.0x0.5   90 Occupied from 0.5,0.5
    "#]],
    );
    assert_eq!(locations[0].side, None);
    assert!(locations[0].access_edges.is_empty());
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
        01-001 at 0.5,1.2 1.0x0.5   90 Occupied from 0.5,0.8
    "#]],
    );
}

#[test]
fn codes_grow_with_their_numbers() {
    let slot = |aisle, bay| Slot { aisle, bay, side: Some(Side::Left) };
    let codes = |slots: &[Slot]| {
        let codes = Codes::for_slots(slots);
        slots.iter().map(|&slot| codes.of(slot)).collect::<Vec<_>>()
    };
    assert_eq!(codes(&[slot(3, 12)]), ["03-012"]);
    assert_eq!(codes(&[slot(3, 12), slot(120, 1000)]), ["003-0012", "120-1000"]);
}

#[test]
fn a_map_without_storage_has_no_locations() {
    let map = DrawnMap::new("..", "cc");
    assert!(map.locations(&map.semantic(&RuleSet::office())).is_empty());
}
