//! Floors drawn by their measures, and the rows of marks that are found on them.

use std::fmt::Write;

use expect_test::{Expect, expect};

use super::*;
use crate::geometry::{OrientedBox, Point, direction, normal};
use crate::grid::GridFrame;
use crate::segmentation::Region;

const CELL: f64 = 0.05;
/// Sides of the floor, metres.
const FLOOR: [f64; 2] = [16.0, 12.0];

/// Free ground on which boxes stand, `[x, y, length, depth]` in metres along a direction.
fn floor(boxes: &[[f64; 4]], angle: f64) -> OccupancyGrid {
    let [columns, rows] = FLOOR.map(|side| (side / CELL).round() as usize);
    let frame = GridFrame { resolution: CELL, origin: Point::origin(), yaw: 0.0 };
    let mut cells = vec![Occupancy::Free; columns * rows];
    let grid = OccupancyGrid::new(columns, rows, frame, cells.clone());
    for &[x, y, length, depth] in boxes {
        let center = direction(angle) * (x + length / 2.0) + normal(angle) * (y + depth / 2.0);
        let bounds = OrientedBox { center: Point::from(center), half_extents: [length / 2.0, depth / 2.0], angle };
        grid.cells_within(&bounds).for_each(|(column, row)| cells[row * columns + column] = Occupancy::Occupied);
    }
    OccupancyGrid::new(columns, rows, frame, cells)
}

fn found(grid: &OccupancyGrid, angle: f64) -> MarkedRows {
    let bounds = OrientedBox { center: Point::origin(), half_extents: [0.0; 2], angle: 0.0 };
    let region = Region { orientations: vec![angle], bounds, share: 1.0 };
    let tile_cells = grid.width().max(grid.height());
    let regions = RegionMap { tile_cells, columns: 1, rows: 1, tiles: vec![0], regions: vec![region] };
    MarkedRows::find(grid, &regions, &Watch::unwatched()).expect("nobody stops it")
}

/// Rows as `axis: from..to across, borders`, metres.
fn listed(rows: &[MarkedRow]) -> String {
    let mut list = String::new();
    for row in rows {
        let [low, high] = row.across;
        let borders: Vec<String> = row.borders.iter().map(|border| format!("{border:.2}")).collect();
        writeln!(list, "{}: {low:.2}..{high:.2}, {}", row.frame.axis, borders.join(" ")).expect("a string takes all");
    }
    list
}

fn check(boxes: &[[f64; 4]], expected: &Expect) {
    expected.assert_eq(&listed(&found(&floor(boxes, 0.0), 0.0).rows));
}

/// Boxes of a size at every pitch of rows that begin at 1 m and lie at these heights.
fn repeated(count: usize, pitch: f64, [length, depth]: [f64; 2], heights: &[f64]) -> Vec<[f64; 4]> {
    let at = |number: usize| 1.0 + number as f64 * pitch;
    heights.iter().flat_map(|&y| (0..count).map(move |number| [at(number), y, length, depth])).collect()
}

/// The same boxes, moved along their rows.
fn moved(boxes: &[[f64; 4]], by: f64) -> Vec<[f64; 4]> {
    boxes.iter().map(|&[x, y, length, depth]| [x + by, y, length, depth]).collect()
}

#[test]
fn places_between_gaps_may_be_empty() {
    let mut pallets = repeated(8, 1.3, [1.2, 1.0], &[2.0, 5.0]);
    pallets.remove(12);
    pallets.remove(3);
    check(
        &pallets,
        &expect![[r#"
        0: 2.00..3.00, 0.95 2.25 3.55 4.85 6.15 7.45 8.75 10.05 11.35
        0: 5.00..6.00, 0.95 2.25 3.55 4.85 6.15 7.45 8.75 10.05 11.35
    "#]],
    );
}

#[test]
fn frames_stand_on_the_borders_of_bays() {
    // Wider than an aisle for trucks, and the rows are nearer to each other than the frames.
    check(
        &repeated(6, 2.5, [0.1, 1.1], &[2.0, 4.2, 6.4]),
        &expect![[r#"
        0: 2.00..3.10, 1.05 3.55 6.05 8.55 11.05 13.55
        0: 4.20..5.30, 1.05 3.55 6.05 8.55 11.05 13.55
        0: 6.40..7.50, 1.05 3.55 6.05 8.55 11.05 13.55
    "#]],
    );
}

#[test]
fn two_lines_of_uprights_are_the_faces_of_a_row() {
    check(
        &repeated(6, 2.0, [0.1, 0.1], &[2.0, 2.9, 5.0, 5.9]),
        &expect![[r#"
        0: 2.00..3.00, 1.05 3.05 5.05 7.05 9.05 11.05
        0: 5.00..6.00, 1.05 3.05 5.05 7.05 9.05 11.05
    "#]],
    );
}

#[test]
fn two_marks_of_a_place_are_its_legs() {
    let left = repeated(9, 1.2, [0.1, 0.1], &[2.0, 2.9]);
    check(
        &left.iter().copied().chain(moved(&left, 0.9)).collect::<Vec<_>>(),
        &expect![[r#"
            0: 2.00..3.00, 0.90 2.10 3.30 4.50 5.70 6.90 8.10 9.30 10.50 11.70
        "#]],
    );
}

#[test]
fn a_cross_aisle_parts_two_blocks_that_keep_one_pitch() {
    let pallets = repeated(5, 1.3, [1.2, 1.0], &[2.0, 5.0]);
    check(
        &pallets.iter().copied().chain(moved(&pallets, 8.0)).collect::<Vec<_>>(),
        &expect![[r#"
        0: 2.00..3.00, 0.95 2.25 3.55 4.85 6.15 7.45
        0: 2.00..3.00, 8.95 10.25 11.55 12.85 14.15 15.45
        0: 5.00..6.00, 0.95 2.25 3.55 4.85 6.15 7.45
        0: 5.00..6.00, 8.95 10.25 11.55 12.85 14.15 15.45
    "#]],
    );
}

#[test]
fn bays_inside_of_outlines_are_holes() {
    let dividers = repeated(8, 1.5, [0.1, 1.2], &[2.0, 6.0]);
    let fronts = [2.0, 3.1, 6.0, 7.1].map(|y| [1.0, y, 10.6, 0.1]);
    check(
        &dividers.into_iter().chain(fronts).collect::<Vec<_>>(),
        &expect![[r#"
            0: 2.15..3.05, 1.05 2.55 4.05 5.55 7.05 8.55 10.05 11.55
            0: 6.15..7.05, 1.05 2.55 4.05 5.55 7.05 8.55 10.05 11.55
        "#]],
    );
}

#[test]
fn things_at_any_distance_are_no_rows() {
    let at = [1.0, 2.9, 4.1, 7.0, 8.3, 11.9, 13.1];
    let things: Vec<[f64; 4]> =
        at.iter().enumerate().map(|(number, &x)| [x, 1.0 + 1.4 * number as f64, 0.8, 0.6]).collect();
    let found = found(&floor(&things, 0.0), 0.0);
    assert!(found.rows.is_empty() && found.blocks.is_empty(), "{found:?}");
}

#[test]
fn racks_of_two_bays_side_by_side_are_a_block() {
    // The last frame of the second rack stands at a wall, and that of the third is seen in part.
    let mut frames = repeated(3, 2.7, [0.1, 1.0], &[1.0, 3.0, 5.0, 7.0, 9.0]);
    frames.remove(5);
    frames[7][3] = 0.8;
    let found = found(&floor(&frames, 0.0), 0.0);
    expect![[r#"
        0: 1.00..2.00, 1.05 3.75 6.45
        0: 3.00..4.00, 1.05 3.75 6.45
        0: 5.00..6.00, 1.05 3.75 6.45
        0: 7.00..8.00, 1.05 3.75 6.45
        0: 9.00..10.00, 1.05 3.75 6.45
    "#]]
    .assert_eq(&listed(&found.blocks));
}

#[test]
fn turned_rows_are_the_same_rows() {
    let angle = 0.35;
    let pallets = repeated(7, 1.3, [1.1, 1.0], &[-1.0, 2.0]);
    let found = found(&floor(&moved(&pallets, 3.0), angle), angle);
    assert_eq!(found.place_count(), 14, "{}", listed(&found.rows));
    for row in &found.rows {
        assert!((row.borders[0] - 3.9).abs() < 0.05 && (row.borders[7] - 13.0).abs() < 0.05, "{}", listed(&found.rows));
    }
}
