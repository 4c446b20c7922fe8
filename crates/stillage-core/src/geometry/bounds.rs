//! Boxes along the axes.

use super::point::{Point, Vector};

/// An axis-parallel box; empty when `low` exceeds `high`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Least coordinates.
    pub low: Point,
    /// Greatest coordinates.
    pub high: Point,
}

impl Bounds {
    /// The box that holds nothing.
    pub const EMPTY: Self =
        Self { low: Point::new(f64::INFINITY, f64::INFINITY), high: Point::new(f64::NEG_INFINITY, f64::NEG_INFINITY) };

    /// The smallest box around points; [`Bounds::EMPTY`] without any.
    pub fn around<'a>(points: impl IntoIterator<Item = &'a Point>) -> Self {
        points
            .into_iter()
            .fold(Self::EMPTY, |Self { low, high }, point| Self { low: low.inf(point), high: high.sup(point) })
    }

    /// Whether it holds no point.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.low.x > self.high.x || self.low.y > self.high.y
    }

    /// The box with all sides moved outwards.
    #[must_use]
    pub fn grown(self, by: f64) -> Self {
        let by = Vector::new(by, by);
        Self { low: self.low - by, high: self.high + by }
    }

    /// Whether it holds a point; sides count.
    #[must_use]
    pub fn contains(&self, point: Point) -> bool {
        (self.low.x..=self.high.x).contains(&point.x) && (self.low.y..=self.high.y).contains(&point.y)
    }

    /// Whether two boxes have a point in common; sides count.
    #[must_use]
    pub fn meets(&self, other: &Self) -> bool {
        self.low.x <= other.high.x
            && other.low.x <= self.high.x
            && self.low.y <= other.high.y
            && other.low.y <= self.high.y
    }

    /// Whether it has a point in common with a segment; sides count. What is left of the segment between the four sides
    /// is cut off side by side (Y.-D. Liang and B. A. Barsky 1984, doi 10.1145/357332.357333).
    #[must_use]
    pub fn meets_segment(&self, [start, end]: [Point; 2]) -> bool {
        let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
        for axis in 0..2 {
            let (from, step) = (start[axis], end[axis] - start[axis]);
            if step == 0.0 {
                if !(self.low[axis]..=self.high[axis]).contains(&from) {
                    return false;
                }
                continue;
            }
            let (first, second) = ((self.low[axis] - from) / step, (self.high[axis] - from) / step);
            enters = enters.max(first.min(second));
            leaves = leaves.min(first.max(second));
        }
        enters <= leaves
    }

    /// The four corners, counter-clockwise from the lowest.
    #[must_use]
    pub fn corners(&self) -> [Point; 4] {
        let Self { low, high } = self;
        [*low, Point::new(high.x, low.y), *high, Point::new(low.x, high.y)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: f64, y: f64) -> Point {
        Point::new(x, y)
    }

    #[test]
    fn a_segment_may_pass_a_corner_or_end_inside() {
        let bounds = Bounds { low: at(0.0, 0.0), high: at(2.0, 1.0) };
        let meets = |ends: [(f64, f64); 2]| bounds.meets_segment(ends.map(|(x, y)| at(x, y)));
        assert!(
            meets([(-1.0, 0.5), (3.0, 0.5)]) && meets([(1.0, 0.5), (9.0, 9.0)]) && meets([(-1.0, 1.0), (1.0, -1.0)])
        );
        assert!(!meets([(-1.0, 0.5), (0.5, -1.0)]) && !meets([(3.0, 0.0), (3.0, 1.0)]));
    }

    #[test]
    fn no_points_have_an_empty_box() {
        let nothing = Bounds::around([]);
        assert!(nothing.is_empty() && !nothing.meets(&nothing));
        let something = Bounds::around(&[at(1.0, 5.0), at(3.0, 2.0)]);
        assert_eq!(something.corners(), [at(1.0, 2.0), at(3.0, 2.0), at(3.0, 5.0), at(1.0, 5.0)]);
        assert!(something.contains(at(3.0, 3.0)) && !something.contains(at(0.9, 3.0)));
    }
}
