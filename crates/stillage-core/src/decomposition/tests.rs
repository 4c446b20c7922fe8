//! Halls of racks drawn by their measures, and what the decomposition makes of them.

use expect_test::{Expect, expect};
use proptest::prelude::*;

use super::*;
use crate::geometry::{OrientedBox, Point};
use crate::grid::{GridFrame, Occupancy};
use crate::plot::PlotKind;
use crate::segmentation::Region;

/// Pallets of nine blocks on places of 1.2 x 1.2 m, in double rows along x, with aisles of 3 m, and 3 m of open floor around them.
struct PalletHall {
    places: usize,
    double_rows: usize,
    is_empty: fn(usize) -> bool,
}

const PITCH: f64 = 1.2;
const CLEARANCE: f64 = 3.0;

impl PalletHall {
    fn size(&self) -> [f64; 2] {
        let thickness = 2.0 * PITCH + CLEARANCE;
        [self.places as f64 * PITCH + 2.0 * CLEARANCE, self.double_rows as f64 * thickness + CLEARANCE]
    }

    fn at(&self, x: f64, y: f64) -> Occupancy {
        let [width, height] = self.size();
        if x < 0.1 || y < 0.1 || x > width - 0.1 || y > height - 0.1 {
            return Occupancy::Occupied;
        }
        let (along, across) = (x - CLEARANCE, (y - CLEARANCE).rem_euclid(2.0 * PITCH + CLEARANCE));
        if along < 0.0 || along >= self.places as f64 * PITCH || across >= 2.0 * PITCH || y < CLEARANCE {
            return Occupancy::Free;
        }
        let row = 2 * ((y - CLEARANCE) / (2.0 * PITCH + CLEARANCE)) as usize + (across / PITCH) as usize;
        let place = (along / PITCH) as usize + row * self.places;
        // Blocks of 0.1 m at the sides and in the middle of 1 m.
        let is_block = |offset: f64| [0.1, 0.55, 1.0].iter().any(|&start| (start..start + 0.1).contains(&offset));
        let on_block = is_block(along % PITCH) && is_block(across % PITCH);
        if on_block && !(self.is_empty)(place) { Occupancy::Occupied } else { Occupancy::Free }
    }

    fn grid(&self) -> OccupancyGrid {
        const CELL: f64 = 0.05;
        let [columns, rows] = self.size().map(|side| (side / CELL).round() as usize);
        let cell = |index: usize| {
            let (column, row) = (index % columns, index / columns);
            self.at((column as f64 + 0.5) * CELL, (row as f64 + 0.5) * CELL)
        };
        let frame = GridFrame { resolution: CELL, origin: Point::origin(), yaw: 0.0 };
        OccupancyGrid::new(columns, rows, frame, (0..columns * rows).map(cell).collect())
    }
}

fn one_region(grid: &OccupancyGrid) -> RegionMap {
    let tile_cells = 40;
    let (columns, rows) = (grid.width().div_ceil(tile_cells), grid.height().div_ceil(tile_cells));
    let bounds = OrientedBox { center: Point::origin(), half_extents: [0.0; 2], angle: 0.0 };
    let region = Region { orientations: vec![0.0], bounds, share: 1.0 };
    RegionMap { tile_cells, columns, rows, tiles: vec![0; columns * rows], regions: vec![region] }
}

fn decomposed(grid: &OccupancyGrid) -> Decomposition {
    decompose(grid, &one_region(grid), &DecompositionOptions::default(), &Watch::unwatched()).expect("nobody stops it")
}

/// How many plots of each kind there are, and the size of the places.
fn check(grid: &OccupancyGrid, wanted: &Expect) {
    let found = decomposed(grid);
    let of = |kind: PlotKind| found.plots.iter().filter(move |plot| plot.kind == kind);
    let kinds = [PlotKind::Place, PlotKind::Aisle, PlotKind::OpenFloor, PlotKind::Passage, PlotKind::Other];
    let counts: Vec<String> = kinds.iter().map(|&kind| format!("{} {kind:?}", of(kind).count())).collect();
    let mut sizes: Vec<[f64; 2]> =
        of(PlotKind::Place).map(|plot| plot.bounds.half_extents.map(|half| 2.0 * half)).collect();
    sizes.sort_by(|one, other| one[0].total_cmp(&other[0]));
    let size = sizes.get(sizes.len() / 2).map(|[width, depth]| format!(" of {width:.2} x {depth:.2} m"));
    wanted.assert_eq(&format!("{}{}", counts.join(", "), size.unwrap_or_default()));
}

#[test]
fn a_hall_of_pallets_has_a_place_for_each() {
    let hall = PalletHall { places: 10, double_rows: 2, is_empty: |_| false };
    check(&hall.grid(), &expect!["40 Place, 3 Aisle, 2 OpenFloor, 0 Passage, 4 Other of 1.20 x 1.10 m"]);
}

#[test]
fn empty_places_are_places_too() {
    let hall = PalletHall { places: 12, double_rows: 2, is_empty: |place| place % 13 == 3 };
    check(&hall.grid(), &expect!["48 Place, 3 Aisle, 2 OpenFloor, 0 Passage, 4 Other of 1.20 x 1.10 m"]);
}

/// A row of boxes before a wall and four double rows, 21 places each, in cells of 0.05 m. Boxes of 1.05 x 1.2 m show
/// their outlines and nothing of what is in them; the wall shows between them only.
#[test]
fn goods_before_a_wall_that_they_hide_lie_in_the_site() {
    let [columns, rows, pitch, depth, front] = [600, 598, 24, 24, 102];
    let cell = |index: usize| {
        let (column, row) = (index % columns, index / columns);
        let goes_along_rows = (48..552).contains(&column);
        let is_box = column % pitch < 21;
        // How far behind the front of its row the cell is.
        let behind = match row.checked_sub(front + 60) {
            None => (front - row.min(front)).checked_sub(1),
            Some(row) => Some(row % 108).filter(|&row| row < 2 * depth).map(|row| row.min(2 * depth - 1 - row)),
        }
        .filter(|_| goes_along_rows);
        let is_wall = !(72..rows - 2).contains(&row) || !(2..columns - 2).contains(&column);
        match behind {
            Some(behind) if is_box && behind < depth => {
                let is_outline = behind == 0 || [0, 20].contains(&(column % pitch));
                if is_outline { Occupancy::Occupied } else { Occupancy::Unknown }
            }
            Some(_) if is_box => Occupancy::Unknown,
            _ if row < 70 => Occupancy::Unknown,
            _ if is_wall => Occupancy::Occupied,
            _ => Occupancy::Free,
        }
    };
    let frame = GridFrame { resolution: 0.05, origin: Point::origin(), yaw: 0.0 };
    let grid = OccupancyGrid::new(columns, rows, frame, (0..columns * rows).map(cell).collect());
    check(&grid, &expect!["188 Place, 5 Aisle, 2 OpenFloor, 0 Passage, 6 Other of 1.20 x 1.20 m"]);
}

/// Four double rows of bare racks 24 m long, with posts at one distance from one another, cells.
fn racks(distance: usize) -> OccupancyGrid {
    let (columns, rows) = (600, 480);
    let mut cells = vec![Occupancy::Free; columns * rows];
    for (index, cell) in cells.iter_mut().enumerate() {
        let (column, row) = (index % columns, index / columns);
        if column < 2 || row < 2 || column + 2 >= columns || row + 2 >= rows {
            *cell = Occupancy::Occupied;
        }
    }
    for row in 0..8 {
        let low = row / 2 * 108 + 60 + row % 2 * 24;
        for post in (60..540).step_by(distance) {
            for (x, y) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
                cells[(low + y) * columns + post + x] = Occupancy::Occupied;
                cells[(low + 22 + y) * columns + post + x] = Occupancy::Occupied;
            }
        }
    }
    let frame = GridFrame { resolution: 0.05, origin: Point::origin(), yaw: 0.0 };
    OccupancyGrid::new(columns, rows, frame, cells)
}

#[test]
fn bare_racks_are_combed_by_their_posts() {
    check(&racks(20), &expect!["184 Place, 5 Aisle, 2 OpenFloor, 0 Passage, 4 Other of 1.00 x 1.20 m"]);
}

#[test]
fn a_row_ends_with_its_last_goods() {
    // The first row is two places shorter than the others: floor, and the aisles run on along the others.
    let ragged = PalletHall { places: 10, double_rows: 2, is_empty: |place| (8..10).contains(&place) };
    check(&ragged.grid(), &expect!["38 Place, 3 Aisle, 4 OpenFloor, 0 Passage, 4 Other of 1.20 x 1.10 m"]);
}

#[test]
fn a_passage_goes_through_every_row_that_has_room_for_it() {
    // Three places wide, and closed by the first row only.
    let is_empty = |place: usize| (7..10).contains(&(place % 16)) && place / 16 > 0;
    let hall = PalletHall { places: 16, double_rows: 3, is_empty };
    let found = decomposed(&hall.grid());
    let in_passage = |plot: &&Plot| (plot.bounds.center.x - (CLEARANCE + 8.5 * PITCH)).abs() < 1.5 * PITCH;
    let of = |kind: PlotKind| found.plots.iter().filter(in_passage).filter(|plot| plot.kind == kind).count();
    assert_eq!(of(PlotKind::Place), 3, "those of the first row");
    assert!(of(PlotKind::Passage) >= 5, "one piece of each other row at least");
}

/// A hall in ground that nobody saw, but for a yard behind a gate in its left wall.
#[test]
fn open_floor_reaches_as_far_as_it_was_seen() {
    const YARD: usize = 100;
    let hall = PalletHall { places: 12, double_rows: 2, is_empty: |_| false }.grid();
    let (columns, rows) = (hall.width() + YARD, hall.height() + 40);
    let is_yard = |column: usize, row: usize| column < YARD + 4 && (60..130).contains(&row);
    let cell = |index: usize| {
        let (column, row) = (index % columns, index / columns);
        match (column.checked_sub(YARD), row.checked_sub(20)) {
            _ if is_yard(column, row) => Occupancy::Free,
            (Some(column), Some(row)) if row < hall.height() => hall.row(row)[column],
            _ => Occupancy::Unknown,
        }
    };
    let grid = OccupancyGrid::new(columns, rows, *hall.frame(), (0..columns * rows).map(cell).collect());
    let found = decomposed(&grid);
    let is_open = |plot: &&Plot| matches!(plot.kind, PlotKind::Aisle | PlotKind::OpenFloor | PlotKind::Passage);
    let mut yard = 0;
    for plot in found.plots.iter().filter(is_open) {
        let (column, row) = grid.cell_at(plot.bounds.center).expect("in the grid");
        assert_eq!(grid.row(row)[column], Occupancy::Free, "{plot:?}");
        yard += usize::from(is_yard(column, row));
    }
    assert!(yard > 0, "the yard is open floor of its own");
    assert_eq!(found.plots.iter().filter(|plot| plot.kind == PlotKind::Place).count(), 48, "none out there");
}

#[test]
fn rooms_are_not_combed() {
    let room = "
        ##############################
        #.........#.........#........#
        #.........#.........#........#
        #.........#.........#........#
        #..................#.........#
        ####.######.######...#########
        #............................#
        #............................#
        ##############################
        ";
    // Five cells of 0.1 m for each character.
    let wide = |line: &str| line.trim().chars().flat_map(|symbol| [symbol; 5]).collect::<String>() + "\n";
    let fine: String = room.lines().filter(|line| !line.trim().is_empty()).map(|line| wide(line).repeat(5)).collect();
    check(&OccupancyGrid::from_ascii(&fine, 0.1), &expect!["0 Place, 0 Aisle, 1 OpenFloor, 0 Passage, 4 Other"]);
    // And too coarse to tell.
    check(&OccupancyGrid::from_ascii(room, 0.5), &expect!["0 Place, 0 Aisle, 1 OpenFloor, 0 Passage, 4 Other"]);
}

#[test]
fn grids_without_anything_have_no_lines() {
    for picture in ["", "?", "?????\n?????"] {
        let found = decomposed(&OccupancyGrid::from_ascii(picture, 0.1));
        assert!(found.lines.is_empty() && found.plots.is_empty(), "{picture}: {found:?}");
    }
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let grid = PalletHall { places: 8, double_rows: 1, is_empty: |place| place == 3 }.grid();
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| decomposed(&grid))
    };
    assert_eq!(on(1), on(3));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// Plots of a region do not overlap, whatever the grid.
    #[test]
    fn plots_do_not_overlap(rows in proptest::collection::vec("[.# ]{1,60}", 1..60), resolution in 0.03..0.6) {
        let found = decomposed(&OccupancyGrid::from_ascii(&rows.join("\n"), resolution));
        let size = |plot: &Plot, axis: usize| {
            let turned = plot.bounds.angle.abs() > 1.0;
            plot.bounds.half_extents[if turned { 1 - axis } else { axis }]
        };
        for (index, plot) in found.plots.iter().enumerate() {
            for other in &found.plots[..index] {
                let offset = plot.bounds.center - other.bounds.center;
                let apart = |axis: usize| offset[axis].abs() >= size(plot, axis) + size(other, axis) - 1e-6;
                prop_assert!(apart(0) || apart(1), "{plot:?} and {other:?}");
            }
        }
    }
}
