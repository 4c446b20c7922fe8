//! Which faces and edges of a subdivision are those of another one.
//!
//! Edges are the same when their ends are, faces when all their edges are. Both subdivisions list their edges in one
//! order, so they are walked side by side. Cost: O(edges).

use std::cmp::Ordering;

use super::ids::{EdgeId, FaceId};
use super::subdivision::Subdivision;

/// The parts of a new subdivision that an old one had, under the ids that they had there.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct KeptParts {
    /// By face of the new one; the unbounded face is kept always.
    pub faces: Vec<Option<FaceId>>,
    /// By edge of the new one.
    pub edges: Vec<Option<EdgeId>>,
}

impl KeptParts {
    /// Compares two subdivisions.
    pub fn between(old: &Subdivision, new: &Subdivision) -> Self {
        let edges = kept_edges(old, new);
        let boundary = |subdivision: &Subdivision| {
            let mut counts = vec![0_u32; subdivision.face_count()];
            for edge in subdivision.edges() {
                subdivision.sides(edge).iter().for_each(|side| counts[side.index()] += 1);
            }
            counts
        };
        let (old_counts, mut missing) = (boundary(old), boundary(new));
        let mut faces: Vec<Option<FaceId>> = vec![None; new.face_count()];
        for edge in new.edges() {
            let Some(before) = edges[edge.index()] else { continue };
            for (side, was) in new.sides(edge).into_iter().zip(old.sides(before)) {
                let face = &mut faces[side.index()];
                if missing[side.index()] == old_counts[was.index()] && face.is_none() {
                    *face = Some(was);
                }
            }
        }
        // A face is kept when each of its edges has the same face behind it that the first one had.
        for edge in new.edges() {
            let before = edges[edge.index()].map(|edge| old.sides(edge));
            for (number, side) in new.sides(edge).into_iter().enumerate() {
                if before.is_some_and(|sides| Some(sides[number]) == faces[side.index()]) {
                    missing[side.index()] -= 1;
                }
            }
        }
        for (face, missing) in faces.iter_mut().zip(missing) {
            *face = face.filter(|_| missing == 0);
        }
        if let Some(outer) = faces.first_mut() {
            *outer = Some(FaceId::OUTER);
        }
        Self { faces, edges }
    }

    /// The faces that are new.
    pub fn changed_faces(&self) -> impl Iterator<Item = FaceId> + '_ {
        (0..).zip(&self.faces).filter(|(_, was)| was.is_none()).map(|(face, _)| FaceId(face))
    }
}

fn kept_edges(old: &Subdivision, new: &Subdivision) -> Vec<Option<EdgeId>> {
    let key = |subdivision: &Subdivision, edge| subdivision.segment(edge).map(|end| [end.y, end.x]);
    let order = |one: [[f64; 2]; 2], other: [[f64; 2]; 2]| {
        let coordinates = one.as_flattened().iter().zip(other.as_flattened());
        coordinates.map(|(one, other)| one.total_cmp(other)).find(|order| order.is_ne()).unwrap_or(Ordering::Equal)
    };
    let mut candidates = old.edges().peekable();
    let find = |edge| {
        let sought = key(new, edge);
        while candidates.next_if(|&candidate| order(key(old, candidate), sought).is_lt()).is_some() {}
        candidates.next_if(|&candidate| order(key(old, candidate), sought).is_eq())
    };
    new.edges().map(find).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_maps::segments::boxed;

    #[test]
    fn a_face_is_kept_while_its_border_is_and_no_face_lies_in_it() {
        let halves = [4.0, 0.0, 4.0, 8.0];
        let old = boxed([0.0, 0.0, 8.0, 8.0], &[halves]);
        let hole = [[1.0, 1.0, 2.0, 1.0], [2.0, 1.0, 2.0, 2.0], [2.0, 2.0, 1.0, 1.0]];
        let new = boxed([0.0, 0.0, 8.0, 8.0], &[&[halves], hole.as_slice()].concat());
        let kept = KeptParts::between(&old, &new);
        let left = new.face_at(crate::Point::new(0.5, 4.0));
        let right = new.face_at(crate::Point::new(6.0, 4.0));
        assert_eq!((kept.faces[left.index()], kept.faces[right.index()]), (None, Some(FaceId(2))));
        assert_eq!((kept.changed_faces().count(), kept.edges.iter().flatten().count()), (2, old.edge_count()));
        assert_eq!(KeptParts::between(&old, &old).changed_faces().count(), 0);
    }
}
