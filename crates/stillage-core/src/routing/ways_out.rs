//! The ways out to drivable ground, for vehicles that stand beside it.
//!
//! A vehicle may begin or end on free ground that is not drivable by its label: in a room, on a sliver before a rack. It
//! drives to the nearest drivable ground over floor on which it fits, however that is labelled, but not through storage.
//!
//! Method: one breadth-first search from all drivable cells over the floor keeps the step out of every cell. Cost: O(cells)
//! for each radius, then O(length) for a way. Memory: a byte per cell. Limits: the nearest drivable ground may lead nowhere.

use std::collections::VecDeque;

use rayon::prelude::*;

use super::drive_grid::{DriveGrid, window_of};
use crate::arrangement::FaceId;
use crate::site_map::SiteMap;

/// No step leads out of a cell, or none is needed.
const NONE: u8 = 4;

/// Columns and rows of the steps to the cells beside.
const STEPS: [(isize, isize); 4] = [(1, 0), (0, 1), (-1, 0), (0, -1)];

/// For every cell of floor beside drivable ground the step towards it.
#[derive(Debug, Clone)]
pub(super) struct WaysOut {
    width: usize,
    height: usize,
    /// By cell: an index of [`STEPS`], or [`NONE`].
    steps: Vec<u8>,
}

impl WaysOut {
    /// Searches the floor from the drivable ground outwards.
    pub fn new(ground: &DriveGrid, floor: &DriveGrid) -> Self {
        let mut ways = Self { width: ground.width, height: ground.height, steps: Vec::new() };
        let is_beside = |cell: usize| floor.fits(cell) && !ground.fits(cell);
        let first_step = |cell: usize| {
            let out = (0..STEPS.len()).find(|&step| ways.beside(cell, step).is_some_and(|next| ground.fits(next)));
            out.filter(|_| is_beside(cell)).map_or(NONE, |step| step as u8)
        };
        let steps: Vec<u8> = (0..ways.width * ways.height).into_par_iter().map(first_step).collect();
        let mut open: VecDeque<u32> = (0..steps.len() as u32).filter(|&cell| steps[cell as usize] != NONE).collect();
        ways.steps = steps;
        while let Some(cell) = open.pop_front() {
            for step in 0..STEPS.len() {
                let Some(next) = ways.beside(cell as usize, step) else { continue };
                if is_beside(next) && ways.steps[next] == NONE {
                    ways.steps[next] = back(step);
                    open.push_back(next as u32);
                }
            }
        }
        ways
    }

    /// The cell beside another.
    fn beside(&self, cell: usize, step: usize) -> Option<usize> {
        let (right, up) = STEPS[step];
        let column = (cell % self.width).wrapping_add_signed(right);
        let row = (cell / self.width).wrapping_add_signed(up);
        (column < self.width && row < self.height).then(|| row * self.width + column)
    }

    /// The cells from one on floor beside drivable ground to the first on that ground; `None` where none leads.
    fn over_floor(&self, start: usize) -> Option<Vec<usize>> {
        let mut way = vec![start];
        let mut cell = start;
        while self.steps[cell] != NONE {
            cell = self.beside(cell, usize::from(self.steps[cell])).expect("steps stay on the grid");
            way.push(cell);
        }
        (way.len() > 1).then_some(way)
    }

    /// The cells from any free one to the first on drivable ground: over the cells of its own face that `stands` accepts,
    /// then over floor. O(cells of the face) where it is not on floor.
    pub fn from(
        &self,
        map: &SiteMap<'_>,
        ground: &DriveGrid,
        start: usize,
        stands: impl Fn(usize) -> bool,
    ) -> Option<Vec<usize>> {
        let face = map.cells.of_cell(start);
        let is_out = |cell: usize| ground.fits(cell) || self.steps[cell] != NONE;
        let mut way = self.over_face(map, face, start, is_out, stands)?;
        let last = *way.last().expect("a way has its start");
        if !ground.fits(last) {
            way.extend(self.over_floor(last)?.into_iter().skip(1));
        }
        Some(way)
    }

    /// The cells from one of a face to the nearest that is out, over those of the face that `stands` accepts.
    fn over_face(
        &self,
        map: &SiteMap<'_>,
        face: FaceId,
        start: usize,
        is_out: impl Fn(usize) -> bool,
        stands: impl Fn(usize) -> bool,
    ) -> Option<Vec<usize>> {
        if is_out(start) {
            return Some(vec![start]);
        }
        let [columns, rows] = window_of(map, &[face]);
        let spot = |cell: usize| {
            let (column, row) = (cell % self.width, cell / self.width);
            let is_inside = columns.contains(&column) && rows.contains(&row);
            is_inside.then(|| (row - rows.start) * columns.len() + column - columns.start)
        };
        let mut came_by = vec![NONE; columns.len() * rows.len()];
        let mut open = VecDeque::from([start]);
        while let Some(cell) = open.pop_front() {
            for step in 0..STEPS.len() {
                let Some(next) = self.beside(cell, step).filter(|&next| next != start) else { continue };
                if is_out(next) {
                    let mut way = vec![next, cell];
                    let mut at = cell;
                    while at != start {
                        let came = came_by[spot(at)?];
                        at = self.beside(at, usize::from(back(usize::from(came))))?;
                        way.push(at);
                    }
                    way.reverse();
                    return Some(way);
                }
                let Some(spot) = spot(next).filter(|&spot| came_by[spot] == NONE) else { continue };
                if map.cells.of_cell(next) == face && stands(next) {
                    came_by[spot] = step as u8;
                    open.push_back(next);
                }
            }
        }
        None
    }
}

/// The step that leads back.
const fn back(step: usize) -> u8 {
    ((step + 2) % STEPS.len()) as u8
}
