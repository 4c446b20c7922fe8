//! The cells that a vehicle of a radius may be on, and the steps between them.
//!
//! A vehicle fits on a cell where a disc of its radius around the middle touches no obstacle and the face is drivable. A
//! whole cell is one where it fits on every point. Steps lead to the cells beside, within a face or over a link that may be
//! driven. Obstacles are squares of the grid, so between two middles the vehicle is no nearer to one than at both; between
//! diagonal ones it is no nearer than on the two cells beside, which have to fit as well.
//!
//! Cost: O(cells), rows in parallel. Memory: a byte per cell.

use std::f64::consts::SQRT_2;

use rayon::prelude::*;

use super::face_steps::FaceSteps;
use crate::arrangement::FaceId;
use crate::geometry::Point;
use crate::site_map::SiteMap;

/// The vehicle fits on the middle of the cell.
const FITS: u8 = 1;
/// It fits on every point of the cell.
const WHOLE: u8 = 2;
/// It may drive to the cell on the right.
const RIGHT: u8 = 4;
/// It may drive to the cell above.
const UP: u8 = 8;

/// Where a vehicle may drive, cell by cell.
#[derive(Debug, Clone)]
pub(super) struct DriveGrid {
    pub width: usize,
    pub height: usize,
    pub resolution: f64,
    flags: Vec<u8>,
}

impl DriveGrid {
    /// Reads the cells of a map.
    pub fn new(map: &SiteMap<'_>, steps: &FaceSteps, radius: f64) -> Self {
        let (width, height, resolution) = (map.grid.width(), map.grid.height(), map.grid.resolution());
        let (fits, whole) = thresholds(map, radius);
        let mut flags = vec![0_u8; width * height];
        flags.par_chunks_mut(width.max(1)).enumerate().for_each(|(row, flags)| {
            let cells = row * width..(row + 1) * width;
            let clearances = &map.clearance.steps()[cells.clone()];
            for (_, run) in map.cells.runs(cells.clone()).filter(|(face, _)| steps.is_drivable(*face)) {
                let run = run.start - cells.start..run.end - cells.start;
                for (flag, &clearance) in flags[run.clone()].iter_mut().zip(&clearances[run]) {
                    if clearance >= fits {
                        *flag = if clearance >= whole { FITS | WHOLE } else { FITS };
                    }
                }
            }
        });
        let mut grid = Self { width, height, resolution, flags };
        grid.allow_steps(map, steps, 0..height);
        grid
    }

    /// Writes the steps out of the cells of some rows.
    fn allow_steps(&mut self, map: &SiteMap<'_>, steps: &FaceSteps, rows: std::ops::Range<usize>) {
        let fitting: &[u8] = &self.flags;
        let (width, height) = (self.width, self.height);
        let out = |cell: usize| {
            if fitting[cell] & FITS == 0 {
                return 0;
            }
            let leads = |to: usize| fitting[to] & FITS != 0 && steps.allows(map, cell, to);
            let right = !(cell + 1).is_multiple_of(width) && leads(cell + 1);
            let up = cell / width + 1 < height && leads(cell + width);
            (u8::from(right) * RIGHT) | (u8::from(up) * UP)
        };
        let allowed: Vec<u8> = (rows.start * width..rows.end * width).into_par_iter().map(out).collect();
        for (flag, allowed) in self.flags[rows.start * width..rows.end * width].iter_mut().zip(allowed) {
            *flag = (*flag & (FITS | WHOLE)) | allowed;
        }
    }

    /// Takes cells away, and the steps over some edges: those that `steps` no longer allows. Answers the rows touched.
    pub fn without(&self, map: &SiteMap<'_>, steps: &FaceSteps, rows: std::ops::Range<usize>) -> Self {
        let mut grid = self.clone();
        for cell in rows.start * self.width..rows.end * self.width {
            if !steps.is_drivable(map.cells.of_cell(cell)) {
                grid.flags[cell] = 0;
            }
        }
        let from = rows.start.saturating_sub(1);
        grid.allow_steps(map, steps, from..rows.end);
        grid
    }

    /// Whether the vehicle fits on the middle of a cell.
    pub fn fits(&self, cell: usize) -> bool {
        self.flags[cell] & FITS != 0
    }

    /// Whether it fits on every point of a cell.
    pub fn is_whole(&self, cell: usize) -> bool {
        self.flags[cell] & WHOLE != 0
    }

    /// Whether it may drive from the middle of a cell to that of a cell beside it.
    pub fn allows(&self, from: usize, to: usize) -> bool {
        let (low, high) = (from.min(to), from.max(to));
        let step = if high - low == 1 && self.width > 1 { RIGHT } else { UP };
        self.flags[low] & step != 0
    }

    /// Whether it may drive from the middle of a cell to that of a diagonal neighbour: around both sides of the corner.
    pub fn allows_corner(&self, from: usize, beside: [usize; 2], to: usize) -> bool {
        beside.into_iter().all(|side| self.allows(from, side) && self.allows(side, to))
    }

    /// The middle of a cell.
    pub fn center(&self, cell: usize) -> Point {
        let at = |index: usize| (index as f64 + 0.5) * self.resolution;
        Point::new(at(cell % self.width), at(cell / self.width))
    }

    /// The cell that holds a point; `None` outside.
    pub fn cell_at(&self, point: Point) -> Option<usize> {
        let [column, row] = [point.x, point.y].map(|place| (place / self.resolution).floor());
        let is_inside = column >= 0.0 && row >= 0.0 && column < self.width as f64 && row < self.height as f64;
        is_inside.then(|| row as usize * self.width + column as usize)
    }
}

/// Clearances of cells on which the vehicle fits, and fits everywhere, in the steps of the map.
fn thresholds(map: &SiteMap<'_>, radius: f64) -> (u16, u16) {
    let resolution = map.grid.resolution();
    let half_diagonal = resolution / SQRT_2;
    // A point without extent fits everywhere on a free cell.
    let whole = if radius > 0.0 { radius + half_diagonal } else { 0.0 };
    (map.clearance.threshold(radius), map.clearance.threshold(whole))
}

/// Columns and rows of the cells that some faces reach into.
pub(super) fn window_of(map: &SiteMap<'_>, faces: &[FaceId]) -> [std::ops::Range<usize>; 2] {
    let subdivision = &map.analysis.subdivision;
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for half in faces.iter().flat_map(|&face| subdivision.boundary(face)) {
        let at = subdivision.position(subdivision.half_edge(half).origin) / map.grid.resolution();
        low = [low[0].min(at.x), low[1].min(at.y)];
        high = [high[0].max(at.x), high[1].max(at.y)];
    }
    // Casts of negative and infinite numbers saturate.
    let range = |axis: usize, count: usize| {
        (low[axis].floor() as usize).min(count)..((high[axis].ceil().max(0.0) as usize) + 1).min(count)
    };
    [range(0, map.grid.width()), range(1, map.grid.height())]
}
