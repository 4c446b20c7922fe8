//! The face at a point, without the cells.
//!
//! Method: the first edge to the left of the point has its face on the right. Cost: O(edges).

use super::ids::FaceId;
use super::subdivision::Subdivision;
use crate::geometry::Point;

impl Subdivision {
    /// The face that holds a point. A point on an edge lies in the face on its right, one on a level edge in the face
    /// above, like the centres of cells.
    #[must_use]
    pub fn face_at(&self, point: Point) -> FaceId {
        let mut nearest = ([f64::NEG_INFINITY; 2], FaceId::OUTER);
        for edge in self.edges() {
            let ends = self.segment(edge);
            // The lower end comes first: most edges are passed by without their sides being looked up.
            if ends[0].y <= point.y && ends[1].y > point.y {
                let crossing = crossing(ends, point.y);
                if crossing[0] <= point.x && crossing >= nearest.0 {
                    nearest = (crossing, self.sides(edge)[1]);
                }
            }
        }
        nearest.1
    }
}

/// The x at which an edge crosses a level, computed from the nearer end, so that rounding never swaps two edges that meet there;
/// and for edges that cross at the same x, in or right beside the end that they share, a number that grows to the right.
fn crossing([low, high]: [Point; 2], y: f64) -> [f64; 2] {
    let slope = (high.x - low.x) / (high.y - low.y);
    let (rise, fall) = (y - low.y, high.y - y);
    if rise <= fall { [low.x + rise * slope, slope] } else { [high.x - fall * slope, -slope] }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::arrangement::CellFaces;
    use crate::test_maps::segments::boxed;

    #[test]
    fn edges_that_rise_from_one_vertex_are_in_the_order_in_which_they_rise() {
        let [left, right] = [[4.0, 2.0, 2.0, 6.0], [4.0, 2.0, 6.0, 6.0]];
        for lines in [[left, right], [right, left]] {
            let subdivision = boxed([0.0, 0.0, 8.0, 8.0], &[&lines[..], &[[2.0, 6.0, 6.0, 6.0]]].concat());
            let face = |x, y| subdivision.face_at(Point::new(x, y));
            assert_eq!([face(7.0, 2.0), face(7.0, 3.0), face(1.0, 2.0)], [face(7.0, 1.0); 3]);
            assert_ne!(face(4.0, 3.0), face(7.0, 3.0));
        }
    }

    proptest! {
        #[test]
        fn it_is_the_face_of_the_cell_with_its_centre_there(lines in prop::collection::vec([0.0..8.0, 0.0..8.0, 0.0..8.0, 0.0..8.0], 0..12)) {
            let subdivision = boxed([0.0, 0.0, 8.0, 8.0], &lines);
            let cells = CellFaces::rasterize(&subdivision, 16, 16, 0.5);
            for (index, face) in cells.iter().enumerate() {
                let center = Point::new((index % 16) as f64 + 0.5, (index / 16) as f64 + 0.5) * 0.5;
                prop_assert_eq!(subdivision.face_at(center), face);
            }
            prop_assert_eq!(subdivision.face_at(Point::new(9.0, 4.0)), FaceId::OUTER);
        }
    }
}
