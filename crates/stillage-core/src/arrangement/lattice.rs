//! The integer lattice of the arrangement, and its exact predicates.
//!
//! Coordinates are rounded to the lattice once; from then on every decision (on which side a point lies, whether two
//! segments cross, whether a segment meets a pixel) is integer arithmetic without rounding. Method: J. D. Hobby,
//! *Practical segment intersection with finite precision output* (1999, doi 10.1016/S0925-7721(99)00021-8), whose
//! half-open pixels are used here.
//!
//! Limits: coordinates stay within 2^28 steps, so that a doubled cross product fits an `i64`.

use crate::geometry::Point;

/// Finest step: 61 micrometres, far below a cell and far above the rounding errors of lines that should coincide.
const FINEST_STEP: f64 = 1.0 / 16_384.0;
/// Largest coordinate in steps. Differences fit 2^29, cross products 2^59.
const REACH: f64 = (1_u64 << 28) as f64;

/// The step for coordinates up to `largest` metres: a power of two, so that lattice points are exact in `f64`.
pub(super) fn step_for(largest: f64) -> f64 {
    let mut step = FINEST_STEP;
    while largest / step >= REACH {
        step *= 2.0;
    }
    step
}

/// A point of the lattice. Ordered by (y, x).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct LatticePoint {
    pub y: i64,
    pub x: i64,
}

impl LatticePoint {
    /// The lattice point nearest to a point.
    pub fn nearest(point: Point, step: f64) -> Self {
        Self { x: (point.x / step).round() as i64, y: (point.y / step).round() as i64 }
    }

    /// Its position, metres.
    pub fn position(self, step: f64) -> Point {
        Point::new(self.x as f64 * step, self.y as f64 * step)
    }

    /// The displacement to another point, (x, y).
    pub fn to(self, other: Self) -> (i64, i64) {
        (other.x - self.x, other.y - self.y)
    }
}

/// Cross product of two displacements: positive when the second points to the left of the first.
pub(super) fn cross(first: (i64, i64), second: (i64, i64)) -> i64 {
    first.0 * second.1 - first.1 * second.0
}

/// An undirected segment of the lattice: `low < high` in the order of (y, x).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct LatticeSegment {
    pub low: LatticePoint,
    pub high: LatticePoint,
}

impl LatticeSegment {
    /// The segment between two points; `None` when they coincide.
    pub fn between(first: LatticePoint, second: LatticePoint) -> Option<Self> {
        (first != second).then(|| Self { low: first.min(second), high: first.max(second) })
    }

    /// From the low to the high end.
    pub fn direction(self) -> (i64, i64) {
        self.low.to(self.high)
    }

    /// Positive when the point lies to the left, looking from low to high; 0 on the line.
    pub fn side(self, point: LatticePoint) -> i64 {
        cross(self.direction(), self.low.to(point))
    }

    /// Least and greatest x.
    pub fn x_range(self) -> (i64, i64) {
        (self.low.x.min(self.high.x), self.low.x.max(self.high.x))
    }

    /// The crossing of two segments that are not parallel, rounded to the lattice; `None` when they do not meet.
    pub fn crossing(self, other: Self) -> Option<LatticePoint> {
        let (along, across) = (self.direction(), other.direction());
        let offset = self.low.to(other.low);
        let (mut denominator, mut numerator, mut other_numerator) =
            (cross(along, across), cross(offset, across), cross(offset, along));
        if denominator == 0 {
            return None;
        }
        if denominator < 0 {
            (denominator, numerator, other_numerator) = (-denominator, -numerator, -other_numerator);
        }
        let inside = 0..=denominator;
        if !inside.contains(&numerator) || !inside.contains(&other_numerator) {
            return None;
        }
        // low + along * numerator / denominator, rounded half up as the half-open pixels demand.
        let round = |component: i64| {
            let doubled = 2 * i128::from(denominator);
            let scaled = 2 * i128::from(numerator) * i128::from(component) + i128::from(denominator);
            scaled.div_euclid(doubled) as i64
        };
        Some(LatticePoint { x: self.low.x + round(along.0), y: self.low.y + round(along.1) })
    }

    /// Whether the segment meets the pixel `[x - 1/2, x + 1/2) x [y - 1/2, y + 1/2)` around a lattice point.
    ///
    /// Within the box of the segment only its line counts. The line meets the open pixel when the pixel's corners lie
    /// on both sides; of the closed pixel's border only the lower left corner can matter beside that.
    pub fn meets_pixel(self, pixel: LatticePoint) -> bool {
        let (left, right) = self.x_range();
        if pixel.x < left || pixel.x > right || pixel.y < self.low.y || pixel.y > self.high.y {
            return false;
        }
        let (dx, dy) = self.direction();
        let doubled_side = 2 * self.side(pixel);
        doubled_side.abs() < dx.abs() + dy.abs() || doubled_side == dx - dy
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: i64, y: i64) -> LatticePoint {
        LatticePoint { y, x }
    }

    fn segment(start: (i64, i64), end: (i64, i64)) -> LatticeSegment {
        LatticeSegment::between(at(start.0, start.1), at(end.0, end.1)).expect("the ends differ")
    }

    #[test]
    fn crossings_are_rounded_half_up() {
        assert_eq!(segment((0, 0), (10, 10)).crossing(segment((0, 10), (10, 0))), Some(at(5, 5)));
        assert_eq!(segment((0, 0), (5, 5)).crossing(segment((0, 5), (5, 0))), Some(at(3, 3)));
        assert_eq!(segment((0, 0), (-5, 5)).crossing(segment((0, 5), (-5, 0))), Some(at(-2, 3)));
    }

    #[test]
    fn segments_that_only_touch_do_cross_and_parallels_do_not() {
        assert_eq!(segment((0, 0), (10, 0)).crossing(segment((4, 0), (4, 9))), Some(at(4, 0)));
        assert_eq!(segment((0, 0), (10, 0)).crossing(segment((4, 1), (4, 9))), None);
        assert_eq!(segment((0, 0), (10, 0)).crossing(segment((5, 0), (15, 0))), None);
    }

    /// Every point of the plane lies in exactly one pixel, so a segment through a shared corner hits one owner.
    #[test]
    fn a_corner_belongs_to_the_pixel_on_its_upper_right() {
        // Descends through (1/2, 1/2), the corner of (0, 0), (1, 0), (0, 1) and (1, 1).
        let descending = segment((0, 1), (1, 0));
        assert_eq!(
            [at(0, 0), at(1, 0), at(0, 1), at(1, 1)].map(|pixel| descending.meets_pixel(pixel)),
            [false, true, true, true]
        );
        let ascending = segment((0, 0), (1, 1));
        assert_eq!(
            [at(0, 0), at(1, 0), at(0, 1), at(1, 1)].map(|pixel| ascending.meets_pixel(pixel)),
            [true, false, false, true]
        );
    }

    #[test]
    fn pixels_beyond_the_ends_are_not_met() {
        let flat = segment((0, 0), (10, 1));
        assert!(!flat.meets_pixel(at(-1, 0)) && !flat.meets_pixel(at(11, 1)));
        assert!(flat.meets_pixel(at(5, 0)) != flat.meets_pixel(at(4, 1)));
    }

    #[test]
    fn the_step_grows_with_the_map() {
        assert!((step_for(200.0) - FINEST_STEP).abs() < f64::EPSILON);
        assert!(1e9 / step_for(1e9) < REACH && step_for(f64::MAX).is_finite());
    }
}
