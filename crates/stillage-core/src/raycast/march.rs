//! One beam, exactly: the grid traversal of J. Amanatides and A. Woo, *A fast voxel traversal algorithm for ray
//! tracing* (Eurographics 1987, doi 10.2312/egtp.19871000).
//!
//! Departure: a beam through the corner of four cells does not step into one of the two cells beside the corner. It
//! goes on into the opposite cell, unless that cell or both cells beside the corner stop beams. So diagonal walls of
//! touching corners stop beams, and a mirrored map has mirrored beams.
//!
//! Cost: O(length of the beam in cells).

use super::beams::{BeamOptions, beam_direction};
use crate::geometry::Vector;
use crate::grid::OccupancyGrid;

/// Crossings of a column border and a row border within this distance are one corner, cells: far above the rounding of
/// distances, far below the distance of two crossings on a grid that fits in memory.
const CORNER: f64 = 1e-9;

/// Length (metres) of the beam from the centre of a cell along a unit vector, to its entry into the first cell that
/// stops it. The cell itself never stops it.
#[must_use]
pub fn march(grid: &OccupancyGrid, cell: (usize, usize), direction: Vector, options: &BeamOptions) -> f64 {
    let limit = options.limit_in_cells(grid.resolution());
    length_in_cells(grid, cell, direction, options, limit).min(limit) * grid.resolution()
}

/// Lengths (metres) of all beams of a cell.
#[must_use]
pub fn march_around(grid: &OccupancyGrid, cell: (usize, usize), options: &BeamOptions) -> Vec<f64> {
    let beam = |index| march(grid, cell, beam_direction(index, options.beams), options);
    (0..options.beams).map(beam).collect()
}

/// Walks from border to border until a cell stops the beam or the limit is passed.
fn length_in_cells(
    grid: &OccupancyGrid,
    (column, row): (usize, usize),
    direction: Vector,
    options: &BeamOptions,
    limit: f64,
) -> f64 {
    let mut columns = Borders::along(direction.x);
    let mut rows = Borders::along(direction.y);
    let (mut column, mut row) = (column as i64, row as i64);
    let passes = |column, row| options.passes_at(grid, column, row);
    loop {
        let (next_column, next_row) = (columns.next(), rows.next());
        let length = next_column.min(next_row);
        if length >= limit {
            return limit;
        }
        if (next_column - next_row).abs() < CORNER {
            let between = passes(column + columns.step, row) || passes(column, row + rows.step);
            column += columns.advance();
            row += rows.advance();
            if !between {
                return length;
            }
        } else if next_column < next_row {
            column += columns.advance();
        } else {
            row += rows.advance();
        }
        if !passes(column, row) {
            return length;
        }
    }
}

/// The cell borders that a beam crosses along one axis.
struct Borders {
    /// 1 or -1.
    step: i64,
    /// Number of borders crossed so far.
    crossed: f64,
    /// Length of the beam from border to border, cells.
    spacing: f64,
}

impl Borders {
    fn along(component: f64) -> Self {
        Self { step: if component < 0.0 { -1 } else { 1 }, crossed: 0.0, spacing: component.abs().recip() }
    }

    /// Distance to the next border, in cells; infinite for a beam that runs along the borders.
    fn next(&self) -> f64 {
        (self.crossed + 0.5) * self.spacing
    }

    /// Crosses the next border.
    fn advance(&mut self) -> i64 {
        self.crossed += 1.0;
        self.step
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const EIGHT: BeamOptions = BeamOptions { beams: 8, max_range_m: None, unknown_blocks: true };

    /// The eight beams of the cell in the middle, in cells, rounded to hundredths.
    fn check(picture: &str, options: &BeamOptions, expected: [f64; 8]) {
        let grid = OccupancyGrid::from_ascii(picture, 1.0);
        let lengths = march_around(&grid, (grid.width() / 2, grid.height() / 2), options);
        let rounded: Vec<f64> = lengths.iter().map(|length| (length * 100.0).round() / 100.0).collect();
        assert_eq!(rounded, expected);
    }

    const ROOM: &str = "
        .......
        .....#.
        .......
        ...?..#
        .......
        ##.....
        ..#....
        ";

    #[test]
    fn a_beam_ends_where_it_enters_a_wall_or_leaves_the_grid() {
        check(&ROOM.replace('?', "."), &EIGHT, [2.5, 2.12, 3.5, 4.95, 3.5, 2.12, 3.5, 4.95]);
    }

    #[test]
    fn a_range_limit_cuts_every_beam() {
        let options = BeamOptions { max_range_m: Some(2.3), ..EIGHT };
        check(&ROOM.replace('?', "."), &options, [2.3, 2.12, 2.3, 2.3, 2.3, 2.12, 2.3, 2.3]);
    }

    #[test]
    fn unknown_cells_stop_beams_only_if_asked() {
        let picture = "
            .......
            .......
            .......
            ..?.  .
            .......
            .......
            .......
            ";
        check(picture, &EIGHT, [0.5, 4.95, 3.5, 4.95, 0.5, 4.95, 3.5, 4.95]);
        let open = BeamOptions { unknown_blocks: false, ..EIGHT };
        check(picture, &open, [3.5, 4.95, 3.5, 4.95, 3.5, 4.95, 3.5, 4.95]);
    }

    #[test]
    fn a_beam_slips_past_one_corner_but_not_between_two() {
        let picture = "
            #.#.#
            .....
            #..#.
            ..#.#
            #.#.#
            ";
        // North-east is open, south-east runs between two corners.
        check(picture, &EIGHT, [0.5, 2.12, 1.5, 2.12, 1.5, 2.12, 0.5, 0.71]);
    }

    /// A grid of up to 12 x 12 cells, a quarter of them occupied.
    fn small_grids() -> impl Strategy<Value = OccupancyGrid> {
        (3_usize..12, 3_usize..12).prop_flat_map(|(width, height)| {
            proptest::collection::vec(prop::bool::weighted(0.25), width * height).prop_map(move |occupied| {
                let picture: Vec<String> = occupied
                    .chunks(width)
                    .map(|row| row.iter().map(|&occupied| if occupied { '#' } else { '.' }).collect())
                    .collect();
                OccupancyGrid::from_ascii(&picture.join("\n"), 0.1)
            })
        })
    }

    /// The same beam in steps of a thousandth of a cell.
    fn brute_force(grid: &OccupancyGrid, (column, row): (usize, usize), direction: Vector) -> f64 {
        let center = Vector::new(column as f64 + 0.5, row as f64 + 0.5);
        (1..1_000_000)
            .map(|step| f64::from(step) * 1e-3)
            .find(|length| {
                let point = center + direction * *length;
                let at = (point.x.floor() as i64, point.y.floor() as i64);
                at != (column as i64, row as i64) && !EIGHT.passes_at(grid, at.0, at.1)
            })
            .expect("the grid ends somewhere")
    }

    proptest! {
        #[test]
        fn marching_agrees_with_tiny_steps(grid in small_grids(), turn in 0.0..std::f64::consts::TAU, at in 0.0..1.0) {
            let cell = (at * grid.cells().len() as f64) as usize;
            let cell = (cell % grid.width(), cell / grid.width());
            let direction = crate::geometry::direction(turn);
            let exact = march(&grid, cell, direction, &EIGHT) / grid.resolution();
            let coarse = brute_force(&grid, cell, direction);
            // Tiny steps may jump over a cell that the beam barely touches.
            prop_assert!(exact <= coarse + 1e-9);
            let entered = Vector::new(cell.0 as f64 + 0.5, cell.1 as f64 + 0.5) + direction * (exact + 1e-6);
            prop_assert!(!EIGHT.passes_at(&grid, entered.x.floor() as i64, entered.y.floor() as i64)
                || coarse - exact < 2e-3);
        }

        #[test]
        fn a_mirrored_map_has_mirrored_beams(grid in small_grids(), at in 0.0..1.0) {
            let cell = (at * grid.cells().len() as f64) as usize;
            let (column, row) = (cell % grid.width(), cell / grid.width());
            let mirrored_cells = (0..grid.height()).flat_map(|row| grid.row(row).iter().rev().copied()).collect();
            let mirrored = OccupancyGrid::new(grid.width(), grid.height(), *grid.frame(), mirrored_cells);
            let lengths = march_around(&grid, (column, row), &EIGHT);
            let mut images = march_around(&mirrored, (grid.width() - 1 - column, row), &EIGHT);
            images[..5].reverse();
            images[5..].reverse();
            prop_assert_eq!(lengths, images);
        }
    }
}
