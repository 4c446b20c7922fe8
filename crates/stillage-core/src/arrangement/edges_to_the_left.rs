//! For each of some points the first edge to the left.
//!
//! Method: a sweep over the points by height that keeps the pieces at the current height in order from left to right
//! (M. de Berg et al., *Computational Geometry*, 3rd ed., 2.1). Noded pieces do not cross, so their order never
//! changes. All decisions are exact. Cost: O(E + (C + e) log e) for E pieces and C points, e pieces being at the height
//! of a point.

use std::cmp::Ordering;
use std::collections::BTreeSet;

use super::ids::EdgeId;
use super::lattice::{LatticePoint, LatticeSegment, cross};
use super::noding::Piece;
use crate::watch::{Stopped, Watch};

/// For each point, ascending by (y, x): the first of the noded, sorted pieces that a ray to the left meets, just above
/// the height of the point.
pub(super) fn find(
    pieces: &[Piece],
    points: &[LatticePoint],
    watch: &Watch<'_>,
) -> Result<Vec<Option<EdgeId>>, Stopped> {
    // A piece is at the heights from its low end up to, but without, its high end; level pieces are at none.
    let is_at_a_point = |crossing: &Crossing| {
        let next = points.partition_point(|point| point.y < crossing.segment.low.y);
        points.get(next).is_some_and(|point| point.y < crossing.segment.high.y)
    };
    let crossings = pieces.iter().zip(0..).map(|(piece, edge)| Crossing { segment: piece.segment, edge });
    let by_low: Vec<Crossing> = crossings.filter(is_at_a_point).collect();
    let mut by_high = by_low.clone();
    by_high.sort_by_key(|crossing| crossing.segment.high.y);
    let mut starting = by_low.into_iter().peekable();
    let mut ending = by_high.into_iter().peekable();
    let mut current = BTreeSet::new();
    let mut found = Vec::with_capacity(points.len());
    for &point in points {
        watch.check()?;
        while let Some(crossing) = ending.next_if(|crossing| crossing.segment.high.y <= point.y) {
            current.remove(&crossing);
        }
        while let Some(crossing) = starting.next_if(|crossing| crossing.segment.low.y <= point.y) {
            current.insert(crossing);
        }
        let upwards = LatticeSegment { low: point, high: LatticePoint { y: point.y + 1, x: point.x } };
        let mut before = current.range(..Crossing { segment: upwards, edge: u32::MAX }).rev();
        // Pieces that begin in the point are not to the left of it.
        let first = before.find(|crossing| crossing.segment.side(point) < 0);
        found.push(first.map(|crossing| EdgeId(crossing.edge)));
    }
    Ok(found)
}

/// A piece that is at the current height. Ordered from left to right, among pieces that have a height in common.
#[derive(Debug, Clone, Copy)]
struct Crossing {
    segment: LatticeSegment,
    edge: u32,
}

impl Ord for Crossing {
    fn cmp(&self, other: &Self) -> Ordering {
        let common = self.segment.low.y.max(other.segment.low.y);
        order_at(self.segment, other.segment, common).then(self.edge.cmp(&other.edge))
    }
}

impl PartialOrd for Crossing {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Crossing {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Crossing {}

/// Order of two segments along the level line at `y`, or just above it where they meet there.
fn order_at(first: LatticeSegment, second: LatticeSegment, y: i64) -> Ordering {
    // x at the level is numerator / dy.
    let numerator = |segment: LatticeSegment| {
        let (dx, dy) = segment.direction();
        segment.low.x * dy + (y - segment.low.y) * dx
    };
    let (first_dy, second_dy) = (first.direction().1, second.direction().1);
    let first_x = i128::from(numerator(first)) * i128::from(second_dy);
    let second_x = i128::from(numerator(second)) * i128::from(first_dy);
    first_x.cmp(&second_x).then_with(|| cross(first.direction(), second.direction()).cmp(&0))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::arrangement::EdgeSource;

    /// Ten lattice steps for each segment, so that none meets another.
    const COLUMN: i64 = 10;

    proptest! {
        #[test]
        fn no_edge_is_nearer(
            ends in prop::collection::vec([0..COLUMN, 0..20_i64, 0..COLUMN, 0..20], 0..40),
            points in prop::collection::vec((0..20_i64, 0..400_i64), 0..20),
        ) {
            let segment = |(column, &[x, y, other_x, other_y]): (i64, &[i64; 4])| {
                let at = |x: i64, y: i64| LatticePoint { y, x: column * COLUMN + x };
                LatticeSegment::between(at(x, y), at(other_x, other_y))
            };
            let segments = (0..).zip(&ends).filter_map(segment);
            let mut pieces: Vec<Piece> =
                segments.map(|segment| Piece { segment, source: EdgeSource::Boundary }).collect();
            pieces.sort_unstable();
            let mut points: Vec<LatticePoint> = points.into_iter().map(|(y, x)| LatticePoint { y, x }).collect();
            points.sort_unstable();
            let found = find(&pieces, &points, &Watch::unwatched()).expect("nobody stops it");
            for (point, found) in points.into_iter().zip(found) {
                let is_left = |&edge: &usize| {
                    let segment = pieces[edge].segment;
                    (segment.low.y..segment.high.y).contains(&point.y) && segment.side(point) < 0
                };
                // Segments do not overlap along x, so the nearest one is the one that reaches furthest right.
                let nearest = (0..pieces.len()).filter(is_left).max_by_key(|&edge| pieces[edge].segment.x_range().1);
                prop_assert_eq!(found.map(EdgeId::index), nearest);
            }
        }
    }
}
