//! From where locations are reached.

use super::*;

#[test]
fn a_location_behind_another_is_reached_through_it() {
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
            01-001 at 0.5,1.2 1.0x0.5   90 Occupied from 0.8,0.8
            01-001-2 at 0.5,1.8 1.0x0.5   90 Occupied from 0.8,0.8
        "#]],
    );
    let depths: Vec<u32> = locations.iter().map(|location| location.depth_in_row).collect();
    assert_eq!(depths, [1, 2]);
    assert_eq!(locations[0].access_edges, locations[1].access_edges);
}

#[test]
fn places_at_the_end_of_a_row_are_reached_like_the_others() {
    // A row alone on open floor: the outer places have a long side to the left and the right.
    let map = DrawnMap::new(
        "
        ............
        ............
        ............
        ...######...
        ...######...
        ...######...
        ............
        ............
        ............
        ",
        "
        cccccccccccc
        cccccccccccc
        cccccccccccc
        cccppqqppccc
        cccppqqppccc
        cccppqqppccc
        cccccccccccc
        cccccccccccc
        cccccccccccc
        ",
    );
    let locations = map.layout(&map.semantic(&RuleSet::warehouse())).locations;
    let headings: BTreeSet<i32> = locations.iter().map(|place| place.heading.to_degrees().round() as i32).collect();
    assert_eq!((locations.len(), headings.len()), (3, 1), "{headings:?}");
    assert_eq!(headings.into_iter().next().map(i32::abs), Some(90));
}

#[test]
fn a_rack_on_a_crossing_is_reached_from_there() {
    // The rules give no access from junctions, and no corridor borders the rack.
    let map = DrawnMap::new(
        "
        ####
        ....
        ....
        ",
        "
        ppqq
        jjjj
        jjjj
        ",
    );
    check(
        &map,
        &expect![[r#"
        01-001 at 0.5,1.2 1.0x0.5   90 Occupied from 0.8,0.8
        01-003 at 1.5,1.2 1.0x0.5   90 Occupied from 1.2,0.8
    "#]],
    );
}

#[test]
fn a_rack_behind_a_narrow_strip_is_reached_over_it() {
    let map = DrawnMap::new(
        "
        ####
        ....
        ....
        ....
        ",
        "
        ppqq
        xxxx
        cccc
        cccc
        ",
    );
    check(
        &map,
        &expect![[r#"
        01-001 at 0.5,1.8 1.0x0.5   90 Occupied from 0.5,0.5
        01-003 at 1.5,1.8 1.0x0.5   90 Occupied from 1.8,0.8
    "#]],
    );
}

#[test]
fn a_place_behind_a_gap_in_the_goods_lies_behind_those_in_front() {
    let map = DrawnMap::new(
        "
        ##
        ##
        ..
        ##
        ##
        ..
        ..
        ",
        "
        pp
        pp
        xx
        qq
        qq
        cc
        cc
        ",
    );
    check(
        &map,
        &expect![[r#"
        01-001 at 0.5,1.5 1.0x1.0   90 Occupied from 0.8,0.8
        01-001-2 at 0.5,3.0 1.0x1.0   90 Occupied from 0.8,0.8
    "#]],
    );
}

#[test]
fn nobody_stands_where_a_column_shuts_the_way() {
    // Before the middle of the front a vehicle would touch nothing, but could not drive off.
    let map = DrawnMap::new(
        "
        ######
        .#.#..
        .###..
        ......
        ",
        "
        pppppp
        cccccc
        cccccc
        cccccc
        ",
    );
    check(
        &map,
        &expect![[r#"
        01-001 at 1.5,1.8 3.0x0.5   90 Occupied from 2.2,1.2
    "#]],
    );
}
