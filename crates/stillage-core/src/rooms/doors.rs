//! Doors: the edges of the subdivision that run through the passages between rooms.
//!
//! Cost: O(passages x edges of rooms). Limits: a passage that no edge runs through, since both its sides are one face,
//! is no door.

use super::Door;
use crate::arrangement::{EdgeId, Subdivision};
use crate::geometry::{Point, segment};

/// An edge runs through a passage when it is nearer than this to its middle, metres: half of what a wall is thick.
const REACH_M: f64 = 0.3;

/// The doors at some passages (from jamb to jamb) of a subdivision with rooms by face id.
pub(super) fn of(passages: &[[Point; 2]], subdivision: &Subdivision, rooms: &[Option<u32>]) -> Vec<Door> {
    let is_border = |&edge: &EdgeId| {
        let [left, right] = subdivision.sides(edge).map(|face| rooms.get(face.index()).copied().flatten());
        left != right
    };
    let borders: Vec<EdgeId> = subdivision.edges().filter(is_border).collect();
    let door = |&ends: &[Point; 2]| {
        let middle = nalgebra::center(&ends[0], &ends[1]);
        let is_through = |&edge: &EdgeId| segment::distance(middle, subdivision.segment(edge)) < REACH_M;
        let edges: Vec<EdgeId> = borders.iter().copied().filter(is_through).collect();
        let faces = subdivision.sides(*edges.first()?);
        Some(Door { ends, edges, faces })
    };
    passages.iter().filter_map(door).collect()
}
