//! The ground that walls bound: free cells, and what stands on them alone.
//!
//! Table legs, chairs, bins and lone columns stand in a room and do not divide it: obstacles of small extent that touch
//! nothing else count as ground here. (The map keeps them.) All that is not free bounds the ground, known or not:
//! drawings show walls in any grey, and scanners see one side of them. What stands alone, is larger than furniture and
//! as thick as goods is a *stack*: shelves and piles of goods, which are no walls either, but keep their own ground.
//! Cost: O(cells).

use super::stacks;
use crate::components::{Components, Neighbours};
use crate::grid::{Occupancy, OccupancyGrid};
use crate::watch::{Stopped, Watch};

/// Obstacles up to this diagonal that stand alone are furniture, metres: a chair has 0.7, a bin 0.4; a piece of wall
/// between two doors is longer.
const FURNITURE_M: f64 = 1.0;

/// Which cells are ground.
pub(super) struct Ground {
    pub width: usize,
    pub height: usize,
    /// Side of a cell, metres.
    pub cell: f64,
    /// Row-major. No cell of the border is ground, so that every cell of the ground has eight neighbours.
    pub is_free: Vec<bool>,
    /// Whether a cell belongs to a stack that stands alone.
    pub is_stack: Vec<bool>,
}

impl Ground {
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
        ground.tell_obstacles_apart(watch)?;
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

    /// Turns small obstacles that touch no other into ground, and marks larger ones that are stacks.
    fn tell_obstacles_apart(&mut self, watch: &Watch<'_>) -> Result<(), Stopped> {
        let size = [self.width, self.is_free.len()];
        let obstacles = Components::of(size, Neighbours::Eight, |cell| !self.is_free[cell], watch)?;
        for obstacle in obstacles.iter() {
            let [columns, rows] = obstacle.bounds();
            if columns.start == 0 || rows.start == 0 || columns.end == self.width || rows.end == self.height {
                continue;
            }
            if obstacle.diagonal() * self.cell < FURNITURE_M {
                obstacle.cells().for_each(|cell| self.is_free[cell] = true);
            } else if stacks::footprint(obstacle, obstacle.len(), self.cell).is_some() {
                obstacle.cells().for_each(|cell| self.is_stack[cell] = true);
            }
        }
        Ok(())
    }
}
