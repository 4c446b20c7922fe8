//! A* over the eight neighbours of cells, without cutting corners.
//!
//! Source: Hart, Nilsson and Raphael 1968 (doi 10.1109/TSSC.1968.300136) with the octile distance; the open list is a
//! ring of buckets (Dial 1969, doi 10.1145/363269.363610), as costs are small whole numbers and a consistent estimate
//! lets the total grow by less than two steps at once. Of cells with the same total the newest is expanded first, so
//! the search crosses open ground directly instead of expanding all of it. Cost: O(cells visited). Memory: 5 bytes per
//! cell of the window. Limits: paths of 43 million steps.

use super::step_rule::StepRule;
use crate::grid::CellBounds;

/// Costs of a straight and of a diagonal step: 99 / 70 is the square root of 2 to 5 digits.
const STRAIGHT: u32 = 70;
const DIAGONAL: u32 = 99;
/// More than the total can grow in one step: a step and as much again for the estimate.
const BUCKETS: usize = 256;

/// Columns and rows of the neighbours: right, up, left, down, then each diagonal after its two sides.
const NEIGHBORS: [(isize, isize); 8] = [(1, 0), (0, 1), (-1, 0), (0, -1), (1, 1), (-1, 1), (-1, -1), (1, -1)];
/// The step that led to the start: none.
const HERE: u8 = 8;

/// The cells of a shortest path from one cell to another within a window, both ends included.
pub(super) fn shortest(rule: &StepRule<'_>, window: &CellBounds, start: usize, goal: usize) -> Option<Vec<usize>> {
    let window = SearchWindow { grid_width: rule.width(), bounds: window.clone() };
    let (start, goal) = (window.spot_of(start)?, window.spot_of(goal)?);
    let mut search = Search::new(window, goal);
    search.reach(start, 0, HERE);
    while let Some((spot, cost)) = search.closest() {
        if spot == goal {
            return Some(search.path_to(goal));
        }
        search.expand(rule, spot, cost);
    }
    None
}

/// A rectangle of the grid.
struct SearchWindow {
    grid_width: usize,
    bounds: CellBounds,
}

/// A cell of a window, by column and row from the window's own lower left corner.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Spot {
    column: usize,
    row: usize,
}

impl SearchWindow {
    /// `None` outside the window.
    fn spot_of(&self, cell: usize) -> Option<Spot> {
        let (column, row) = (cell % self.grid_width, cell / self.grid_width);
        let inside = self.bounds.columns.contains(&column) && self.bounds.rows.contains(&row);
        inside.then(|| Spot { column: column - self.bounds.columns.start, row: row - self.bounds.rows.start })
    }

    fn cell(&self, spot: Spot) -> usize {
        (spot.row + self.bounds.rows.start) * self.grid_width + spot.column + self.bounds.columns.start
    }

    fn index(&self, spot: Spot) -> usize {
        spot.row * self.bounds.columns.len() + spot.column
    }

    fn spot_at(&self, index: usize) -> Spot {
        Spot { column: index % self.bounds.columns.len(), row: index / self.bounds.columns.len() }
    }

    /// `None` outside the window.
    fn neighbor(&self, spot: Spot, step: usize) -> Option<Spot> {
        let (right, up) = NEIGHBORS[step];
        // One before the first column or row wraps to far beyond the last.
        let (column, row) = (spot.column.wrapping_add_signed(right), spot.row.wrapping_add_signed(up));
        (column < self.bounds.columns.len() && row < self.bounds.rows.len()).then_some(Spot { column, row })
    }
}

/// The state of a search.
struct Search {
    window: SearchWindow,
    goal: Spot,
    /// Cost of the best way so far, by index in the window.
    costs: Vec<u32>,
    /// The step that came here, by index in the window.
    steps: Vec<u8>,
    /// Indices in the window, by total (cost + estimate).
    buckets: Vec<Vec<u32>>,
    /// Total of the current bucket.
    total: u32,
    waiting: usize,
}

impl Search {
    fn new(window: SearchWindow, goal: Spot) -> Self {
        let size = window.bounds.columns.len() * window.bounds.rows.len();
        Self {
            window,
            goal,
            costs: vec![u32::MAX; size],
            steps: vec![HERE; size],
            buckets: vec![Vec::new(); BUCKETS],
            total: 0,
            waiting: 0,
        }
    }

    /// Octile distance to the goal: what a free way would cost.
    fn estimate(&self, spot: Spot) -> u32 {
        let columns = spot.column.abs_diff(self.goal.column) as u32;
        let rows = spot.row.abs_diff(self.goal.row) as u32;
        STRAIGHT * columns.max(rows) + (DIAGONAL - STRAIGHT) * columns.min(rows)
    }

    /// Notes a way to a spot that is the best so far.
    fn reach(&mut self, spot: Spot, cost: u32, step: u8) {
        let index = self.window.index(spot);
        self.costs[index] = cost;
        self.steps[index] = step;
        let total = cost + self.estimate(spot);
        if step == HERE {
            self.total = total;
        }
        self.buckets[total as usize % BUCKETS].push(index as u32);
        self.waiting += 1;
    }

    /// The waiting spot of the smallest total, with its cost.
    fn closest(&mut self) -> Option<(Spot, u32)> {
        while self.waiting > 0 {
            let Some(index) = self.buckets[self.total as usize % BUCKETS].pop() else {
                self.total += 1;
                continue;
            };
            self.waiting -= 1;
            let (spot, cost) = (self.window.spot_at(index as usize), self.costs[index as usize]);
            // Otherwise a better way was found since, and the spot has been here already.
            if cost + self.estimate(spot) == self.total {
                return Some((spot, cost));
            }
        }
        None
    }

    /// Reaches the neighbours of a spot. Most were reached before, so costs are compared before cells are read.
    fn expand(&mut self, rule: &StepRule<'_>, spot: Spot, cost: u32) {
        let here = self.window.cell(spot);
        for step in 0..NEIGHBORS.len() {
            let Some(next) = self.window.neighbor(spot, step) else { continue };
            let cost = cost + if step < 4 { STRAIGHT } else { DIAGONAL };
            if cost >= self.costs[self.window.index(next)] {
                continue;
            }
            let there = self.window.cell(next);
            let allowed = if step < 4 {
                rule.allows(here, there)
            } else {
                let beside = [
                    self.window.cell(Spot { column: next.column, row: spot.row }),
                    self.window.cell(Spot { column: spot.column, row: next.row }),
                ];
                rule.allows_corner(here, beside, there)
            };
            if allowed {
                self.reach(next, cost, step as u8);
            }
        }
    }

    fn path_to(&self, goal: Spot) -> Vec<usize> {
        let mut path = vec![self.window.cell(goal)];
        let mut spot = goal;
        loop {
            let step = self.steps[self.window.index(spot)];
            if step == HERE {
                break;
            }
            let (right, up) = NEIGHBORS[usize::from(step)];
            spot = Spot { column: spot.column.wrapping_add_signed(-right), row: spot.row.wrapping_add_signed(-up) };
            path.push(self.window.cell(spot));
        }
        path.reverse();
        path
    }
}
