//! The face at a point, without the cells.
//!
//! Method: the first edge to the left of the point has its face on the right. Cost: O(edges).

use super::ids::FaceId;
use super::subdivision::Subdivision;
use crate::geometry::{Point, segment};

impl Subdivision {
    /// The face that holds a point. A point on an edge lies in the face on its right, one on a level edge in the face
    /// above, like the centres of cells.
    #[must_use]
    pub fn face_at(&self, point: Point) -> FaceId {
        let mut nearest = (f64::NEG_INFINITY, FaceId::OUTER);
        for edge in self.edges() {
            let ends = self.segment(edge);
            // The lower end comes first: most edges are passed by without their sides being looked up.
            if ends[0].y <= point.y
                && ends[1].y > point.y
                && let Some(x) = segment::x_at_level(ends, point.y)
                && x <= point.x
                && x >= nearest.0
            {
                nearest = (x, self.sides(edge)[1]);
            }
        }
        nearest.1
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::arrangement::CellFaces;
    use crate::test_maps::segments::boxed;

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
