//! Where obstacles end and free ground begins.
//!
//! A surface point belongs to an occupied cell beside a free one; its normal points to the free cells around it. Both
//! sensors and drawings show surfaces, whether the inside of a wall is occupied or unknown. The middles of the cells of a
//! slanting wall are the treads of a staircase, and two staircases fit best tread on tread: a cell off, or turned by a
//! fraction of a degree. So each point is moved onto the straight line through the points around it. Cost: O(cells).
//! Limits: what has no free cell beside it has no surface.

use rayon::prelude::*;

use crate::distance_transform::{DistanceTransform, NONE};
use crate::geometry::hash::{split_mix, unit};
use crate::geometry::{Point, Vector};
use crate::grid::{Occupancy, OccupancyGrid};
use crate::watch::{Stopped, Watch};

/// Surfaces whose normals differ by more than 45 degrees are two.
pub(super) const LEAST_COSINE: f64 = 0.7;
/// Free cells this far away, cells, tell a normal: over fewer, the steps of a slanting wall turn it by 45 degrees.
const NORMAL_REACH: i64 = 3;
/// Points this far away, cells, tell the line of a surface: a wall at 1 to 10 and steeper has a whole step within.
const LINE_REACH: usize = 5;
/// Points this far off the cell's own along its normal, cells, are of the same surface: those of a staircase are.
const LINE_WIDTH: f64 = 1.5;
/// Fewest points that tell a line.
const LEAST_ON_LINE: i32 = 5;

/// The surfaces of a grid, and the nearest one of every cell.
pub(super) struct Surfaces<'a> {
    pub grid: &'a OccupancyGrid,
    /// Grid frame, metres.
    pub points: Vec<Point>,
    /// Unit vectors to the free side, by point.
    pub normals: Vec<Vector>,
    /// Whether each point belongs to a wall.
    pub is_wall: Vec<bool>,
    /// Index of the nearest point of every cell; [`NONE`] without any.
    nearest: Vec<u32>,
}

impl<'a> Surfaces<'a> {
    pub fn of(grid: &'a OccupancyGrid, watch: &Watch<'_>) -> Result<Self, Stopped> {
        let (mut points, mut normals, mut is_wall) = (Vec::new(), Vec::new(), Vec::new());
        let walls = crate::walls::find(grid, watch)?;
        let mut index_of = vec![NONE; grid.cells().len()];
        for row in 0..grid.height() {
            watch.check()?;
            for column in (0..grid.width()).filter(|&column| is_surface(grid, column as i64, row as i64)) {
                if let Some(normal) = normal_at(grid, column as i64, row as i64) {
                    index_of[row * grid.width() + column] = points.len() as u32;
                    points.push(grid.center(column, row));
                    normals.push(normal);
                    is_wall.push(walls[row * grid.width() + column]);
                }
            }
        }
        (points, normals) = on_lines(grid, &index_of, &points, &normals);
        let is_target = |cell: usize| index_of[cell] != NONE;
        let mut nearest = DistanceTransform::of(grid.width(), index_of.len(), is_target, watch)?.nearest;
        for cell in nearest.iter_mut().filter(|cell| **cell != NONE) {
            *cell = index_of[*cell as usize];
        }
        Ok(Self { grid, points, normals, is_wall, nearest })
    }

    /// Index of the point nearest to the cell that holds a place; `None` outside the grid and without any surface.
    pub fn nearest(&self, place: Point) -> Option<usize> {
        let (column, row) = self.grid.cell_at(place)?;
        let nearest = self.nearest[row * self.grid.width() + column];
        (nearest != NONE).then_some(nearest as usize)
    }

    /// Indices of about `most` of the points: the same ones at every call.
    pub fn sample(&self, most: usize) -> Vec<usize> {
        let share = most as f64 / self.points.len().max(1) as f64;
        (0..self.points.len()).filter(|&index| unit(split_mix(index as u64)) < share).collect()
    }
}

fn is_surface(grid: &OccupancyGrid, column: i64, row: i64) -> bool {
    let is_free = |(across, up): (i64, i64)| grid.at(column + across, row + up) == Occupancy::Free;
    grid.at(column, row) == Occupancy::Occupied && [(1, 0), (-1, 0), (0, 1), (0, -1)].into_iter().any(is_free)
}

/// The direction to the free cells around a cell; `None` where they lie on all sides alike.
fn normal_at(grid: &OccupancyGrid, column: i64, row: i64) -> Option<Vector> {
    let mut sum = Vector::zeros();
    for up in -NORMAL_REACH..=NORMAL_REACH {
        for across in -NORMAL_REACH..=NORMAL_REACH {
            if grid.at(column + across, row + up) == Occupancy::Free {
                sum += Vector::new(across as f64, up as f64);
            }
        }
    }
    sum.try_normalize(0.5)
}

/// Moves each point onto the line through the points around it that face the same way, and turns its normal to that of the
/// line. `index_of` has the number of the point of every cell.
fn on_lines(grid: &OccupancyGrid, index_of: &[u32], points: &[Point], normals: &[Vector]) -> (Vec<Point>, Vec<Vector>) {
    let on_line = |(&point, &normal): (&Point, &Vector)| {
        line_at(grid, index_of, points, normals, (point, normal)).unwrap_or((point, normal))
    };
    points.par_iter().zip(normals).map(on_line).unzip()
}

/// The foot of a point on the line of its surface, and the normal of the line: least squares of the distances along the
/// point's own normal. `None` where too few points lie around it.
fn line_at(
    grid: &OccupancyGrid,
    index_of: &[u32],
    points: &[Point],
    normals: &[Vector],
    (point, normal): (Point, Vector),
) -> Option<(Point, Vector)> {
    let along = Vector::new(-normal.y, normal.x);
    let (column, row) = grid.cell_at(point)?;
    let rows = within(row, grid.height());
    let cells = rows.flat_map(|row| within(column, grid.width()).map(move |column| row * grid.width() + column));
    let (mut count, mut moments) = (0, [0.0; 4]);
    for cell in cells {
        let index = index_of[cell] as usize;
        if index_of[cell] == NONE || normals[index].dot(&normal) < LEAST_COSINE {
            continue;
        }
        let way = points[index] - point;
        let (at, off) = (way.dot(&along), way.dot(&normal));
        if off.abs() <= LINE_WIDTH * grid.resolution() {
            count += 1;
            for (moment, value) in moments.iter_mut().zip([at, off, at * at, at * off]) {
                *moment += value;
            }
        }
    }
    let [at, off, at_at, at_off] = moments.map(|sum| sum / f64::from(count));
    let spread = at_at - at * at;
    if count < LEAST_ON_LINE || spread <= 0.0 {
        return None;
    }
    let slope = (at_off - at * off) / spread;
    let foot = point + normal * (off - slope * at);
    Some((foot, (normal - along * slope).normalize()))
}

/// The columns or rows around one of them.
fn within(middle: usize, size: usize) -> std::ops::Range<usize> {
    middle.saturating_sub(LINE_REACH)..(middle + LINE_REACH + 1).min(size)
}
