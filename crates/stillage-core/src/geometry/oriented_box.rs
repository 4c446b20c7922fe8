//! Rectangles of any direction.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use super::convex_hull::convex_hull;
use super::point::{Point, Vector, direction, fold_half_turn, normal};

/// Sizes that differ by less than this share are equal: rounding errors are smaller.
const SAME_SIZE_SHARE: f64 = 1e-9;

/// A rectangle of any orientation.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct OrientedBox {
    /// Centre, metres.
    pub center: Point,
    /// Half the side along `angle` and half the side across it, metres.
    pub half_extents: [f64; 2],
    /// Direction of the first side, radians.
    pub angle: f64,
}

impl OrientedBox {
    /// Smallest box of the given direction around the points; `None` without points.
    #[must_use]
    pub fn around(points: impl IntoIterator<Item = Point>, angle: f64) -> Option<Self> {
        let (along, across) = (direction(angle), normal(angle));
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for point in points {
            for (axis, unit) in [along, across].iter().enumerate() {
                let value = unit.dot(&point.coords);
                low[axis] = low[axis].min(value);
                high[axis] = high[axis].max(value);
            }
        }
        let half_extents = [(high[0] - low[0]) / 2.0, (high[1] - low[1]) / 2.0];
        let center = Point::from(along * (low[0] + high[0]) / 2.0 + across * (low[1] + high[1]) / 2.0);
        half_extents.iter().all(|extent| extent.is_finite()).then_some(Self { center, half_extents, angle })
    }

    /// The box of least area around points, its long side first, directed into `[-pi/2, pi/2)`.
    ///
    /// Of equals (a right triangle has two) the one of least girth, then the one whose direction is nearer to x. Fewer
    /// than 3 points have a box of size zero.
    ///
    /// Method: one side of the smallest box lies along a side of the convex hull (H. Freeman and R. Shapira 1975, doi
    /// 10.1145/360881.360919). Hulls of faces have few corners, so each side is tried with all corners:
    /// O(n log n + h^2) for n points, h of them on the hull.
    #[must_use]
    pub fn smallest_around(points: &[Point]) -> Self {
        let hull = convex_hull(points);
        let mut best: Option<Self> = None;
        for (start, end) in hull.iter().zip(hull.iter().cycle().skip(1)) {
            let Some(along) = (end - start).try_normalize(0.0) else { continue };
            let (mut first, mut last, mut depth) = (0.0_f64, 0.0_f64, 0.0_f64);
            for corner in &hull {
                let offset = corner - start;
                first = first.min(along.dot(&offset));
                last = last.max(along.dot(&offset));
                depth = depth.max(along.perp(&offset));
            }
            let center = start + along * f64::midpoint(first, last) + Vector::new(-along.y, along.x) * (depth / 2.0);
            let candidate = Self::with_sides(center, [last - first, depth], along.y.atan2(along.x));
            if best.is_none_or(|best| candidate.is_smaller_than(&best)) {
                best = Some(candidate);
            }
        }
        let center = points.first().copied().unwrap_or_else(Point::origin);
        best.unwrap_or(Self { center, half_extents: [0.0; 2], angle: 0.0 })
    }

    /// The box with sides along and across `angle`, long side first.
    fn with_sides(center: Point, [width, depth]: [f64; 2], angle: f64) -> Self {
        let (along, across) = (fold_half_turn(angle), fold_half_turn(angle + PI / 2.0));
        let is_along_long = if differ(width, depth) { width > depth } else { along.abs() <= across.abs() };
        let half_extents = [width.max(depth) / 2.0, width.min(depth) / 2.0];
        Self { center, half_extents, angle: if is_along_long { along } else { across } }
    }

    fn is_smaller_than(&self, other: &Self) -> bool {
        let area = |found: &Self| found.half_extents[0] * found.half_extents[1];
        let girth = |found: &Self| found.half_extents[0] + found.half_extents[1];
        if differ(area(self), area(other)) {
            area(self) < area(other)
        } else if differ(girth(self), girth(other)) {
            girth(self) < girth(other)
        } else {
            self.angle.abs() < other.angle.abs()
        }
    }

    /// Lengths of the sides along `angle` and across it, metres.
    #[must_use]
    pub fn sides(&self) -> [f64; 2] {
        self.half_extents.map(|half| 2.0 * half)
    }

    /// Square metres.
    #[must_use]
    pub fn area(&self) -> f64 {
        4.0 * self.half_extents[0] * self.half_extents[1]
    }

    /// First over second side; 1 where the second has no length.
    #[must_use]
    pub fn elongation(&self) -> f64 {
        let [long, short] = self.half_extents;
        if short > 0.0 { long / short } else { 1.0 }
    }

    /// Whether it holds a point; sides count.
    #[must_use]
    pub fn contains(&self, point: Point) -> bool {
        let offset = point - self.center;
        direction(self.angle).dot(&offset).abs() <= self.half_extents[0]
            && normal(self.angle).dot(&offset).abs() <= self.half_extents[1]
    }

    /// The four corners, counter-clockwise.
    #[must_use]
    pub fn corners(&self) -> [Point; 4] {
        let along = direction(self.angle) * self.half_extents[0];
        let across = normal(self.angle) * self.half_extents[1];
        [
            self.center - along - across,
            self.center + along - across,
            self.center + along + across,
            self.center - along + across,
        ]
    }
}

/// Whether two sizes differ by more than rounding.
fn differ(first: f64, second: f64) -> bool {
    (first - second).abs() > SAME_SIZE_SHARE * first.max(second)
}

#[cfg(test)]
mod tests {
    use super::super::point::line_angle_between;
    use super::*;

    fn rectangle(width: f64, depth: f64, angle: f64) -> Vec<Point> {
        let corner = |x: f64, y: f64| Point::new(7.0, -3.0) + direction(angle) * x + normal(angle) * y;
        vec![corner(0.0, 0.0), corner(width, 0.0), corner(width, depth), corner(width / 2.0, depth), corner(0.0, depth)]
    }

    #[test]
    fn a_turned_rectangle_is_its_own_smallest_box() {
        for angle in [-1.5, -0.4, 0.0, 0.3, 1.2] {
            for (width, depth) in [(6.0, 1.5), (1.5, 6.0)] {
                let corners = rectangle(width, depth, angle);
                let found = OrientedBox::smallest_around(&corners);
                let along = if width > depth { angle } else { angle + PI / 2.0 };
                let middle = nalgebra::center(&corners[0], &corners[2]);
                assert!((found.center - middle).norm() < 1e-9);
                assert!((found.sides()[0] - 6.0).abs() < 1e-9 && (found.sides()[1] - 1.5).abs() < 1e-9);
                assert!(line_angle_between(found.angle, along) < 1e-9);
                assert!((found.elongation() - 4.0).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn the_smallest_box_of_a_square_lies_along_x() {
        let found = OrientedBox::smallest_around(&rectangle(2.0, 2.0, PI / 2.0));
        assert!(found.angle.abs() < 1e-9 && (found.elongation() - 1.0).abs() < 1e-9);
    }

    #[test]
    fn no_shape_has_no_size() {
        for points in [vec![], vec![Point::origin()], vec![Point::new(1.0, 1.0), Point::new(2.0, 2.0)]] {
            let found = OrientedBox::smallest_around(&points);
            assert!(found.half_extents[1] == 0.0 && found.elongation() >= 1.0, "{points:?} has {found:?}");
        }
    }

    #[test]
    fn a_box_holds_its_corners_drawn_in_a_little() {
        let found = OrientedBox { center: Point::new(1.0, 2.0), half_extents: [3.0, 1.0], angle: 0.5 };
        for corner in found.corners() {
            let towards_center = (found.center - corner) * 1e-6;
            assert!(found.contains(corner + towards_center) && !found.contains(corner - towards_center));
        }
    }
}
