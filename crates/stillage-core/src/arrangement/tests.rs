//! Subdivisions as pictures: `+`, `-` and `|` are segments, one character is one metre.

use std::collections::BTreeSet;
use std::fmt::Write;

use expect_test::{Expect, expect};
use proptest::prelude::*;

use super::lattice::LatticePoint;
use super::*;
use crate::geometry::{Point, direction, fold_half_turn, normal};
use crate::grid::OccupancyGrid;
use crate::line::Line;
use crate::segmentation::RegionMap;

fn segment(number: u32, [x0, y0, x1, y1]: [f64; 4]) -> SourceSegment {
    SourceSegment { start: Point::new(x0, y0), end: Point::new(x1, y1), source: EdgeSource::Line(number) }
}

fn segments(coordinates: &[[f64; 4]]) -> Vec<SourceSegment> {
    (0..).zip(coordinates).map(|(number, &ends)| segment(number, ends)).collect()
}

/// Reads the horizontal and vertical strokes of a picture.
fn strokes(picture: &str) -> Vec<SourceSegment> {
    let rows: Vec<&[u8]> = picture.lines().map(str::as_bytes).collect();
    let width = rows.iter().map(|row| row.len()).max().unwrap_or(0);
    let at = |column: usize, row: usize| rows.get(row).and_then(|row| row.get(column)).copied().unwrap_or(b' ');
    let mut ends = Vec::new();
    for row in 0..rows.len() {
        let mut from = 0;
        for column in 0..=width {
            if !matches!(at(column, row), b'+' | b'-') {
                let y = (rows.len() - row) as f64;
                ends.extend((column > from + 1).then_some([from as f64, y, column as f64 - 1.0, y]));
                from = column + 1;
            }
        }
    }
    for column in 0..width {
        let mut from = 0;
        for row in 0..=rows.len() {
            if !matches!(at(column, row), b'+' | b'|') {
                let y = |row: usize| (rows.len() - row) as f64;
                ends.extend((row > from + 1).then(|| [column as f64, y(from), column as f64, y(row - 1)]));
                from = row + 1;
            }
        }
    }
    segments(&ends)
}

/// Arranges segments and checks all that must hold of any result.
fn arranged(segments: &[SourceSegment]) -> Subdivision {
    let subdivision = arrange(segments, &Watch::unwatched()).expect("nobody stops it");
    subdivision.check_invariants().expect("the subdivision is sound");
    subdivision
}

fn describe(subdivision: &Subdivision) -> String {
    let count = |number: usize, noun: &str| format!("{number} {noun}");
    let mut text = [
        count(subdivision.vertex_count(), "vertices"),
        count(subdivision.edge_count(), "edges"),
        count(subdivision.faces().len(), "bounded faces"),
    ]
    .join(", ");
    for face in subdivision.faces() {
        let rings = subdivision.rings(face);
        write!(text, "\n{face}: {} m2, {} corners", subdivision.area(face), rings[0].len()).expect("strings take all");
        for hole in &rings[1..] {
            write!(text, ", hole of {} corners", hole.len()).expect("strings take all");
        }
    }
    text
}

#[expect(clippy::needless_pass_by_value, reason = "expect! makes a value")]
fn check(picture: &str, expected: Expect) {
    expected.assert_eq(&describe(&arranged(&strokes(picture))));
}

#[test]
fn one_cell() {
    check(
        "
        +---+
        |   |
        +---+
        ",
        expect![[r#"
            4 vertices, 4 edges, 1 bounded faces
            1: 8 m2, 4 corners"#]],
    );
}

#[test]
fn dissolving_a_wall_joins_the_rooms_on_both_sides() {
    let rooms = arranged(&strokes(
        "
        +---+---+
        |   |   |
        |   +---+
        |   |   |
        +---+---+
        ",
    ));
    let is_between_small_rooms = |edge| rooms.sides(edge) == [FaceId(3), FaceId(2)];
    let joined = rooms.dissolve(is_between_small_rooms, &Watch::unwatched()).expect("nobody stops it");
    joined.check_invariants().expect("the subdivision is sound");
    expect![[r#"
        8 vertices, 9 edges, 2 bounded faces
        1: 16 m2, 5 corners
        2: 16 m2, 6 corners"#]]
    .assert_eq(&describe(&joined));
}

#[test]
fn t_junctions_split_the_wall_they_meet() {
    check(
        "
        +---+---+
        |   |   |
        |   +---+
        |   |   |
        +---+---+
        ",
        expect![[r#"
            8 vertices, 10 edges, 3 bounded faces
            1: 16 m2, 5 corners
            2: 8 m2, 4 corners
            3: 8 m2, 4 corners"#]],
    );
}

#[test]
fn crossing_lines_keep_only_what_they_enclose() {
    check(
        "
          |    |
        --+----+--
          |    |
        --+----+--
          |    |
        ",
        expect![[r#"
            4 vertices, 4 edges, 1 bounded faces
            1: 10 m2, 4 corners"#]],
    );
}

#[test]
fn loose_ends_and_what_hangs_on_them_are_dropped() {
    check(
        "
        +----+   +-
        |    |   |
        |  +-+---+
        |    |
        +----+
        ",
        expect![[r#"
            5 vertices, 5 edges, 1 bounded faces
            1: 20 m2, 5 corners"#]],
    );
}

#[test]
fn a_bridge_between_two_cells_bounds_nothing() {
    check(
        "
        +---+   +---+
        |   +---+   |
        +---+   +---+
        ",
        expect![[r#"
            10 vertices, 10 edges, 2 bounded faces
            1: 8 m2, 5 corners
            2: 8 m2, 5 corners"#]],
    );
}

#[test]
fn nested_squares_are_holes_of_one_another() {
    check(
        "
        +--------------+
        | +----+  +--+ |
        | | ++ |  |  | |
        | | ++ |  +--+ |
        | +----+       |
        +--------------+
        ",
        expect![[r#"
            16 vertices, 16 edges, 4 bounded faces
            1: 54 m2, 4 corners, hole of 4 corners, hole of 4 corners
            2: 14 m2, 4 corners, hole of 4 corners
            3: 1 m2, 4 corners
            4: 6 m2, 4 corners"#]],
    );
}

/// A hole that touches the outline in one vertex shares a cycle with it; the rings are simple all the same.
#[test]
fn rings_are_taken_apart_where_they_touch() {
    let subdivision = arranged(&segments(&[
        [0.0, 0.0, 8.0, 0.0],
        [8.0, 0.0, 8.0, 8.0],
        [8.0, 8.0, 0.0, 8.0],
        [0.0, 8.0, 0.0, 0.0],
        [0.0, 0.0, 4.0, 2.0],
        [4.0, 2.0, 2.0, 4.0],
        [2.0, 4.0, 0.0, 0.0],
    ]));
    expect![[r#"
        6 vertices, 7 edges, 2 bounded faces
        1: 58 m2, 4 corners, hole of 3 corners
        2: 6 m2, 3 corners"#]]
    .assert_eq(&describe(&subdivision));
    assert_eq!(subdivision.cycles(FaceId(1)).len(), 1);
}

#[test]
fn two_cells_that_touch_in_a_corner_are_two_holes() {
    let square = |x: f64, y: f64, side: f64| {
        [[x, y, x + side, y], [x + side, y, x + side, y + side], [x, y + side, x + side, y + side], [x, y, x, y + side]]
    };
    let ends = [square(0.0, 0.0, 9.0), square(2.0, 2.0, 2.0), square(4.0, 4.0, 2.0)].concat();
    expect![[r#"
        11 vertices, 12 edges, 3 bounded faces
        1: 73 m2, 4 corners, hole of 4 corners, hole of 4 corners
        2: 4 m2, 4 corners
        3: 4 m2, 4 corners"#]]
    .assert_eq(&describe(&arranged(&segments(&ends))));
}

/// 100 + 100 lines: 100 x 100 vertices, 2 x 100 x 99 edges, 99 x 99 faces and the unbounded one.
#[test]
fn a_comb_of_lines() {
    for turn in [0.0_f64, 0.3] {
        let turned = |x: f64, y: f64| [x * turn.cos() - y * turn.sin(), x * turn.sin() + y * turn.cos()];
        let line = |number: usize| {
            let at = (number / 2 + 1) as f64;
            let [start, end] = if number.is_multiple_of(2) {
                [turned(at, 0.0), turned(at, 101.0)]
            } else {
                [turned(0.0, at), turned(101.0, at)]
            };
            [start[0], start[1], end[0], end[1]]
        };
        let subdivision = arranged(&segments(&(0..200).map(line).collect::<Vec<_>>()));
        let counts = (subdivision.vertex_count(), subdivision.edge_count(), subdivision.face_count());
        assert_eq!(counts, (10_000, 19_800, 9_802));
    }
}

#[test]
fn overlapping_lines_become_one_edge_of_the_least_source() {
    let mut input = segments(&[
        [0.0, 0.0, 10.0, 0.0],
        [2.0, 0.0, 6.0, 0.0],
        [0.0, 3.0, 10.0, 3.0],
        [0.0, -1.0, 0.0, 4.0],
        [10.0, -1.0, 10.0, 4.0],
        [4.0, 0.0, 10.0, 0.0],
    ]);
    input[5].source = EdgeSource::Boundary;
    let subdivision = arranged(&input);
    let level: Vec<_> = subdivision
        .edges()
        .filter(|&edge| subdivision.segment(edge).iter().all(|end| end.y == 0.0))
        .map(|edge| (subdivision.length(edge), subdivision.source(edge)))
        .collect();
    assert_eq!(
        level,
        [
            (2.0, EdgeSource::Line(0)),
            (2.0, EdgeSource::Line(0)),
            (2.0, EdgeSource::Boundary),
            (4.0, EdgeSource::Boundary)
        ]
    );
}

#[test]
fn lines_closer_than_the_lattice_step_merge() {
    let subdivision = arranged(&segments(&[
        [0.0, 0.0, 10.0, 0.0],
        [0.0, 1e-5, 10.0, -1e-5],
        [10.0, 0.0, 10.0, 10.0],
        [0.0, 0.0, 10.0, 10.0],
        [1e-9, 1e-9, 10.0, 10.0],
    ]));
    assert_eq!((subdivision.vertex_count(), subdivision.edge_count(), subdivision.face_count()), (3, 3, 2));
}

/// Near parallels would make slivers by the hundred in floating point; here they stay exact and sound.
#[test]
fn a_fan_of_near_parallels_stays_sound() {
    let line = |number| [0.0, f64::from(number) * 1e-4, 100.0, f64::from(39 - number) * 1e-4];
    let subdivision = arranged(&segments(&(0..40).map(line).collect::<Vec<_>>()));
    assert_no_edges_meet_but_in_their_ends(&subdivision);
}

#[test]
fn degenerate_input_gives_the_unbounded_face_alone() {
    let nan = f64::NAN;
    let infinite = f64::INFINITY;
    for input in [
        vec![],
        vec![[1.0, 1.0, 1.0, 1.0]],
        vec![[0.0, 0.0, 1.0, 0.0]],
        vec![[0.0, 0.0, 1.0, 0.0]; 3],
        vec![[nan, 0.0, 1.0, 0.0], [0.0, infinite, 0.0, 0.0]],
        vec![[0.0, 0.0, f64::MAX, -f64::MAX], [-f64::MAX, 0.0, f64::MAX, 0.0]],
        vec![[0.0, 0.0, f64::MIN_POSITIVE, 0.0]],
        vec![[0.0, 0.0, 4.0, 4.0], [0.0, 4.0, 4.0, 0.0]],
    ] {
        let subdivision = arranged(&segments(&input));
        let counts = (subdivision.vertex_count(), subdivision.edge_count(), subdivision.face_count());
        assert_eq!(counts, (0, 0, 1), "{input:?}");
    }
}

#[test]
fn a_raised_flag_stops_it() {
    struct Nobody;
    impl crate::watch::Observer for Nobody {
        fn progress(&self, _: crate::watch::Stage, _: f64) {}
    }
    let stop = crate::watch::StopFlag::default();
    stop.raise();
    let input = segments(&[[0.0, 0.0, 1.0, 0.0]]);
    assert_eq!(arrange(&input, &Watch::new(&stop, &Nobody)), Err(Stopped));
}

/// Exact, for every pair: no crossing inside, no vertex inside an edge, no overlap.
fn assert_no_edges_meet_but_in_their_ends(subdivision: &Subdivision) {
    let lattice = |vertex| LatticePoint::nearest(subdivision.position(vertex), subdivision.step);
    let vertices: Vec<_> = subdivision.vertices().map(lattice).collect();
    let edges: Vec<_> = subdivision
        .edges()
        .map(|edge| {
            let [low, high] = subdivision.ends(edge).map(|vertex| vertices[vertex.index()]);
            LatticeSegment::between(low, high).expect("edges have length")
        })
        .collect();
    for (number, edge) in edges.iter().enumerate() {
        let is_end = |point: &LatticePoint| [edge.low, edge.high].contains(point);
        for vertex in vertices.iter().filter(|vertex| !is_end(vertex)) {
            assert!(!edge.meets_pixel(*vertex), "{vertex:?} lies within half a step of {edge:?}");
        }
        for other in &edges[..number] {
            let sides = [edge.side(other.low), edge.side(other.high)].map(i64::signum);
            let other_sides = [other.side(edge.low), other.side(edge.high)].map(i64::signum);
            let cross = sides[0] * sides[1] < 0 && other_sides[0] * other_sides[1] < 0;
            assert!(!cross, "{edge:?} crosses {other:?}");
        }
    }
}

/// Random segments of a decomposition's kind: few directions, shared ends, near parallels, near coincident lines.
fn segment_sets() -> impl Strategy<Value = Vec<[f64; 4]>> {
    let anywhere = || (-8.0..8.0, -8.0..8.0, -8.0..8.0, -8.0..8.0).prop_map(|(a, b, c, d)| [a, b, c, d]);
    let shared_ends = (-3_i8..3, -3_i8..3, -3_i8..3, -3_i8..3).prop_map(|(a, b, c, d)| [a, b, c, d].map(f64::from));
    let few_directions =
        (0_u8..4, -4_i8..4, -6.0..6.0, 0.1..9.0).prop_map(|(turn, offset, start, length): (_, _, f64, f64)| {
            let angle = f64::from(turn) * 0.8 + 0.1;
            let [along, across] = [direction(angle), normal(angle)];
            let foot = Point::from(across * f64::from(offset));
            let [start, end] = [foot + along * start, foot + along * (start + length)];
            [start.x, start.y, end.x, end.y]
        });
    let near = (anywhere(), prop::array::uniform4(-3e-4..3e-4)).prop_map(|(ends, shift): ([f64; 4], [f64; 4])| {
        std::array::from_fn(|index| ends[index].round() + shift[index])
    });
    let tiny = prop::array::uniform4(-1e-3..1e-3);
    prop::collection::vec(prop_oneof![anywhere(), shared_ends, few_directions, near, tiny], 0..40)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    #[test]
    fn any_segments_give_a_sound_subdivision(ends in segment_sets()) {
        let subdivision = arranged(&segments(&ends));
        assert_no_edges_meet_but_in_their_ends(&subdivision);
    }

    #[test]
    fn the_order_and_the_direction_of_the_input_are_of_no_consequence(
        (ends, shuffled) in segment_sets().prop_flat_map(|ends| {
            let numbered: Vec<_> = (0..).zip(ends.clone()).collect();
            (Just(ends), Just(numbered).prop_shuffle())
        })
    ) {
        let turned: Vec<_> =
            shuffled.into_iter().map(|(number, [x0, y0, x1, y1])| segment(number, [x1, y1, x0, y0])).collect();
        prop_assert_eq!(arranged(&turned), arranged(&segments(&ends)));
    }

    /// Whatever edges are dissolved, the result is sound and is what arranging the others gives.
    #[test]
    fn dissolved_edges_leave_a_sound_subdivision(ends in segment_sets(), fate in proptest::collection::vec(any::<bool>(), 1..64)) {
        let whole = arranged(&segments(&ends));
        let is_dissolved = |edge: EdgeId| fate[edge.index() % fate.len()];
        let joined = whole.dissolve(is_dissolved, &Watch::unwatched()).expect("nobody stops it");
        joined.check_invariants().expect("the subdivision is sound");
        let kept = whole.edges().filter(|&edge| !is_dissolved(edge));
        let pieces: Vec<SourceSegment> = kept
            .map(|edge| {
                let [start, end] = whole.segment(edge);
                SourceSegment { start, end, source: whole.source(edge) }
            })
            .collect();
        prop_assert_eq!(joined, arranged(&pieces));
    }

    /// Every ring is simple: no vertex twice; the outer one turns left, holes turn right, and their areas add up.
    #[test]
    fn rings_are_simple(ends in segment_sets()) {
        let subdivision = arranged(&segments(&ends));
        for face in subdivision.faces() {
            let rings = subdivision.rings(face);
            for (number, ring) in rings.iter().enumerate() {
                let places: BTreeSet<_> = ring.iter().map(|point| [point.x.to_bits(), point.y.to_bits()]).collect();
                prop_assert_eq!(places.len(), ring.len());
                prop_assert_eq!(crate::geometry::ring_area(ring) > 0.0, number == 0);
            }
        }
    }
}

/// The side of a room as a line of no region, as rooms give it.
fn border_of_room([start, end]: [Point; 2]) -> Line {
    let orientation = fold_half_turn((end.y - start.y).atan2(end.x - start.x));
    let mut extent = [start, end].map(|corner| direction(orientation).dot(&corner.coords));
    extent.sort_by(f64::total_cmp);
    let offset = normal(orientation).dot(&start.coords);
    Line { region: RegionMap::NONE, orientation, offset, support: 0.0, extents: vec![extent] }
}

proptest! {
    #[test]
    fn a_round_room_is_one_face_however_blunt_its_corners(
        corners in 5_usize..90,
        (x, y) in (20.0..30.0, 20.0..30.0),
        radius in 4.0..15.0,
        turn in 0.0..1.0,
    ) {
        let grid = OccupancyGrid::from_ascii(&format!("{}\n", ".".repeat(100)).repeat(100), 0.5);
        let regions = RegionMap { tile_cells: 100, columns: 1, rows: 1, tiles: vec![RegionMap::NONE], regions: vec![] };
        let corner = |at: usize| {
            let angle = (at as f64 + turn) / corners as f64 * std::f64::consts::TAU;
            Point::new(x, y) + direction(angle) * radius
        };
        let lines: Vec<Line> = (0..corners).map(|at| border_of_room([corner(at), corner(at + 1)])).collect();
        let subdivision = arranged(&source_segments(&grid, &regions, &lines, &[], &Watch::unwatched()).unwrap());
        prop_assert_eq!(subdivision.face_count(), 2);
    }
}
