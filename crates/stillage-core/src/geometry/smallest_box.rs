//! The smallest box around points.
//!
//! One side of the smallest box lies along a side of the convex hull (H. Freeman and R. Shapira 1975, doi
//! 10.1145/360881.360919). Hulls of faces have a handful of corners, so each of their sides is tried with all corners:
//! O(n log n + h^2) for n corners, h of them on the hull.

use std::f64::consts::PI;

use crate::geometry::{Point, Vector, fold_half_turn};

/// Sizes closer than this share are equal: what is left after rounding.
const SAME: f64 = 1e-9;

/// Place, size and direction of the smallest box around points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SmallestBox {
    /// Its middle, metres.
    pub center: Point,
    /// Long and short side, metres.
    pub extent: [f64; 2],
    /// Direction of the long side, radians in `[-pi/2, pi/2)`.
    pub heading: f64,
}

impl SmallestBox {
    /// The box of least area around points. Of equals (a right triangle has two) the one of least girth, then the one
    /// that heads nearer to x. Zero for fewer than 3 points.
    pub fn around(points: &[Point]) -> Self {
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
            let candidate = Self::with_sides(center, last - first, depth, along.y.atan2(along.x));
            if best.is_none_or(|best| candidate.is_better_than(&best)) {
                best = Some(candidate);
            }
        }
        let center = points.first().copied().unwrap_or_else(Point::origin);
        best.unwrap_or(Self { center, extent: [0.0; 2], heading: 0.0 })
    }

    fn with_sides(center: Point, width: f64, depth: f64, angle: f64) -> Self {
        let (along, across) = (fold_half_turn(angle), fold_half_turn(angle + PI / 2.0));
        let along_is_long = if differ(width, depth) { width > depth } else { along.abs() <= across.abs() };
        let heading = if along_is_long { along } else { across };
        Self { center, extent: [width.max(depth), width.min(depth)], heading }
    }

    fn is_better_than(&self, other: &Self) -> bool {
        let area = |found: &Self| found.extent[0] * found.extent[1];
        let girth = |found: &Self| found.extent[0] + found.extent[1];
        if differ(area(self), area(other)) {
            area(self) < area(other)
        } else if differ(girth(self), girth(other)) {
            girth(self) < girth(other)
        } else {
            self.heading.abs() < other.heading.abs()
        }
    }

    /// Long over short side, at least 1.
    pub fn elongation(&self) -> f64 {
        let [long, short] = self.extent;
        if short > 0.0 { long / short } else { 1.0 }
    }
}

/// Whether two sizes differ by more than rounding.
fn differ(first: f64, second: f64) -> bool {
    (first - second).abs() > SAME * first.max(second)
}

/// Corners of the convex hull, counter-clockwise (A. M. Andrew's monotone chain, 1979).
fn convex_hull(points: &[Point]) -> Vec<Point> {
    let mut sorted = points.to_vec();
    sorted.sort_unstable_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let mut hull = Vec::new();
    extend_chain(&mut hull, sorted.iter().copied());
    extend_chain(&mut hull, sorted.into_iter().rev());
    hull
}

/// Appends a chain that only turns left; its last point is left out, since the next chain begins there.
fn extend_chain(hull: &mut Vec<Point>, points: impl Iterator<Item = Point>) {
    let begin = hull.len();
    for point in points {
        while let [.., first, second] = hull[begin..]
            && (second - first).perp(&(point - second)) <= 0.0
        {
            hull.pop();
        }
        hull.push(point);
    }
    hull.pop();
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{direction, normal};

    fn rectangle(width: f64, depth: f64, angle: f64) -> Vec<Point> {
        let corner = |x: f64, y: f64| Point::new(7.0, -3.0) + direction(angle) * x + normal(angle) * y;
        vec![corner(0.0, 0.0), corner(width, 0.0), corner(width, depth), corner(width / 2.0, depth), corner(0.0, depth)]
    }

    #[test]
    fn a_turned_rectangle_is_its_own_box() {
        for angle in [-1.5, -0.4, 0.0, 0.3, 1.2] {
            for (width, depth) in [(6.0, 1.5), (1.5, 6.0)] {
                let corners = rectangle(width, depth, angle);
                let found = SmallestBox::around(&corners);
                let along = if width > depth { angle } else { angle + PI / 2.0 };
                let middle = nalgebra::center(&corners[0], &corners[2]);
                assert!((found.center - middle).norm() < 1e-9);
                assert!((found.extent[0] - 6.0).abs() < 1e-9 && (found.extent[1] - 1.5).abs() < 1e-9);
                assert!(crate::geometry::line_angle_between(found.heading, along) < 1e-9);
                assert!((found.elongation() - 4.0).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn a_square_heads_along_x() {
        let found = SmallestBox::around(&rectangle(2.0, 2.0, PI / 2.0));
        assert!(found.heading.abs() < 1e-9 && (found.elongation() - 1.0).abs() < 1e-9);
    }

    #[test]
    fn no_shape_has_no_size() {
        for points in [vec![], vec![Point::origin()], vec![Point::new(1.0, 1.0), Point::new(2.0, 2.0)]] {
            let found = SmallestBox::around(&points);
            assert!(found.extent[1] == 0.0 && found.elongation() >= 1.0, "{points:?} has {found:?}");
        }
    }
}
