//! The narrowest point of the widest way between two cells: why a vehicle does not get through, and where.
//!
//! Method: cells are reached in the order of their clearance, widest first (the widest-path form of Dijkstra's search,
//! with a bucket for each clearance), from either end until the other one or the hub is met: the largest ground over which
//! the vehicle drives. What lies between the hub and an end is no wider than what was passed last, so a way over the hub is
//! the widest, and the hub itself is not searched. Cost: O(cells around the ends) as a rule, O(cells) at worst; only for
//! routes that were not found.

use super::face_steps::FaceSteps;
use crate::grid::Occupancy;
use crate::site_map::SiteMap;

/// The cell of least clearance on the widest way from one cell to another over drivable ground; `None` where no way leads.
pub(super) fn bottleneck(
    map: &SiteMap<'_>,
    steps: &FaceSteps,
    is_hub: impl Fn(usize) -> bool,
    [start, goal]: [usize; 2],
) -> Option<usize> {
    let first = widest(map, steps, &is_hub, [start, goal])?;
    if first.reached == goal {
        return Some(first.narrowest);
    }
    let second = widest(map, steps, &is_hub, [goal, start])?;
    let over_hub =
        second.reached != start && map.clearance.of_cell(first.narrowest) <= map.clearance.of_cell(second.narrowest);
    Some(if over_hub { first.narrowest } else { second.narrowest })
}

/// The widest way from a cell.
struct Widest {
    /// The cell that it ends at.
    reached: usize,
    /// Its cell of least clearance.
    narrowest: usize,
}

/// The widest way from one cell to another or to the hub, whichever is met first.
fn widest(
    map: &SiteMap<'_>,
    steps: &FaceSteps,
    is_hub: &impl Fn(usize) -> bool,
    [start, goal]: [usize; 2],
) -> Option<Widest> {
    let (width, height) = (map.grid.width(), map.grid.height());
    let clearance = map.clearance.steps();
    let mut buckets: Vec<Vec<u32>> = vec![Vec::new(); usize::from(u16::MAX) + 1];
    let mut is_seen = vec![false; clearance.len()];
    let mut level = usize::from(clearance[start]);
    buckets[level].push(start as u32);
    is_seen[start] = true;
    let mut narrowest = start;
    loop {
        let Some(cell) = buckets[level].pop() else {
            level = level.checked_sub(1)?;
            continue;
        };
        let cell = cell as usize;
        if clearance[cell] < clearance[narrowest] {
            narrowest = cell;
        }
        if cell == goal || is_hub(cell) {
            return Some(Widest { reached: cell, narrowest });
        }
        let (column, row) = (cell % width, cell / width);
        let sides = [
            (column + 1 < width).then(|| cell + 1),
            (row + 1 < height).then(|| cell + width),
            (column > 0).then(|| cell.wrapping_sub(1)),
            (row > 0).then(|| cell.wrapping_sub(width)),
        ];
        for next in sides.into_iter().flatten() {
            let is_drivable =
                map.grid.cells()[next] == Occupancy::Free && steps.is_drivable(map.cells.as_slice()[next]);
            if is_drivable && !is_seen[next] && steps.allows(map, cell, next) {
                is_seen[next] = true;
                let wide = usize::from(clearance[next]);
                buckets[wide].push(next as u32);
                level = level.max(wide);
            }
        }
    }
}
