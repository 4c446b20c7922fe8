//! A map in few large cells, for the search of shifts.
//!
//! A value says how much surface a cell has against how much free ground; unknown ground is 0. Its product with another
//! overview is positive where surface meets surface and free meets free, negative where surface meets free.
//! Cost: O(cells).

use super::surfaces::Surfaces;
use crate::geometry::{Point, Vector, direction, normal};
use crate::grid::Occupancy;

/// Least side of a cell, metres: a wall in it is wider than its blur.
const LEAST_CELL_M: f64 = 0.25;
/// Cells along the longer side at most: a transform of twice the size takes some milliseconds.
const MOST_CELLS: f64 = 384.0;
/// Value of free ground, where surface has 1: as much as makes a shift by chance worth nothing on maps with a tenth of
/// their cells at surfaces.
const FREE: f32 = -0.1;

/// The values of a rectangle of cells.
pub(super) struct Overview {
    /// Lower left corner, metres.
    pub low: Point,
    /// Side of a cell, metres.
    pub cell: f64,
    pub width: usize,
    pub height: usize,
    /// Row-major, lowest row first.
    pub values: Vec<f32>,
}

/// A cell that fits two maps.
pub(super) fn cell_for(maps: [&Surfaces<'_>; 2]) -> f64 {
    let longest =
        |map: &Surfaces<'_>| map.grid.known_bounds().map_or(0, |bounds| bounds.columns.len().max(bounds.rows.len()));
    let cell = |map: &Surfaces<'_>| longest(map) as f64 * map.grid.resolution() / MOST_CELLS;
    maps.into_iter().map(cell).fold(LEAST_CELL_M, f64::max)
}

impl Overview {
    pub fn of(map: &Surfaces<'_>, cell: f64) -> Self {
        let grid = map.grid;
        let Some(bounds) = grid.known_bounds() else {
            return Self { low: Point::origin(), cell, width: 1, height: 1, values: vec![0.0] };
        };
        let resolution = grid.resolution();
        let low = Point::new(bounds.columns.start as f64, bounds.rows.start as f64) * resolution;
        let side = |cells: usize| (cells as f64 * resolution / cell).ceil() as usize + 1;
        let (width, height) = (side(bounds.columns.len()), side(bounds.rows.len()));
        let mut values = vec![0.0; width * height];
        let at = |place: Point| {
            let offset = (place - low) / cell;
            offset.y as usize * width + offset.x as usize
        };
        // A surface across a cell fills it.
        let across = (resolution / cell) as f32;
        for row in bounds.rows {
            for column in bounds.columns.clone() {
                if grid.at(column as i64, row as i64) == Occupancy::Free {
                    values[at(grid.center(column, row))] += FREE * across * across;
                }
            }
        }
        for &point in &map.points {
            values[at(point)] += across;
        }
        for value in &mut values {
            *value = value.min(1.0);
        }
        Self { low, cell, width, height, values }
    }

    /// The overview turned about the origin.
    pub fn turned(&self, turn: f64) -> Self {
        let (u, v) = (direction(turn), normal(turn));
        let end = self.low + Vector::new(self.width as f64, self.height as f64) * self.cell;
        let corners = [[self.low.x, self.low.y], [end.x, self.low.y], [self.low.x, end.y], [end.x, end.y]];
        let corners = corners.map(|[x, y]| Point::origin() + u * x + v * y);
        let low = corners.iter().fold(Point::new(f64::INFINITY, f64::INFINITY), |low, corner| low.inf(corner));
        let high = corners.iter().fold(low, |high, corner| high.sup(corner));
        let side = |metres: f64| (metres / self.cell).ceil() as usize + 1;
        let (width, height) = (side(high.x - low.x), side(high.y - low.y));
        let value = |index: usize| {
            let place =
                low.coords + Vector::new((index % width) as f64 + 0.5, (index / width) as f64 + 0.5) * self.cell;
            // The turn back is the transpose.
            self.between((Point::new(u.dot(&place), v.dot(&place)) - self.low) / self.cell)
        };
        Self { low, cell: self.cell, width, height, values: (0..width * height).map(value).collect() }
    }

    /// The value between the middles of four cells; `place` in cells from the lower left corner.
    fn between(&self, place: Vector) -> f32 {
        let (x, y) = (place.x - 0.5, place.y - 0.5);
        let (column, row) = (x.floor(), y.floor());
        let (right, up) = ((x - column) as f32, (y - row) as f32);
        let at = |column: f64, row: f64| {
            let inside = column >= 0.0 && row >= 0.0 && column < self.width as f64 && row < self.height as f64;
            if inside { self.values[row as usize * self.width + column as usize] } else { 0.0 }
        };
        let low = at(column, row) * (1.0 - right) + at(column + 1.0, row) * right;
        let high = at(column, row + 1.0) * (1.0 - right) + at(column + 1.0, row + 1.0) * right;
        low * (1.0 - up) + high * up
    }
}
