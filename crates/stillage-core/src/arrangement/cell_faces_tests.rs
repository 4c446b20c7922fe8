//! Which face each cell of small grids lies in; one cell is one metre.

use expect_test::expect;
use proptest::prelude::*;

use super::{CellFaces, FaceId};
use crate::geometry::{Point, RigidMotion, Vector, polygon};
use crate::grid::OccupancyGrid;
use crate::test_maps::segments::{boxed, subdivide};

fn picture_of(cells: &CellFaces, width: usize) -> String {
    let row = |row: usize| (0..width).map(|column| cells.at(column, row).to_string()).collect::<String>() + "\n";
    (0..cells.len() / width).rev().map(row).collect()
}

#[test]
fn every_cell_lies_in_the_face_of_its_center() {
    let subdivision =
        boxed([1.0, 1.0, 11.0, 7.0], &[[1.0, 4.0, 11.0, 4.0], [1.0, 1.0, 7.0, 7.0], [3.0, 5.0, 3.0, 6.0]]);
    expect![[r#"
        000000000000
        033333444440
        033334444440
        033344444440
        022111111110
        021111111110
        011111111110
        000000000000
    "#]]
    .assert_eq(&picture_of(&CellFaces::rasterize(&subdivision, 12, 8, 1.0), 12));
}

#[test]
fn a_center_on_an_edge_belongs_to_the_right_or_upper_face() {
    let subdivision = boxed([0.5, 0.5, 3.5, 3.5], &[[1.5, 0.5, 1.5, 3.5], [1.5, 2.5, 3.5, 2.5]]);
    expect![[r#"
        00000
        13300
        12200
        12200
    "#]]
    .assert_eq(&picture_of(&CellFaces::rasterize(&subdivision, 5, 4, 1.0), 5));
}

#[test]
fn grids_without_cells_or_faces_have_nothing_to_fill() {
    for (width, height) in [(0, 0), (0, 3), (3, 0)] {
        assert!(CellFaces::rasterize(&subdivide(&[]), width, height, 0.05).is_empty());
    }
    let cells = CellFaces::rasterize(&subdivide(&[]), 2, 1, 0.05);
    assert_eq!((cells.at(0, 0), cells.at(1, 0)), (FaceId::OUTER, FaceId::OUTER));
    let reaching_out = boxed([-5.0, -5.0, 50.0, 50.0], &[]);
    assert!(CellFaces::rasterize(&reaching_out, 3, 3, 1.0).iter().all(|face| face == FaceId(1)));
}

#[test]
fn maps_of_many_faces_have_wider_numbers() {
    let size = 300;
    let lines = (1..size).map(f64::from).flat_map(|at| [[at, 0.0, at, 300.0], [0.0, at, 300.0, at]]);
    let subdivision = boxed([0.0, 0.0, 300.0, 300.0], &lines.collect::<Vec<_>>());
    let cells = CellFaces::rasterize(&subdivision, 300, 300, 1.0);
    assert!(subdivision.face_count() > 1 << 16, "{}", subdivision.face_count());
    let faces: std::collections::BTreeSet<FaceId> = cells.iter().collect();
    assert_eq!(faces.len(), 300 * 300);
    assert_eq!(cells.runs(0..300 * 300).count(), 300 * 300);
    assert_eq!(cells.at(299, 150), subdivision.face_at(Point::new(299.5, 150.5)));
}

#[test]
fn runs_are_as_long_as_they_can_be() {
    let cells = CellFaces::rasterize(&boxed([1.0, 0.0, 3.0, 2.0], &[]), 4, 2, 1.0);
    let runs: Vec<(u32, std::ops::Range<usize>)> = cells.runs(1..7).map(|(face, run)| (face.0, run)).collect();
    assert_eq!(runs, [(1, 1..3), (0, 3..5), (1, 5..7)]);
}

#[test]
fn another_grid_sees_the_faces_where_it_lies_on_them() {
    let faces = CellFaces::rasterize(&boxed([0.0, 0.0, 4.0, 3.0], &[[2.0, 0.0, 2.0, 3.0]]), 4, 3, 1.0);
    let quarter_turn = RigidMotion { shift: Vector::new(3.0, 0.0), turn: std::f64::consts::FRAC_PI_2 };
    let grid = OccupancyGrid::from_ascii(
        "
        ........
        ........
        ........
        ........
        ",
        0.5,
    );
    expect![[r#"
        11222200
        11222200
        11222200
        11222200
    "#]]
    .assert_eq(&picture_of(
        &faces.seen_on(1.0, &grid, &RigidMotion { shift: Vector::new(1.0, 1.0), ..RigidMotion::identity() }),
        8,
    ));
    expect![[r#"
        11111100
        11111100
        22222200
        22222200
    "#]]
    .assert_eq(&picture_of(&faces.seen_on(1.0, &grid, &quarter_turn), 8));
}

fn crossing_lines() -> impl Strategy<Value = Vec<[f64; 4]>> {
    let anywhere = prop::array::uniform4(-2.0..14.0);
    let on_centers = prop::array::uniform4(-2_i8..14).prop_map(|ends| ends.map(|end| f64::from(end) + 0.5));
    let steep = (0.0..12.0, -1e-3..1e-3).prop_map(|(x, lean): (f64, f64)| [x, -2.0, x + lean, 14.0]);
    let level = (0.0..12.0, -1e-3..1e-3).prop_map(|(y, lean): (f64, f64)| [-2.0, y, 14.0, y + lean]);
    prop::collection::vec(prop_oneof![anywhere, on_centers, steep, level], 0..24)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    /// A cell whose centre is clear of all edges lies in the face whose boundary a ray from it crosses oddly often.
    #[test]
    fn cells_agree_with_point_location(ends in crossing_lines()) {
        let subdivision = subdivide(&ends);
        let cells = CellFaces::rasterize(&subdivision, 12, 12, 1.0);
        for (number, face) in cells.iter().enumerate() {
            let center = Point::new((number % 12) as f64 + 0.5, (number / 12) as f64 + 0.5);
            prop_assert!(face.index() < subdivision.face_count());
            let is_clear = subdivision.edges().all(|edge| {
                let [start, end] = subdivision.segment(edge);
                (end - start).perp(&(center - start)).abs() > 1e-9 * (end - start).norm()
            });
            for other in subdivision.faces().filter(|_| is_clear) {
                prop_assert_eq!(polygon::contains(&subdivision.rings(other), center), face == other);
            }
        }
    }
}
