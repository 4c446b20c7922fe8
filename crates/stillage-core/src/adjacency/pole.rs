//! A point well inside a polygon: its centroid, or its pole of inaccessibility.
//!
//! The centroid is taken when its clearance (distance to the nearest side) is at least area / perimeter, which is half
//! the largest clearance that a convex polygon of that area and perimeter can have. Else the pole of inaccessibility,
//! the point of greatest clearance, is approximated to 5 %: squares that may hold it are split, the most promising
//! first (V. Agafonkin, *polylabel*, 2016). Cost: O(corners x probes), at most 500 probes.

use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::f64::consts::SQRT_2;

use crate::geometry::{Bounds, Point, Vector, polygon, segment};

/// A square is split when the greatest clearance possible in it is more than this times the best found. No measurement
/// is recorded for this value.
const LEAST_GAIN: f64 = 1.05;
/// Greatest number of points whose clearance is measured: shapes that need more are slivers, where any inner point will
/// do.
const MAX_PROBES: usize = 500;

/// A point well inside a polygon: an outer ring and holes (first points not repeated). The origin without corners.
pub(crate) fn pole(rings: &[Vec<Point>]) -> Point {
    let bounds = Bounds::around(rings.iter().flatten());
    if bounds.is_empty() {
        return Point::origin();
    }
    let perimeter: f64 = polygon::sides(rings).map(|[start, end]| (end - start).norm()).sum();
    match polygon::centroid(rings) {
        Some(centroid) if clearance(rings, centroid) >= polygon::area(rings) / perimeter => centroid,
        _ => search(rings, bounds),
    }
}

/// A square of the search, ordered by the greatest clearance possible in it.
struct Square {
    center: Point,
    half: f64,
    clearance: f64,
}

impl Square {
    /// The greatest clearance possible in it.
    fn bound(&self) -> f64 {
        self.clearance + self.half * SQRT_2
    }
}

impl Ord for Square {
    fn cmp(&self, other: &Self) -> Ordering {
        // Equal bounds are ordered by place, so that every search takes the same squares in the same order.
        let place = |square: &Self| (square.center.y, square.center.x);
        let (first, second) = (place(self), place(other));
        let by_bound = self.bound().total_cmp(&other.bound());
        by_bound.then(first.0.total_cmp(&second.0)).then(first.1.total_cmp(&second.1))
    }
}

impl PartialOrd for Square {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Square {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Square {}

/// Distance to the nearest side, negative outside.
fn clearance(rings: &[Vec<Point>], point: Point) -> f64 {
    let mut is_inside = false;
    let mut nearest = f64::INFINITY;
    for side in polygon::sides(rings) {
        is_inside ^= segment::x_at_level(side, point.y).is_some_and(|x| point.x < x);
        nearest = nearest.min(segment::squared_distance(point, side));
    }
    if is_inside { nearest.sqrt() } else { -nearest.sqrt() }
}

/// A point inside: the middle of the widest stretch of the polygon along a level that passes between its corners.
fn some_inner_point(rings: &[Vec<Point>], Bounds { low, high }: Bounds) -> Point {
    let middle = f64::midpoint(low.y, high.y);
    let heights = || rings.iter().flatten().map(|corner| corner.y);
    let below = heights().filter(|&y| y <= middle).fold(low.y, f64::max);
    let above = heights().filter(|&y| y > middle).fold(high.y, f64::min);
    let level = f64::midpoint(below, above);
    let mut crossings: Vec<f64> = polygon::sides(rings).filter_map(|side| segment::x_at_level(side, level)).collect();
    crossings.sort_unstable_by(f64::total_cmp);
    let widest = crossings
        .as_chunks::<2>()
        .0
        .iter()
        .max_by(|first, second| (first[1] - first[0]).total_cmp(&(second[1] - second[0])));
    Point::new(widest.map_or(middle, |[left, right]| f64::midpoint(*left, *right)), level)
}

/// Splits squares until none can hold a clearance worth the effort.
fn search(rings: &[Vec<Point>], bounds: Bounds) -> Point {
    let Bounds { low, high } = bounds;
    let size = high - low;
    // Squares as wide as the narrow side of the bounds, at most 32 along the long side.
    let grain = size.min().max(size.max() / 32.0);
    let square = |center: Point, half: f64| Square { center, half, clearance: clearance(rings, center) };
    let [columns, rows] = [size.x, size.y].map(|extent| (extent / grain).ceil() as usize);
    let mut queue: BinaryHeap<Square> = (0..rows * columns)
        .map(|number| Vector::new((number % columns) as f64 + 0.5, (number / columns) as f64 + 0.5) * grain)
        .map(|offset| square(low + offset, grain / 2.0))
        .collect();
    let mut best = square(some_inner_point(rings, bounds), 0.0);
    for _ in 0..MAX_PROBES / 4 {
        let Some(next) = queue.pop() else { break };
        if next.bound() <= best.clearance * LEAST_GAIN {
            break;
        }
        let half = next.half / 2.0;
        for (x, y) in [(-half, -half), (half, -half), (-half, half), (half, half)] {
            queue.push(square(next.center + Vector::new(x, y), half));
        }
        if next.clearance > best.clearance {
            best = next;
        }
    }
    best.center
}
