//! Where a vehicle stands to serve a location.
//!
//! Method: of the points before the front, in the corridor, on which the vehicle touches nothing, the one nearest to the
//! usual standing distance, and nearest to the middle of the front. Cost: O(candidates), some hundreds per location.
//! Limits: the vehicle is a disc.

use super::location::{ApproachPose, Location};
use crate::geometry::{Point, direction, normal};
use crate::site_map::SiteMap;

/// Distance between the vehicle and the front, metres: our choice, so that it can still turn.
const GAP_M: f64 = 0.2;
/// Greatest distance between the vehicle and the front, metres: the corridor is one vehicle wide or not reached at all.
const FARTHEST_M: f64 = 2.5;
/// Points that are aside of the middle count as this much farther, per metre.
const ASIDE: f64 = 2.0;
/// Distance between candidates, metres; never less than a cell.
const STEP_M: f64 = 0.05;

/// The front of a location, as far as the approach needs it.
#[derive(Debug, Clone, Copy)]
pub(super) struct ApproachFront {
    /// Its middle.
    pub middle: Point,
    /// Into the location, radians.
    pub heading: f64,
    /// Metres.
    pub width: f64,
}

/// Where a vehicle of a radius in metres stands to serve a location; `None` where it finds no room.
#[must_use]
pub fn approach_before(map: &SiteMap<'_>, location: &Location, radius: f64) -> Option<ApproachPose> {
    let front = ApproachFront { middle: location.front?, heading: location.heading, width: location.width };
    approach(map, front, radius)
}

/// Where a vehicle of a radius stands before a front.
pub(super) fn approach(map: &SiteMap<'_>, front: ApproachFront, radius: f64) -> Option<ApproachPose> {
    let ApproachFront { middle, heading, width } = front;
    let (outward, aside) = (-direction(heading), normal(heading));
    let step = STEP_M.max(map.grid.resolution());
    let usual = radius + GAP_M;
    let along = (0..=((usual + FARTHEST_M) / step) as i32).map(|count| f64::from(count) * step);
    let reach = (width / 2.0 / step).floor() as i32;
    let mut best: Option<(f64, ApproachPose)> = None;
    for distance in along {
        for offset in (-reach..=reach).map(|count| f64::from(count) * step) {
            let cost = (distance - usual).abs() + ASIDE * offset.abs();
            if best.is_some_and(|(least, _)| least <= cost) {
                continue;
            }
            if let Some(position) = standing(map, middle + outward * distance + aside * offset, radius) {
                best = Some((cost, ApproachPose { position, heading }));
            }
        }
    }
    best.map(|(_, pose)| pose)
}

/// A point itself, or the middle of its cell, where a vehicle touches nothing on drivable ground.
fn standing(map: &SiteMap<'_>, point: Point, radius: f64) -> Option<Point> {
    let (column, row) = map.grid.cell_at(point)?;
    let middle = map.grid.center(column, row);
    let clearance = map.clearance.at(point);
    if clearance < radius || !map.is_drivable(map.cells.at(column, row)) {
        return None;
    }
    Some(if clearance - (point - middle).norm() >= radius { point } else { middle })
}
