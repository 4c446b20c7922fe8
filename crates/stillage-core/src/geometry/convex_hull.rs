//! Convex hulls.

use super::point::Point;

/// Corners of the convex hull of points, counter-clockwise (A. M. Andrew's monotone chain, 1979). O(n log n).
pub(crate) fn convex_hull(points: &[Point]) -> Vec<Point> {
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
