//! A fine grid of what stops beams, and the walk of a beam through a grid.

use stillage_core::geometry::{Point, Vector};

use crate::shape::Convex;

/// Where a grid lies: its lower left corner and the side of its cells, metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Lattice {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) resolution: f64,
    pub(crate) origin: Point,
}

impl Lattice {
    /// A lattice around shapes, with some room, its origin on whole cells.
    pub(crate) fn around<'a>(shapes: impl IntoIterator<Item = &'a Convex>, room: f64, resolution: f64) -> Self {
        let empty = (Point::new(f64::INFINITY, f64::INFINITY), Point::new(f64::NEG_INFINITY, f64::NEG_INFINITY));
        let (low, high) = shapes
            .into_iter()
            .map(Convex::bounds)
            .fold(empty, |(low, high), (from, to)| (low.inf(&from), high.sup(&to)));
        let first = [low.x, low.y].map(|value| ((value - room) / resolution).floor());
        let last = [high.x, high.y].map(|value| ((value + room) / resolution).ceil());
        let [width, height] = [0, 1].map(|axis| (last[axis] - first[axis]).max(0.0) as usize);
        Self { width, height, resolution, origin: Point::new(first[0] * resolution, first[1] * resolution) }
    }

    /// The same area in cells of half the size.
    pub(crate) fn halved(&self) -> Self {
        Self { width: self.width * 2, height: self.height * 2, resolution: self.resolution / 2.0, origin: self.origin }
    }

    /// Its lower left and upper right corner.
    #[cfg(test)]
    pub(crate) fn bounds(&self) -> (Point, Point) {
        (self.origin, self.origin + Vector::new(self.width as f64, self.height as f64) * self.resolution)
    }

    /// A point in cells from the lower left corner.
    pub(crate) fn in_cells(&self, point: Point) -> Point {
        Point::from((point - self.origin) / self.resolution)
    }

    /// Index of a cell; `None` outside.
    pub(crate) fn index(&self, column: i64, row: i64) -> Option<usize> {
        let inside = column >= 0 && row >= 0 && (column as usize) < self.width && (row as usize) < self.height;
        inside.then(|| row as usize * self.width + column as usize)
    }

    /// Index of the cell that holds a point; `None` outside.
    pub(crate) fn cell_of(&self, point: Point) -> Option<usize> {
        let at = self.in_cells(point);
        self.index(at.x.floor() as i64, at.y.floor() as i64)
    }

    /// Calls a function for each cell whose centre lies in a shape; for the cell of its middle where there is none.
    pub(crate) fn for_each_cell(&self, shape: &Convex, mut act: impl FnMut(usize)) {
        let (low, high) = shape.bounds();
        let [low, high] = [self.in_cells(low), self.in_cells(high)];
        let rows = low.y.floor().max(0.0) as usize..(high.y.ceil().max(0.0) as usize).min(self.height);
        let mut any = false;
        for row in rows {
            let (left, right) = shape.span(self.origin.y + (row as f64 + 0.5) * self.resolution);
            // A cell more on both sides: whether its centre lies inside is asked below.
            let [left, right] = [left, right].map(|x| (x - self.origin.x) / self.resolution);
            let columns =
                (left.floor() - 1.0).max(0.0) as usize..((right.ceil() + 1.0).max(0.0) as usize).min(self.width);
            for column in columns {
                let center = Vector::new(column as f64 + 0.5, row as f64 + 0.5) * self.resolution;
                if shape.contains(self.origin + center) {
                    any = true;
                    act(row * self.width + column);
                }
            }
        }
        if !any {
            self.cell_of(shape.middle()).into_iter().for_each(act);
        }
    }
}

/// What stops beams, cell by cell.
#[derive(Debug)]
pub(crate) struct Obstacles {
    pub(crate) lattice: Lattice,
    solid: Vec<bool>,
}

impl Obstacles {
    /// Everything is solid but the floor, without what stands on it.
    pub(crate) fn new(lattice: Lattice, floor: &[Convex], solids: &[Convex]) -> Self {
        let mut solid = vec![true; lattice.width * lattice.height];
        for shape in floor {
            lattice.for_each_cell(shape, |cell| solid[cell] = false);
        }
        for shape in solids {
            lattice.for_each_cell(shape, |cell| solid[cell] = true);
        }
        Self { lattice, solid }
    }

    /// Whether a point is solid; outside everything is.
    pub(crate) fn at(&self, point: Point) -> bool {
        self.lattice.cell_of(point).is_none_or(|cell| self.solid[cell])
    }

    /// How far a beam goes along a unit vector, metres; `None` where nothing stops it within its range.
    pub(crate) fn beam(&self, from: Point, direction: Vector, range: f64) -> Option<f64> {
        let cells = Walk::new(self.lattice.in_cells(from), direction);
        let longest = range / self.lattice.resolution;
        for (column, row, distance) in cells {
            if distance > longest {
                return None;
            }
            if self.lattice.index(column, row).is_none_or(|cell| self.solid[cell]) {
                return Some(distance * self.lattice.resolution);
            }
        }
        None
    }
}

/// The cells along a ray with the distance of the entry into each, all in cells: J. Amanatides and A. Woo, *A fast
/// voxel traversal algorithm for ray tracing* (Eurographics 1987, doi 10.2312/egtp.19871000). It never ends.
#[derive(Debug)]
pub(crate) struct Walk {
    column: i64,
    row: i64,
    step: [i64; 2],
    /// Distance of the next border of columns and of rows.
    next: [f64; 2],
    /// Distance between two borders.
    between: [f64; 2],
    distance: f64,
}

impl Walk {
    pub(crate) fn new(from: Point, direction: Vector) -> Self {
        let axis = |start: f64, speed: f64| {
            let to_border = if speed > 0.0 { start.floor() + 1.0 - start } else { start - start.floor() };
            let between = 1.0 / speed.abs();
            // A ray along the other axis meets no border of this one.
            if speed == 0.0 {
                (f64::INFINITY, between, 0)
            } else {
                (to_border * between, between, speed.signum() as i64)
            }
        };
        let ((next_x, between_x, step_x), (next_y, between_y, step_y)) =
            (axis(from.x, direction.x), axis(from.y, direction.y));
        Self {
            column: from.x.floor() as i64,
            row: from.y.floor() as i64,
            step: [step_x, step_y],
            next: [next_x, next_y],
            between: [between_x, between_y],
            distance: 0.0,
        }
    }
}

impl Iterator for Walk {
    type Item = (i64, i64, f64);

    fn next(&mut self) -> Option<Self::Item> {
        let here = (self.column, self.row, self.distance);
        if self.next[0] < self.next[1] {
            self.distance = self.next[0];
            self.next[0] += self.between[0];
            self.column += self.step[0];
        } else {
            self.distance = self.next[1];
            self.next[1] += self.between[1];
            self.row += self.step[1];
        }
        Some(here)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_beam_ends_at_the_wall() {
        let hall = [Convex::rectangle(0.0..4.0, 0.0..3.0)];
        let post = [Convex::rectangle(3.0..3.1, 1.0..1.1)];
        let obstacles = Obstacles::new(Lattice::around(&hall, 0.5, 0.025), &hall, &post);
        let from = Point::new(1.0, 1.05);
        let beam = |x, y| obstacles.beam(from, Vector::new(x, y), 10.0);
        assert!((beam(1.0, 0.0).unwrap() - 2.0).abs() < 0.03);
        assert!((beam(-1.0, 0.0).unwrap() - 1.0).abs() < 0.03);
        assert!((beam(0.0, 1.0).unwrap() - 1.95).abs() < 0.03);
        assert_eq!(obstacles.beam(from, Vector::new(0.0, 1.0), 1.5), None);
    }

    #[test]
    fn a_walk_takes_the_cells_in_order() {
        let cells: Vec<(i64, i64)> = Walk::new(Point::new(0.5, 0.2), Vector::new(0.8, 0.6))
            .take(5)
            .map(|(column, row, _)| (column, row))
            .collect();
        assert_eq!(cells, [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2)]);
    }
}
