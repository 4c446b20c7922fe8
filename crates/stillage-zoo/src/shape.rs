//! Convex polygons: everything in a generated hall is made of them.
//!
//! Cutting a convex polygon by half-planes leaves convex polygons (I. Sutherland and G. Hodgman, *Reentrant polygon
//! clipping*, 1974, doi 10.1145/360767.360802), so intersection and difference need nothing else.

use std::ops::Range;

use stillage_core::geometry::{Point, Vector, direction, normal, ring_area};

/// Pieces below this area (square metres) are rounding.
const NO_AREA: f64 = 1e-9;

/// A rigid motion: first turned about the origin, then moved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pose {
    /// Counter-clockwise turn, radians.
    pub(crate) angle: f64,
    /// Where the origin goes, metres.
    pub(crate) offset: Vector,
}

impl Pose {
    pub(crate) fn new(angle: f64, x: f64, y: f64) -> Self {
        Self { angle, offset: Vector::new(x, y) }
    }

    /// Turns about the origin so that one point goes to another.
    pub(crate) fn carrying(angle: f64, from: Point, to: Point) -> Self {
        let turned = Self::new(angle, 0.0, 0.0).apply(from);
        Self { angle, offset: to - turned }
    }

    pub(crate) fn apply(&self, point: Point) -> Point {
        Point::from(direction(self.angle) * point.x + normal(self.angle) * point.y + self.offset)
    }

    pub(crate) fn undo(&self, point: Point) -> Point {
        let moved = point.coords - self.offset;
        Point::new(direction(self.angle).dot(&moved), normal(self.angle).dot(&moved))
    }
}

/// A convex polygon, counter-clockwise, first point not repeated.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Convex(Vec<Point>);

impl Convex {
    /// A rectangle along the axes.
    pub(crate) fn rectangle(x: Range<f64>, y: Range<f64>) -> Self {
        let corners = [(x.start, y.start), (x.end, y.start), (x.end, y.end), (x.start, y.end)];
        Self(corners.map(|(x, y)| Point::new(x, y)).to_vec())
    }

    /// A rectangle of a size about a centre, turned.
    pub(crate) fn turned_box(center: Point, [width, height]: [f64; 2], angle: f64) -> Self {
        let upright = Self::rectangle(-width / 2.0..width / 2.0, -height / 2.0..height / 2.0);
        upright.placed(&Pose { angle, offset: center.coords })
    }

    pub(crate) fn points(&self) -> &[Point] {
        &self.0
    }

    /// Its sides, in order.
    fn sides(&self) -> impl Iterator<Item = (Point, Point)> {
        self.0.iter().copied().zip(self.0.iter().copied().cycle().skip(1))
    }

    pub(crate) fn placed(&self, pose: &Pose) -> Self {
        Self(self.0.iter().map(|&point| pose.apply(point)).collect())
    }

    /// The polygon in the frame that the pose comes from.
    pub(crate) fn seen_from(&self, pose: &Pose) -> Self {
        Self(self.0.iter().map(|&point| pose.undo(point)).collect())
    }

    pub(crate) fn area(&self) -> f64 {
        ring_area(&self.0)
    }

    /// Mean of the corners.
    pub(crate) fn middle(&self) -> Point {
        let sum: Vector = self.0.iter().map(|point| point.coords).sum();
        Point::from(sum / self.0.len().max(1) as f64)
    }

    /// Lowest and highest coordinates.
    pub(crate) fn bounds(&self) -> (Point, Point) {
        let start = (Point::new(f64::INFINITY, f64::INFINITY), Point::new(f64::NEG_INFINITY, f64::NEG_INFINITY));
        self.0.iter().fold(start, |(low, high), point| (low.inf(point), high.sup(point)))
    }

    /// From where to where it reaches along x at a height; at the nearest one that it has.
    pub(crate) fn span(&self, y: f64) -> (f64, f64) {
        let (low, high) = self.bounds();
        let y = y.clamp(low.y, high.y);
        let crossing = |(from, to): (Point, Point)| {
            let meets = (from.y - y) * (to.y - y) <= 0.0;
            let at = if from.y == to.y {
                [from.x, to.x]
            } else {
                [from.x + (to.x - from.x) * (y - from.y) / (to.y - from.y); 2]
            };
            meets.then_some(at)
        };
        let crossings = self.sides().filter_map(crossing).flatten();
        crossings.fold((f64::INFINITY, f64::NEG_INFINITY), |(left, right), x| (left.min(x), right.max(x)))
    }

    /// Whether it holds a point, its border included.
    pub(crate) fn contains(&self, point: Point) -> bool {
        self.sides().all(|(from, to)| (to - from).perp(&(point - from)) >= -NO_AREA)
    }

    /// Whether it holds all of another.
    pub(crate) fn covers(&self, other: &Self) -> bool {
        other.0.iter().all(|&point| self.contains(point))
    }

    /// The smallest distance between two parallels that it lies between.
    pub(crate) fn narrowest(&self) -> f64 {
        let width = |(from, to): (Point, Point)| {
            let along = (to - from).normalize();
            self.0.iter().map(|point| along.perp(&(point - from))).fold(0.0, f64::max)
        };
        self.sides().filter(|(from, to)| from != to).map(width).fold(f64::INFINITY, f64::min)
    }

    /// All sides moved outwards (inwards where negative), metres.
    pub(crate) fn grown(&self, by: f64) -> Self {
        let count = self.0.len();
        let corner = |index: usize| {
            let here = self.0[index];
            let before = (here - self.0[(index + count - 1) % count]).normalize();
            let after = (self.0[(index + 1) % count] - here).normalize();
            // Where the two moved sides meet: `by` outwards of both.
            let outward = Vector::new(before.y, -before.x) + Vector::new(after.y, -after.x);
            here + outward * (by / (1.0 + before.dot(&after)))
        };
        Self((0..count).map(corner).collect())
    }

    /// What lies left of the line from one point to another; `None` where that has no area.
    fn left_of(&self, from: Point, to: Point) -> Option<Self> {
        let side = |point: Point| (to - from).perp(&(point - from));
        let mut kept = Vec::with_capacity(self.0.len() + 1);
        for (here, next) in self.sides() {
            let (at_here, at_next) = (side(here), side(next));
            if at_here >= 0.0 {
                kept.push(here);
            }
            if (at_here > 0.0 && at_next < 0.0) || (at_here < 0.0 && at_next > 0.0) {
                kept.push(here + (next - here) * (at_here / (at_here - at_next)));
            }
        }
        let kept = Self(kept);
        (kept.0.len() > 2 && kept.area() > NO_AREA).then_some(kept)
    }

    /// What it has in common with another.
    pub(crate) fn intersection(&self, other: &Self) -> Option<Self> {
        other.sides().try_fold(self.clone(), |rest, (from, to)| rest.left_of(from, to))
    }

    /// Area that it has in common with another.
    pub(crate) fn overlap(&self, other: &Self) -> f64 {
        let ((low, high), (other_low, other_high)) = (self.bounds(), other.bounds());
        let apart = low.x > other_high.x || other_low.x > high.x || low.y > other_high.y || other_low.y > high.y;
        if apart { 0.0 } else { self.intersection(other).map_or(0.0, |common| common.area()) }
    }

    /// What is left of it without another, in convex pieces that do not overlap.
    fn minus(&self, other: &Self) -> Vec<Self> {
        if self.overlap(other) <= NO_AREA {
            return vec![self.clone()];
        }
        let mut pieces = Vec::new();
        let mut rest = self.clone();
        for (from, to) in other.sides() {
            pieces.extend(rest.left_of(to, from));
            let Some(inside) = rest.left_of(from, to) else { break };
            rest = inside;
        }
        pieces
    }

    /// What is left of it without several others.
    pub(crate) fn minus_all<'a>(&self, others: impl IntoIterator<Item = &'a Self>) -> Vec<Self> {
        let start = vec![self.clone()];
        others.into_iter().fold(start, |pieces, other| pieces.iter().flat_map(|piece| piece.minus(other)).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn any_box() -> impl Strategy<Value = Convex> {
        (-5.0..5.0, -5.0..5.0, 0.1..6.0, 0.1..6.0, -3.2..3.2)
            .prop_map(|(x, y, width, height, angle)| Convex::turned_box(Point::new(x, y), [width, height], angle))
    }

    proptest! {
        #[test]
        fn difference_and_intersection_share_the_area(first in any_box(), second in any_box()) {
            let left: f64 = first.minus(&second).iter().map(Convex::area).sum();
            let common = first.intersection(&second).map_or(0.0, |common| common.area());
            prop_assert!((left + common - first.area()).abs() < 1e-6, "{left} + {common} of {}", first.area());
        }

        #[test]
        fn a_grown_box_has_longer_sides(shape in any_box(), by in 0.0..2.0) {
            let grown = shape.grown(by);
            prop_assert!((grown.narrowest() - shape.narrowest() - 2.0 * by).abs() < 1e-9);
            prop_assert!(grown.covers(&shape));
        }

        #[test]
        fn a_pose_can_be_undone(shape in any_box(), angle in -3.2..3.2, x in -9.0..9.0) {
            let pose = Pose::new(angle, x, 1.0);
            let back = shape.placed(&pose).seen_from(&pose);
            prop_assert!(back.points().iter().zip(shape.points()).all(|(a, b)| (a - b).norm() < 1e-9));
        }
    }

    #[test]
    fn a_hole_leaves_four_pieces() {
        let pieces = Convex::rectangle(0.0..4.0, 0.0..4.0).minus(&Convex::rectangle(1.0..2.0, 1.0..2.0));
        assert_eq!(pieces.len(), 4);
        assert_eq!(pieces.iter().map(Convex::area).sum::<f64>(), 15.0);
    }
}
