//! The narrowest point of the widest way between two cells: why a vehicle does not get through, and where.
//!
//! Method: the widest ways spread from either end until the other one or the hub is met: the largest ground over which the
//! vehicle drives. What lies between the hub and an end is no wider than what was passed last, so a way over the hub is the
//! widest, and the hub itself is not searched. Cost: O(cells around the ends) as a rule, O(cells) at worst; only for routes
//! that were not found.

use super::face_steps::FaceSteps;
use super::widest_ways::spread;
use crate::site_map::SiteMap;

/// The cell of least clearance on the widest way from one cell to another over drivable ground; `None` where no way leads.
pub(super) fn bottleneck(
    map: &SiteMap<'_>,
    steps: &FaceSteps,
    is_hub: impl Fn(usize) -> bool,
    [start, goal]: [usize; 2],
) -> Option<usize> {
    // The cell that is reached from another, and the narrowest one on the way.
    let widest = |from: usize, to: usize| {
        let (narrowest, reached) = spread(map, steps, [from].into_iter(), |cell| cell == to || is_hub(cell));
        reached.map(|reached| (reached, narrowest[reached] as usize - 1))
    };
    let (reached, narrowest) = widest(start, goal)?;
    if reached == goal {
        return Some(narrowest);
    }
    let (reached, other) = widest(goal, start)?;
    let is_first = reached != start && map.clearance.of_cell(narrowest) <= map.clearance.of_cell(other);
    Some(if is_first { narrowest } else { other })
}
