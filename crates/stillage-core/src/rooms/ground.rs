//! The ground that rooms are made of: free cells, and small obstacles that stand on them alone.
//!
//! Table legs, chairs, bins and lone columns stand in a room and do not divide it, so small obstacles that touch
//! nothing else count as ground here. (The map keeps them.) All other cells that are not free bound the ground, whether
//! occupied or unknown: drawings show walls in any grey, and scanners see one side of them. An obstacle that stands
//! alone, is larger than furniture and as thick as goods is a *stack*: a shelf or a pile of goods. It is no ground, and
//! no wall either. Small ground that it encloses is part of it: drawings show goods by their outlines.
//! Cost: O(cells), and O(n log n) for the n cells of each large obstacle.

use std::collections::BTreeSet;

use super::stacks;
use crate::components::{Component, Components, Neighbours};
use crate::geometry::Point;
use crate::grid::{Occupancy, OccupancyGrid};
use crate::watch::{Stopped, Watch};

/// Largest diagonal of furniture, metres: a chair has 0.7, a bin 0.4; a piece of wall between two doors is longer.
const FURNITURE_M: f64 = 1.0;

/// Largest diagonal of desks and shelves that stand together, metres: a block of four desks has 3.6.
const DESKS_M: f64 = 4.0;
/// Greatest thickness of a piece of wall, metres, with what is hung on it.
const THICKEST_WALL_M: f64 = 0.4;

/// Largest ground that is the inside of a stack, square metres: a place of the largest pitch and depth, 3.2 by 1.8 m.
/// Nobody enters it, since nothing opens.
const COMPARTMENT_M2: f64 = 5.8;

/// Columns and rows of two cells at which an opening begins and ends.
pub(super) type Jambs = [[i64; 2]; 2];

/// Which cells are ground.
#[derive(Clone)]
pub(super) struct RoomGround {
    /// Columns of the grid.
    pub width: usize,
    /// Rows of the grid.
    pub height: usize,
    /// Side of a cell, metres.
    pub cell: f64,
    /// Whether each cell is ground, row-major. No cell of the border is, so that every one has eight neighbours.
    pub is_free: Vec<bool>,
    /// Whether a cell belongs to a stack that stands alone.
    pub is_stack: Vec<bool>,
}

impl RoomGround {
    pub(super) fn of(grid: &OccupancyGrid, watch: &Watch<'_>) -> Result<Self, Stopped> {
        let (width, height) = (grid.width(), grid.height());
        let on_border = |cell: usize| {
            let (column, row) = (cell % width, cell / width);
            column == 0 || row == 0 || column + 1 == width || row + 1 == height
        };
        let cells = grid.cells().iter().enumerate();
        let is_free = cells.map(|(cell, &occupancy)| occupancy == Occupancy::Free && !on_border(cell)).collect();
        let is_stack = vec![false; width * height];
        let mut ground = Self { width, height, cell: grid.resolution(), is_free, is_stack };
        ground.sort_obstacles(watch)?;
        Ok(ground)
    }

    /// Metres -> whole cells, at least one.
    pub(super) fn cells_of(&self, metres: f64) -> usize {
        ((metres / self.cell).round() as usize).max(1)
    }

    /// Whether a cell is ground; no cell outside the map is.
    pub(super) fn holds(&self, column: i64, row: i64) -> bool {
        (0..self.width as i64).contains(&column)
            && (0..self.height as i64).contains(&row)
            && self.is_free[row as usize * self.width + column as usize]
    }

    /// The eight cells around one of the ground.
    pub(super) fn around(&self, cell: usize) -> [usize; 8] {
        let (below, above) = (cell - self.width, cell + self.width);
        [below - 1, below, below + 1, cell - 1, cell + 1, above - 1, above, above + 1]
    }

    /// The middle of a cell, given by its column and row, metres.
    pub(super) fn middle_of(&self, [column, row]: [i64; 2]) -> Point {
        Point::new(column as f64 + 0.5, row as f64 + 0.5) * self.cell
    }

    /// Column and row of the cell at a point, metres; it may lie outside the map.
    pub(super) fn place_of(&self, point: Point) -> [i64; 2] {
        [point.x, point.y].map(|side| (side / self.cell).floor() as i64)
    }

    /// The cell at a point, metres, if it is ground.
    pub(super) fn cell_at(&self, point: Point) -> Option<usize> {
        let [column, row] = self.place_of(point);
        self.holds(column, row).then(|| row as usize * self.width + column as usize)
    }

    /// The cells of a line from one cell to another: no step up, down, left or right leads through between two of them.
    pub(super) fn cells_between(&self, &[from, to]: &Jambs) -> impl Iterator<Item = usize> + use<> {
        let span = [to[0] - from[0], to[1] - from[1]];
        let steps = 2 * span[0].abs().max(span[1].abs()).max(1);
        let width = self.width;
        (0..=steps).map(move |step| {
            let at = |axis: usize| (from[axis] as f64 + (span[axis] * step) as f64 / steps as f64).round() as usize;
            at(1) * width + at(0)
        })
    }

    /// Turns desks and shelves into ground: what stands alone, is no longer than [`DESKS_M`] and no straight piece of wall,
    /// unless it is a part of some walls.
    pub(super) fn clear_furniture(&mut self, walls: &[Jambs], watch: &Watch<'_>) -> Result<(), Stopped> {
        let ends = walls.iter().flatten().map(|&[column, row]| row as usize * self.width + column as usize);
        let is_wall: BTreeSet<usize> = ends.collect();
        let size = [self.width, self.is_free.len()];
        let is_obstacle = |cell: usize| !self.is_free[cell] && !self.is_stack[cell];
        let obstacles = Components::of(size, Neighbours::Eight, is_obstacle, watch)?;
        for obstacle in obstacles.iter() {
            if !self.is_at_border(obstacle)
                && obstacle.diagonal() * self.cell < DESKS_M
                && obstacle.smallest_box(self.cell).sides()[1] >= THICKEST_WALL_M
                && !obstacle.cells().any(|cell| is_wall.contains(&cell))
            {
                obstacle.cells().for_each(|cell| self.is_free[cell] = true);
            }
        }
        Ok(())
    }

    /// Turns small obstacles that stand alone into ground, and marks larger ones that are stacks, with what they enclose.
    fn sort_obstacles(&mut self, watch: &Watch<'_>) -> Result<(), Stopped> {
        let size = [self.width, self.is_free.len()];
        let compartments = self.compartments(watch)?;
        let is_closed = |cell: usize| !self.is_free[cell] || compartments[cell];
        let obstacles = Components::of(size, Neighbours::Eight, is_closed, watch)?;
        for obstacle in obstacles.iter() {
            if self.is_at_border(obstacle) {
                continue;
            }
            if obstacle.diagonal() * self.cell < FURNITURE_M {
                obstacle.cells().for_each(|cell| self.is_free[cell] = true);
            } else if stacks::footprint(obstacle, obstacle.len(), self.cell).is_some() {
                obstacle.cells().for_each(|cell| (self.is_stack[cell], self.is_free[cell]) = (true, false));
            }
        }
        Ok(())
    }

    /// Whether an obstacle reaches the border of the grid.
    fn is_at_border(&self, obstacle: Component<'_>) -> bool {
        let [columns, rows] = obstacle.bounds();
        columns.start == 0 || rows.start == 0 || columns.end == self.width || rows.end == self.height
    }

    /// Which cells are ground without an opening and too small for a room.
    fn compartments(&self, watch: &Watch<'_>) -> Result<Vec<bool>, Stopped> {
        let mut is_inside = vec![false; self.is_free.len()];
        let size = [self.width, self.is_free.len()];
        let grounds = Components::of(size, Neighbours::Four, |cell| self.is_free[cell], watch)?;
        for ground in grounds.iter().filter(|ground| ground.len() as f64 * self.cell.powi(2) <= COMPARTMENT_M2) {
            ground.cells().for_each(|cell| is_inside[cell] = true);
        }
        Ok(is_inside)
    }
}
