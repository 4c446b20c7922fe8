//! Segments, given by their two ends.

use super::point::{Point, Vector};

/// Square of the distance of a point from a segment; a segment of no length is a point.
#[must_use]
pub fn squared_distance(point: Point, segment: [Point; 2]) -> f64 {
    (nearest_point(point, segment) - point).norm_squared()
}

/// The point of a segment that is nearest to a point.
#[must_use]
pub fn nearest_point(point: Point, segment: [Point; 2]) -> Point {
    segment[0] + (segment[1] - segment[0]) * share_of_nearest(point, segment)
}

/// How far along a segment its nearest point to a point lies, 0 to 1; 0 on a segment of no length.
#[must_use]
pub fn share_of_nearest(point: Point, [start, end]: [Point; 2]) -> f64 {
    let along = end - start;
    let squared = along.norm_squared();
    if squared > 0.0 { ((point - start).dot(&along) / squared).clamp(0.0, 1.0) } else { 0.0 }
}

/// Distance of a point from a segment; a segment of no length is a point.
#[must_use]
pub fn distance(point: Point, segment: [Point; 2]) -> f64 {
    squared_distance(point, segment).sqrt()
}

/// Where a line meets the line through a segment: the multiple of `way` from `start`, and the share of the segment,
/// which is in `[0, 1]` when the line meets the segment itself. Parallel lines give infinite numbers or none (NaN).
#[must_use]
pub fn crossing(start: Point, way: Vector, [first, second]: [Point; 2]) -> [f64; 2] {
    let (along, offset) = (second - first, first - start);
    let turn = way.perp(&along);
    [offset.perp(&along) / turn, offset.perp(&way) / turn]
}

/// The x at which a segment crosses the level `y`; `None` unless its ends lie on different sides of it. An end on the
/// level counts as below, so that a polygon line crosses a level once where it passes through a corner.
#[must_use]
pub fn x_at_level([start, end]: [Point; 2], y: f64) -> Option<f64> {
    let crosses = (start.y > y) != (end.y > y);
    crosses.then(|| start.x + (y - start.y) / (end.y - start.y) * (end.x - start.x))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: f64, y: f64) -> Point {
        Point::new(x, y)
    }

    #[test]
    fn the_nearest_point_is_a_foot_or_an_end() {
        let segment = [at(0.0, 0.0), at(4.0, 0.0)];
        assert_eq!([at(1.0, 2.0), at(7.0, 4.0), at(-3.0, 0.0)].map(|point| distance(point, segment)), [2.0, 5.0, 3.0]);
        assert_eq!(distance(at(3.0, 4.0), [at(0.0, 0.0); 2]), 5.0);
    }

    #[test]
    fn a_line_meets_a_segment_within_its_share() {
        let wall = [at(2.0, -1.0), at(2.0, 3.0)];
        assert_eq!(crossing(at(0.0, 0.0), Vector::new(1.0, 0.0), wall), [2.0, 0.25]);
        assert!(!crossing(at(0.0, 0.0), Vector::new(0.0, 1.0), wall)[1].is_finite());
    }

    #[test]
    fn a_corner_on_the_level_is_crossed_once() {
        let (low, corner, high) = (at(0.0, 0.0), at(1.0, 1.0), at(0.0, 2.0));
        assert_eq!([[low, corner], [corner, high]].map(|side| x_at_level(side, 1.0)), [None, Some(1.0)]);
    }
}
