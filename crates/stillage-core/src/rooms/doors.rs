//! Doors: the edges of the subdivision that run through the doorways between rooms.
//!
//! The borders of rooms are walked in steps, and the doorways near each step are looked up in buckets. Cost: O(length
//! of the borders + doorways near them), and a logarithm. Limits: a doorway that no edge runs through, since both its
//! sides are one face, is no door.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::arrangement::{EdgeId, FaceId, Subdivision};
use crate::geometry::{Point, segment};

/// An edge runs through a doorway when it is nearer than this to its middle, metres: half of what a wall is thick.
const REACH_M: f64 = 0.3;
/// Side of a bucket, and step along a border, metres: more than twice the reach, so that what is within reach of a
/// border lies in a bucket beside one of its steps.
const BUCKET_M: f64 = 1.0;

/// A narrow way between two rooms, or between a room and other ground.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Door {
    /// From jamb to jamb, metres of the grid frame.
    pub ends: [Point; 2],
    /// The edges that run through it, ascending; at least one.
    pub edges: Vec<EdgeId>,
    /// The faces that its first edge lies between.
    pub faces: [FaceId; 2],
}

impl Door {
    /// Distance between the jambs, metres.
    #[must_use]
    pub fn width(&self) -> f64 {
        (self.ends[1] - self.ends[0]).norm()
    }
}

/// The doors at some doorways (from jamb to jamb) of a subdivision with rooms by face id.
pub(super) fn find(doorways: &[[Point; 2]], subdivision: &Subdivision, rooms: &[Option<u32>]) -> Vec<Door> {
    let middles: Vec<Point> = doorways.iter().map(|ends| nalgebra::center(&ends[0], &ends[1])).collect();
    let mut buckets: BTreeMap<[i64; 2], Vec<usize>> = BTreeMap::new();
    for (number, &middle) in middles.iter().enumerate() {
        buckets.entry(bucket(middle)).or_default().push(number);
    }
    let is_border = |&edge: &EdgeId| {
        let [left, right] = subdivision.sides(edge).map(|face| rooms.get(face.index()).copied().flatten());
        left != right
    };
    let mut edges: Vec<Vec<EdgeId>> = vec![Vec::new(); doorways.len()];
    for edge in subdivision.edges().filter(is_border) {
        for number in near(&buckets, subdivision.segment(edge)) {
            if segment::distance(middles[number], subdivision.segment(edge)) < REACH_M {
                edges[number].push(edge);
            }
        }
    }
    let door = |(&ends, edges): (&[Point; 2], Vec<EdgeId>)| {
        let faces = subdivision.sides(*edges.first()?);
        Some(Door { ends, edges, faces })
    };
    doorways.iter().zip(edges).filter_map(door).collect()
}

/// The numbers in the buckets beside a segment, ascending, each once.
fn near(buckets: &BTreeMap<[i64; 2], Vec<usize>>, [start, end]: [Point; 2]) -> Vec<usize> {
    let way = end - start;
    let steps = (way.norm() / BUCKET_M).ceil().max(1.0) as usize;
    let mut found = Vec::new();
    for step in 0..=steps {
        let [column, row] = bucket(start + way * (step as f64 / steps as f64));
        // Buckets ascend by column, then row: one range for each column.
        for column in column - 1..=column + 1 {
            found.extend(buckets.range([column, row - 1]..=[column, row + 1]).flat_map(|(_, numbers)| numbers));
        }
    }
    found.sort_unstable();
    found.dedup();
    found
}

fn bucket(point: Point) -> [i64; 2] {
    [point.x, point.y].map(|side| (side / BUCKET_M).floor() as i64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arrangement::{EdgeSource, SourceSegment, arrange};
    use crate::watch::Watch;

    /// Two rooms of a square of 40 m on either side of its diagonal, which is one edge.
    #[test]
    fn a_doorway_within_reach_of_a_long_border_is_a_door() {
        let corners = [(0.0, 0.0), (40.0, 0.0), (40.0, 40.0), (0.0, 40.0)].map(|(x, y)| Point::new(x, y));
        let segment = |[start, end]: [usize; 2]| {
            let [start, end] = [corners[start], corners[end]];
            SourceSegment { start, end, source: EdgeSource::Boundary }
        };
        let segments = [[0, 1], [1, 2], [2, 3], [3, 0], [0, 2]].map(segment);
        let subdivision = arrange(&segments, &Watch::unwatched()).expect("nobody stops it");
        let doorway = |along: f64, aside: f64| {
            let middle = Point::new(along, along) + crate::Vector::new(-aside, aside) / std::f64::consts::SQRT_2;
            [middle - crate::Vector::new(0.4, 0.0), middle + crate::Vector::new(0.4, 0.0)]
        };
        let near = [doorway(0.5, 0.0), doorway(13.3, 0.29), doorway(27.9, -0.29), doorway(39.2, 0.1)];
        let far = [doorway(13.3, 0.31), doorway(20.0, -0.6), doorway(30.0, 5.0)];
        let found = find(&[near.as_slice(), far.as_slice()].concat(), &subdivision, &[None, Some(0), Some(1)]);
        assert_eq!(found.iter().map(|door| door.ends).collect::<Vec<_>>(), near);
        assert!(found.iter().all(|door| (door.width() - 0.8).abs() < 1e-9 && door.edges.len() == 1));
    }
}
