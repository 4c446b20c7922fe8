//! The widest ways over drivable ground: how wide a vehicle may be to get from some points to others, and where it gets
//! stuck.
//!
//! Method: cells are reached in the order of their clearance, widest first (the widest-path form of Dijkstra's search, with
//! a bucket for each clearance); each keeps the narrowest cell of the way that it is reached on. Cost: O(cells). Memory: 4
//! bytes per cell.

use super::face_steps::{Blocked, FaceSteps};
use crate::geometry::Point;
use crate::grid::Occupancy;
use crate::site_map::SiteMap;

/// The narrowest place of a way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NarrowestPlace {
    /// How far the nearest obstacle is from it, metres.
    pub clearance: f64,
    /// The middle of its cell, grid frame.
    pub at: Point,
}

/// The widest ways from some points to all others, whatever the vehicle.
#[derive(Debug)]
pub struct WidestWays<'a> {
    map: &'a SiteMap<'a>,
    /// By cell: one more than the cell that is the narrowest on the way to it; 0 where no way leads.
    narrowest: Vec<u32>,
}

impl<'a> WidestWays<'a> {
    /// The widest ways from any of some points over the links that may be driven.
    #[must_use]
    pub fn from(map: &'a SiteMap<'a>, starts: &[Point]) -> Self {
        let steps = FaceSteps::new(map, &Blocked::default());
        let cells = starts.iter().filter_map(|&start| cell_of(map, start));
        let (narrowest, _) = spread(map, &steps, cells, |_| false);
        Self { map, narrowest }
    }

    /// The narrowest place of the widest way to a point; `None` where no way leads.
    #[must_use]
    pub fn to(&self, point: Point) -> Option<NarrowestPlace> {
        let cell = (self.narrowest[cell_of(self.map, point)?] as usize).checked_sub(1)?;
        let width = self.map.grid.width();
        let at = self.map.grid.center(cell % width, cell / width);
        Some(NarrowestPlace { clearance: self.map.clearance.of_cell(cell), at })
    }
}

/// Spreads over drivable ground from some cells, the widest ways first, until a cell is reached at which it ends. By cell: one
/// more than the cell that is the narrowest on the way to it, 0 where it was not reached; and the cell at which it ended.
pub(super) fn spread(
    map: &SiteMap<'_>,
    steps: &FaceSteps,
    starts: impl Iterator<Item = usize>,
    is_end: impl Fn(usize) -> bool,
) -> (Vec<u32>, Option<usize>) {
    let (width, cells, clearance) = (map.grid.width(), map.grid.cells(), map.clearance.steps());
    let is_drivable = |cell: usize| cells[cell] == Occupancy::Free && steps.is_drivable(map.cells.of_cell(cell));
    let mut narrowest = vec![0_u32; cells.len()];
    let mut buckets: Vec<Vec<u32>> = vec![Vec::new(); usize::from(u16::MAX) + 1];
    let mut level = 0;
    for cell in starts.filter(|&cell| is_drivable(cell)) {
        if narrowest[cell] == 0 {
            narrowest[cell] = cell as u32 + 1;
            buckets[usize::from(clearance[cell])].push(cell as u32);
            level = level.max(usize::from(clearance[cell]));
        }
    }
    loop {
        let Some(cell) = buckets[level].pop() else {
            let Some(below) = level.checked_sub(1) else { return (narrowest, None) };
            level = below;
            continue;
        };
        let cell = cell as usize;
        if is_end(cell) {
            return (narrowest, Some(cell));
        }
        let so_far = narrowest[cell] as usize - 1;
        let column = cell % width;
        let sides = [
            (column + 1 < width).then(|| cell + 1),
            (cell + width < cells.len()).then(|| cell + width),
            (column > 0).then(|| cell.wrapping_sub(1)),
            (cell >= width).then(|| cell.wrapping_sub(width)),
        ];
        for next in sides.into_iter().flatten() {
            if narrowest[next] == 0 && is_drivable(next) && steps.allows(map, cell, next) {
                let place = if clearance[next] < clearance[so_far] { next } else { so_far };
                narrowest[next] = place as u32 + 1;
                buckets[usize::from(clearance[next])].push(next as u32);
                level = level.max(usize::from(clearance[next]));
            }
        }
    }
}

fn cell_of(map: &SiteMap<'_>, point: Point) -> Option<usize> {
    map.grid.cell_at(point).map(|(column, row)| row * map.grid.width() + column)
}
