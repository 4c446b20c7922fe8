//! Shortest ways over the eight neighbours of cells within a tile.
//!
//! Source: E. Dijkstra 1959 (doi 10.1007/BF01386390); the open list is a ring of buckets (R. Dial 1969, doi
//! 10.1145/363269.363610), as costs are small whole numbers. Cost: O(cells of the tile).

use std::ops::Range;

use super::drive_grid::DriveGrid;
use super::tiles::TILE;

/// Costs of a straight and of a diagonal step: 99 / 70 is the square root of 2 to 5 digits.
const STRAIGHT: u32 = 70;
const DIAGONAL: u32 = 99;
/// More than a step costs.
const BUCKETS: usize = 128;
/// Columns and rows of the neighbours: right, up, left, down, then each diagonal after its two sides.
const NEIGHBORS: [(isize, isize); 8] = [(1, 0), (0, 1), (-1, 0), (0, -1), (1, 1), (-1, 1), (-1, -1), (1, -1)];
/// The step that led to the start: none.
const HERE: u8 = 8;

/// A search from one cell of a tile over all others. The memory is used again for the next one.
pub(super) struct TileSearch {
    columns: Range<usize>,
    rows: Range<usize>,
    width: usize,
    costs: Vec<u32>,
    steps: Vec<u8>,
    buckets: Vec<Vec<u32>>,
}

impl TileSearch {
    pub fn new() -> Self {
        Self {
            columns: 0..0,
            rows: 0..0,
            width: 0,
            costs: vec![u32::MAX; TILE * TILE],
            steps: vec![HERE; TILE * TILE],
            buckets: vec![Vec::new(); BUCKETS],
        }
    }

    /// Finds the ways from a cell to all others of its tile.
    pub fn run(&mut self, grid: &DriveGrid, [columns, rows]: [Range<usize>; 2], start: usize) {
        (self.columns, self.rows, self.width) = (columns, rows, grid.width);
        self.costs.fill(u32::MAX);
        self.buckets.iter_mut().for_each(Vec::clear);
        let start = self.spot(start);
        self.costs[start] = 0;
        self.steps[start] = HERE;
        self.buckets[0].push(start as u32);
        let (mut cost, mut waiting) = (0_u32, 1_usize);
        while waiting > 0 {
            let Some(spot) = self.buckets[cost as usize % BUCKETS].pop() else {
                cost += 1;
                continue;
            };
            waiting -= 1;
            if self.costs[spot as usize] == cost {
                waiting += self.expand(grid, spot as usize, cost);
            }
        }
    }

    fn spot(&self, cell: usize) -> usize {
        (cell / self.width - self.rows.start) * TILE + cell % self.width - self.columns.start
    }

    fn cell(&self, spot: usize) -> usize {
        (spot / TILE + self.rows.start) * self.width + spot % TILE + self.columns.start
    }

    /// Reaches the neighbours of a spot; answers how many wait anew.
    fn expand(&mut self, grid: &DriveGrid, spot: usize, cost: u32) -> usize {
        let mut reached = 0;
        let here = self.cell(spot);
        for (step, (right, up)) in NEIGHBORS.into_iter().enumerate() {
            let column = (spot % TILE).wrapping_add_signed(right);
            let row = (spot / TILE).wrapping_add_signed(up);
            if column >= self.columns.len() || row >= self.rows.len() {
                continue;
            }
            let next = row * TILE + column;
            let cost = cost + if step < 4 { STRAIGHT } else { DIAGONAL };
            if cost >= self.costs[next] {
                continue;
            }
            let there = self.cell(next);
            let allowed = if step < 4 {
                grid.allows(here, there)
            } else {
                let beside = [here.wrapping_add_signed(right), there.wrapping_add_signed(-right)];
                grid.allows_corner(here, beside, there)
            };
            if allowed {
                self.costs[next] = cost;
                self.steps[next] = step as u8;
                self.buckets[cost as usize % BUCKETS].push(next as u32);
                reached += 1;
            }
        }
        reached
    }

    /// Length of the way to a cell of the tile, cells; `None` where none leads.
    pub fn length_to(&self, cell: usize) -> Option<f64> {
        let cost = self.costs[self.spot(cell)];
        (cost != u32::MAX).then(|| f64::from(cost) / f64::from(STRAIGHT))
    }

    /// The cells of the way to a cell that was reached, without the start.
    pub fn path_to(&self, cell: usize) -> Vec<usize> {
        let mut spot = self.spot(cell);
        let mut path = Vec::new();
        while self.steps[spot] != HERE {
            path.push(self.cell(spot));
            let (right, up) = NEIGHBORS[usize::from(self.steps[spot])];
            spot = (spot / TILE).wrapping_add_signed(-up) * TILE + (spot % TILE).wrapping_add_signed(-right);
        }
        path.reverse();
        path
    }
}
