//! Where a vehicle stands to serve a location.
//!
//! Method: of the points before the front, in the corridor, on which the vehicle touches nothing and from which it can drive
//! off, the one nearest to the usual standing distance, and nearest to the middle of the front. They are tried in that order
//! ([`Stands`]), which is the same for all fronts. Cost: one point of most fronts, at worst all candidates (some hundreds).
//! Limits: the vehicle is a disc; one that can drive its own width may still be shut in.

use super::location::{ApproachPose, Location};
use crate::geometry::{Point, Vector, direction, normal};
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
    Stands::new(radius, front.width, map.grid.resolution()).approach(map, front)
}

/// Where a vehicle may stand before a front, the best point first.
pub(super) struct Stands {
    radius: f64,
    /// Distance between candidates, metres.
    step: f64,
    /// Distance from the front and offset from its middle, metres.
    candidates: Vec<[f64; 2]>,
}

impl Stands {
    /// The points for vehicles of a radius before fronts up to this width, on cells of this side, all in metres.
    pub fn new(radius: f64, widest: f64, resolution: f64) -> Self {
        let step = STEP_M.max(resolution);
        let usual = radius + GAP_M;
        let reach = reach(widest, step);
        let distances = (0..=((usual + FARTHEST_M) / step) as i32).map(|count| f64::from(count) * step);
        let offsets = move || (-reach..=reach).map(move |count| f64::from(count) * step);
        let mut candidates: Vec<[f64; 2]> =
            distances.flat_map(|distance| offsets().map(move |offset| [distance, offset])).collect();
        let cost = |[distance, offset]: [f64; 2]| (distance - usual).abs() + ASIDE * offset.abs();
        candidates.sort_by(|&one, &other| cost(one).total_cmp(&cost(other)));
        Self { radius, step, candidates }
    }

    /// Where the vehicle stands before a front.
    pub fn approach(&self, map: &SiteMap<'_>, front: ApproachFront) -> Option<ApproachPose> {
        let ApproachFront { middle, heading, width } = front;
        let (outward, aside) = (-direction(heading), normal(heading));
        let reach = f64::from(reach(width, self.step)) * self.step;
        let before = self.candidates.iter().filter(|[_, offset]| offset.abs() <= reach);
        let points = before.map(|&[distance, offset]| middle + outward * distance + aside * offset);
        let mut stands = points.filter_map(|point| standing(map, point, self.radius));
        let position =
            stands.find(|&stand| [outward, aside, -aside].iter().any(|&way| self.is_open(map, stand, way)))?;
        Some(ApproachPose { position, heading })
    }

    /// Whether the vehicle can drive its own width from a point in a direction.
    fn is_open(&self, map: &SiteMap<'_>, from: Point, way: Vector) -> bool {
        let steps = (2.0 * self.radius / self.step).ceil() as i32;
        (1..=steps).all(|count| {
            let point = from + way * (f64::from(count) * self.step);
            map.clearance.at(point) >= self.radius && map.is_drivable(map.face_at(point))
        })
    }
}

/// Candidates to either side of the middle of a front.
fn reach(width: f64, step: f64) -> i32 {
    (width / 2.0 / step).floor() as i32
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
