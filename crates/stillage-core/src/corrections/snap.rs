//! What is drawn by hand joins what is there, so that no sliver is left between the two.
//!
//! A point within a cell of a vertex becomes that vertex, else one within a cell of an edge moves onto it. The side of a
//! polygon bends to the vertices within a cell of it. Where a polygon would cross itself by that, less is moved. Cost:
//! O(points x edges near the drawing).

use super::check::check_ring;
use crate::arrangement::Redrawing;
use crate::geometry::{Bounds, Point, segment};

/// How near to a vertex or an edge a point joins it, cells: what is nearer cannot be told apart on the map.
pub(super) const TOLERANCE_CELLS: f64 = 1.0;

/// What lies near a drawing.
pub(super) struct Snap {
    vertices: Vec<Point>,
    edges: Vec<[Point; 2]>,
    /// Metres.
    tolerance: f64,
}

impl Snap {
    /// Looks up what lies within `tolerance` metres of the box around some points.
    pub fn near(pieces: &Redrawing, points: &[Point], tolerance: f64) -> Self {
        let edges = pieces.near(&Bounds::around(points).grown(tolerance));
        let mut vertices: Vec<Point> = edges.iter().flatten().copied().collect();
        vertices.sort_unstable_by(|one, other| one.y.total_cmp(&other.y).then(one.x.total_cmp(&other.x)));
        vertices.dedup();
        Self { vertices, edges, tolerance }
    }

    /// The vertex or the point of an edge that a point joins, or the point itself.
    pub fn point(&self, point: Point) -> Point {
        let nearest = |candidates: &mut dyn Iterator<Item = Point>| {
            let within = candidates.map(|candidate| ((candidate - point).norm(), candidate));
            within
                .filter(|(distance, _)| *distance <= self.tolerance)
                .min_by(|one, other| one.0.total_cmp(&other.0))
                .map(|(_, candidate)| candidate)
        };
        let vertex = nearest(&mut self.vertices.iter().copied());
        vertex
            .or_else(|| nearest(&mut self.edges.iter().map(|&edge| segment::nearest_point(point, edge))))
            .unwrap_or(point)
    }

    /// The corners of a polygon that joins what is there.
    pub fn ring(&self, ring: &[Point]) -> Vec<Point> {
        let joined = without_repeats(ring.iter().map(|&corner| self.point(corner)).collect());
        let sides = joined.iter().zip(joined.iter().cycle().skip(1));
        let bent = without_repeats(sides.flat_map(|(&start, &end)| self.bent([start, end])).collect());
        let sound = [bent, joined].into_iter().find(|candidate| check_ring(candidate, "").is_ok());
        sound.unwrap_or_else(|| ring.to_vec())
    }

    /// A segment that bends to the vertices beside it: all its points but the last.
    pub fn bent(&self, [start, end]: [Point; 2]) -> Vec<Point> {
        let is_beside = |vertex: &&Point| {
            segment::distance(**vertex, [start, end]) <= self.tolerance
                && [start, end].iter().all(|tip| (*tip - **vertex).norm() > self.tolerance)
        };
        let mut beside: Vec<Point> = self.vertices.iter().filter(is_beside).copied().collect();
        beside.sort_by(|one, other| {
            let share = |point| segment::share_of_nearest(point, [start, end]);
            share(*one).total_cmp(&share(*other))
        });
        std::iter::once(start).chain(beside).collect()
    }
}

/// The corners of a ring without those that repeat the one before.
fn without_repeats(mut ring: Vec<Point>) -> Vec<Point> {
    ring.dedup();
    while ring.len() > 1 && ring.first() == ring.last() {
        ring.pop();
    }
    ring
}
