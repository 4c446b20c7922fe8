//! A* over the eight neighbours of cells, without cutting corners.
//!
//! Source: Hart, Nilsson and Raphael 1968 (doi 10.1109/TSSC.1968.300136) with the octile distance; the open list is a
//! ring of buckets (Dial 1969, doi 10.1145/363269.363610), as costs are small whole numbers and a consistent estimate
//! lets the total grow by less than two steps at once. The newest of equals comes first, so open ground is crossed
//! once and not flooded.
//! Cost: O(cells visited). Memory: 5 bytes per cell of the window. Limits: 43 million steps.

use super::passage::Passage;
use crate::grid::CellBounds;

/// Costs of a straight and of a diagonal step: 99 / 70 is the square root of 2 to 5 digits.
const STRAIGHT: u32 = 70;
const DIAGONAL: u32 = 99;
/// More than the total can grow in one step: a step and as much again for the estimate.
const BUCKETS: usize = 256;

/// Columns and rows of the neighbours: right, up, left, down, then each diagonal after its two sides.
const NEIGHBORS: [(i64, i64); 8] = [(1, 0), (0, 1), (-1, 0), (0, -1), (1, 1), (-1, 1), (-1, -1), (1, -1)];
/// Not yet reached.
const NOWHERE: u8 = u8::MAX;
/// The start.
const HERE: u8 = 8;

/// The cells of a shortest path from one cell to another within a window, both ends included.
pub(super) fn shortest(passage: &Passage<'_>, window: &CellBounds, start: usize, goal: usize) -> Option<Vec<usize>> {
    let mut search = Search::new(passage.width(), window.clone(), goal)?;
    search.reach(start, 0, HERE)?;
    while let Some((cell, cost)) = search.closest() {
        if cell == goal {
            return Some(search.path_to(goal));
        }
        let neighbor = |index: usize| search.window.neighbor(cell, index);
        let cells: [Option<usize>; 8] = std::array::from_fn(neighbor);
        let straight: [Option<usize>; 4] =
            std::array::from_fn(|index| cells[index].filter(|&side| passage.allows(cell, side)));
        for (index, side) in straight.iter().enumerate() {
            if let Some(side) = *side {
                search.reach(side, cost + STRAIGHT, index as u8);
            }
            let sides = (*side).zip(straight[(index + 1) % 4]);
            if let Some((first, second)) = sides
                && let Some(corner) = cells[index + 4]
                && passage.allows(first, corner)
                && passage.allows(second, corner)
            {
                search.reach(corner, cost + DIAGONAL, index as u8 + 4);
            }
        }
    }
    None
}

/// A rectangle of the grid with indices of its own.
struct Window {
    grid_width: usize,
    bounds: CellBounds,
}

impl Window {
    fn size(&self) -> usize {
        self.bounds.columns.len() * self.bounds.rows.len()
    }

    fn index(&self, cell: usize) -> Option<usize> {
        let (column, row) = (cell % self.grid_width, cell / self.grid_width);
        let inside = self.bounds.columns.contains(&column) && self.bounds.rows.contains(&row);
        inside.then(|| (row - self.bounds.rows.start) * self.bounds.columns.len() + column - self.bounds.columns.start)
    }

    fn neighbor(&self, cell: usize, neighbor: usize) -> Option<usize> {
        let (right, up) = NEIGHBORS[neighbor];
        let column = (cell % self.grid_width).checked_add_signed(right as isize)?;
        let row = (cell / self.grid_width).checked_add_signed(up as isize)?;
        let inside = self.bounds.columns.contains(&column) && self.bounds.rows.contains(&row);
        inside.then(|| row * self.grid_width + column)
    }
}

/// The state of a search.
struct Search {
    window: Window,
    goal: usize,
    /// Cost of the best way so far, by index in the window.
    costs: Vec<u32>,
    /// The step that came here, by index in the window.
    steps: Vec<u8>,
    buckets: Vec<Vec<u32>>,
    /// Total (cost + estimate) of the bucket at hand.
    total: u32,
    waiting: usize,
}

impl Search {
    /// `None` when the goal lies outside the window.
    fn new(grid_width: usize, bounds: CellBounds, goal: usize) -> Option<Self> {
        let window = Window { grid_width, bounds };
        window.index(goal)?;
        let size = window.size();
        Some(Self {
            window,
            goal,
            costs: vec![u32::MAX; size],
            steps: vec![NOWHERE; size],
            buckets: vec![Vec::new(); BUCKETS],
            total: 0,
            waiting: 0,
        })
    }

    /// Octile distance to the goal: what a free way would cost.
    fn estimate(&self, cell: usize) -> u32 {
        let width = self.window.grid_width;
        let columns = (cell % width).abs_diff(self.goal % width) as u32;
        let rows = (cell / width).abs_diff(self.goal / width) as u32;
        STRAIGHT * columns.max(rows) + (DIAGONAL - STRAIGHT) * columns.min(rows)
    }

    /// Notes a way to a cell if it is the best so far; `None` outside the window.
    fn reach(&mut self, cell: usize, cost: u32, step: u8) -> Option<()> {
        let index = self.window.index(cell)?;
        if cost < self.costs[index] {
            self.costs[index] = cost;
            self.steps[index] = step;
            let total = cost + self.estimate(cell);
            if step == HERE {
                self.total = total;
            }
            self.buckets[total as usize % BUCKETS].push(cell as u32);
            self.waiting += 1;
        }
        Some(())
    }

    /// The waiting cell of the smallest total, with its cost.
    fn closest(&mut self) -> Option<(usize, u32)> {
        while self.waiting > 0 {
            let Some(cell) = self.buckets[self.total as usize % BUCKETS].pop() else {
                self.total += 1;
                continue;
            };
            self.waiting -= 1;
            let cell = cell as usize;
            let cost = self.costs[self.window.index(cell)?];
            // A better way was found since: the cell waits, or waited, in an earlier bucket as well.
            if cost + self.estimate(cell) == self.total {
                return Some((cell, cost));
            }
        }
        None
    }

    fn path_to(&self, goal: usize) -> Vec<usize> {
        let mut path = vec![goal];
        let mut cell = goal;
        while let Some(&step) = self.window.index(cell).map(|index| &self.steps[index])
            && step < HERE
        {
            let (right, up) = NEIGHBORS[usize::from(step)];
            let back = right as isize + up as isize * self.window.grid_width as isize;
            cell = cell.wrapping_add_signed(-back);
            path.push(cell);
        }
        path.reverse();
        path
    }
}
