//! The area that another one covers best.

use crate::geometry::common_area::common_area;
use crate::geometry::{Bounds, Point, polygon};

/// Of some areas the one that has most ground in common with `rings`: its index, and the ground in common as a share of the
/// smaller of the two. `None` where none has any. Areas are outlines (counter-clockwise) and holes (clockwise). O(areas),
/// and O(corners²) for those whose boxes meet.
#[must_use]
pub fn greatest_overlap(rings: &[Vec<Point>], among: &[Vec<Vec<Point>>]) -> Option<(usize, f64)> {
    let (bounds, area) = (Bounds::around(rings.iter().flatten()), polygon::area(rings));
    let near = among.iter().enumerate().filter(|(_, other)| bounds.meets(&Bounds::around(other.iter().flatten())));
    let common = near.map(|(index, other)| (index, common_area(rings, other))).filter(|(_, common)| *common > 0.0);
    let (index, common) = common.max_by(|one, other| one.1.total_cmp(&other.1).then(other.0.cmp(&one.0)))?;
    Some((index, (common / area.min(polygon::area(&among[index]))).min(1.0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_area_with_most_in_common_is_found() {
        let square = |x: f64, side: f64| {
            vec![[(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)].map(|(dx, dy)| Point::new(x + dx, dy)).to_vec()]
        };
        let among = [square(0.0, 1.0), square(1.0, 1.0), square(5.0, 1.0)];
        assert_eq!(greatest_overlap(&square(0.75, 1.0), &among), Some((1, 0.75)));
        assert_eq!(greatest_overlap(&square(4.0, 9.0), &among), Some((2, 1.0)), "a small one inside a large one");
        assert_eq!(greatest_overlap(&square(7.0, 1.0), &among), None);
    }
}
