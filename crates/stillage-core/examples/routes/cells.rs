//! Shortest paths over all cells of a map: what routes are compared with.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use stillage_core::{Occupancy, OccupancyGrid, Point, SiteMap};

/// Lengths from one cell to all others, over the eight neighbours of cells with a clearance, without cutting corners.
pub struct CellPaths {
    /// In thousandths of a cell's side; `u32::MAX` where no path leads.
    lengths: Vec<u32>,
}

/// Costs of a straight and a diagonal step.
const STRAIGHT: u32 = 1_000;
const DIAGONAL: u32 = 1_414;

impl CellPaths {
    /// Dijkstra's search over all cells of drivable faces on which a disc of a radius fits.
    pub fn from(map: &SiteMap<'_>, radius: f64, start: Point) -> Self {
        let (width, height) = (map.grid.width() as isize, map.grid.height() as isize);
        let start = cell_of(map.grid, start);
        let drivable: Vec<bool> = (0..map.semantic.labels.len() as u32)
            .map(|face| map.is_drivable(stillage_core::arrangement::FaceId(face)))
            .collect();
        let least = map.clearance.threshold(radius);
        let is_open = |cell: usize| map.clearance.steps()[cell] >= least && drivable[map.cells.of_cell(cell).index()];
        let mut lengths = vec![u32::MAX; map.grid.cells().len()];
        let mut open = BinaryHeap::from([Reverse((0, start))]);
        lengths[start] = 0;
        while let Some(Reverse((length, cell))) = open.pop() {
            if length > lengths[cell] {
                continue;
            }
            let (column, row) = (cell as isize % width, cell as isize / width);
            for (right, up) in [(1, 0), (0, 1), (-1, 0), (0, -1), (1, 1), (-1, 1), (-1, -1), (1, -1)] {
                let inside = (0..width).contains(&(column + right)) && (0..height).contains(&(row + up));
                if !inside {
                    continue;
                }
                let at = |right: isize, up: isize| ((row + up) * width + column + right) as usize;
                let next = at(right, up);
                let cuts = right != 0 && up != 0 && !(is_open(at(right, 0)) && is_open(at(0, up)));
                let length = length + if right != 0 && up != 0 { DIAGONAL } else { STRAIGHT };
                if is_open(next) && !cuts && length < lengths[next] {
                    lengths[next] = length;
                    open.push(Reverse((length, next)));
                }
            }
        }
        Self { lengths }
    }

    /// Length of the path to a point, metres; `None` where none leads.
    pub fn length_to(&self, map: &SiteMap<'_>, goal: Point) -> Option<f64> {
        let length = self.lengths[cell_of(map.grid, goal)];
        (length != u32::MAX).then(|| f64::from(length) / f64::from(STRAIGHT) * map.grid.resolution())
    }
}

fn cell_of(grid: &OccupancyGrid, point: Point) -> usize {
    let (column, row) = grid.cell_at(point).expect("points are taken from the grid");
    row * grid.width() + column
}

/// Whether a disc around a point touches a cell that is not free, or leaves the grid.
pub fn disc_touches(grid: &OccupancyGrid, middle: Point, radius: f64) -> bool {
    let resolution = grid.resolution();
    let range =
        |place: f64| ((place - radius) / resolution).floor() as i64..=((place + radius) / resolution).floor() as i64;
    range(middle.y).any(|row| {
        range(middle.x).any(|column| {
            let gap = |place: f64, cell: i64| {
                let low = cell as f64 * resolution;
                (low - place).max(place - low - resolution).max(0.0)
            };
            grid.at(column, row) != Occupancy::Free && gap(middle.x, column).hypot(gap(middle.y, row)) < radius - 1e-9
        })
    })
}
