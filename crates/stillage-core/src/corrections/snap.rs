//! What is drawn by hand joins what is there, so that no sliver is left between the two.
//!
//! A point within a cell of a vertex becomes that vertex, else one within a cell of an edge moves onto it. The side of a
//! polygon bends to the vertices within a cell of it. What is drawn keeps its shape: no corner joins another one, and no
//! side turns by more than [`MOST_TURN`]. Where the corners of a polygon would, it moves as a whole, by what brings one of
//! them onto what is there; where it would cross itself even so, or leave the map, it stays as it was drawn. Cost: O(points x
//! edges near the drawing).

use super::check::check_ring;
use crate::arrangement::Redrawing;
use crate::geometry::{Bounds, Point, Vector, segment};

/// How near to a vertex or an edge a point joins it, cells: what is nearer cannot be told apart on the map.
pub(super) const TOLERANCE_CELLS: f64 = 1.0;

/// How far a side may turn by joining what is there, radians (10 degrees): a side of a dozen cells may then move by a cell at
/// either end. What is more is seen as crooked.
const MOST_TURN: f64 = std::f64::consts::PI / 18.0;
/// Sides up to this length have no direction that could be seen, cells.
const NO_DIRECTION_CELLS: f64 = 2.0;
/// What a shift may round off, metres.
const ROUNDING_M: f64 = 1e-9;

/// What lies near a drawing.
pub(super) struct Snap {
    vertices: Vec<Point>,
    edges: Vec<[Point; 2]>,
    map: Bounds,
    /// Metres.
    tolerance: f64,
}

impl Snap {
    /// Looks up what lies within `tolerance` metres of the box around some points of a map with these bounds.
    pub fn near(pieces: &Redrawing, map: Bounds, points: &[Point], tolerance: f64) -> Self {
        let edges = pieces.near(&Bounds::around(points).grown(tolerance));
        let mut vertices: Vec<Point> = edges.iter().flatten().copied().collect();
        vertices.sort_unstable_by(|one, other| one.y.total_cmp(&other.y).then(one.x.total_cmp(&other.x)));
        vertices.dedup();
        Self { vertices, edges, map: map.grown(ROUNDING_M), tolerance }
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

    /// The corners of a polygon that joins what is there, with the vertices to which its sides bend.
    pub fn ring(&self, ring: &[Point]) -> Vec<Point> {
        let joined = self.corners(ring);
        let sides = joined.iter().zip(joined.iter().cycle().skip(1));
        let bent = without_repeats(sides.flat_map(|(&start, &end)| self.bent([start, end])).collect());
        if check_ring(&bent, "").is_ok() { bent } else { joined }
    }

    /// The corners of a polygon that joins what is there, in their order.
    pub fn corners(&self, ring: &[Point]) -> Vec<Point> {
        let each: Vec<Point> = ring.iter().map(|&corner| self.point(corner)).collect();
        let shifts = ring.iter().zip(&each).map(|(corner, joined)| joined - corner).filter(|shift| shift.norm() > 0.0);
        let shift = shifts.min_by(|one, other| one.norm().total_cmp(&other.norm()));
        let whole = shift.map(|shift| ring.iter().map(|corner| corner + shift).collect());
        let whole = whole.filter(|corners: &Vec<Point>| corners.iter().all(|&corner| self.map.contains(corner)));
        let candidates = [Some(each).filter(|each| self.keeps_shape(ring, each)), whole];
        let sound = candidates.into_iter().flatten().find(|corners| check_ring(corners, "").is_ok());
        sound.unwrap_or_else(|| ring.to_vec())
    }

    /// Whether the sides of a polygon look the same after its corners moved.
    fn keeps_shape(&self, before: &[Point], after: &[Point]) -> bool {
        let sides = |ring: &[Point]| -> Vec<Vector> {
            ring.iter().zip(ring.iter().cycle().skip(1)).map(|(start, end)| end - start).collect()
        };
        let keeps_direction = |(before, after): (&Vector, &Vector)| {
            let has_direction = before.norm() > NO_DIRECTION_CELLS * self.tolerance / TOLERANCE_CELLS;
            after.norm() > 0.0 && (!has_direction || before.angle(after) <= MOST_TURN)
        };
        sides(before).iter().zip(&sides(after)).all(keeps_direction)
    }

    /// A segment that bends to the vertices beside it: all its points but the last.
    pub fn bent(&self, [start, end]: [Point; 2]) -> Vec<Point> {
        let turns_little = |vertex: Point| {
            let away = segment::distance(vertex, [start, end]);
            [start, end].iter().all(|tip| away <= (*tip - vertex).norm() * MOST_TURN.sin())
        };
        let is_beside = |vertex: &&Point| {
            segment::distance(**vertex, [start, end]) <= self.tolerance
                && [start, end].iter().all(|tip| (*tip - **vertex).norm() > self.tolerance)
                && turns_little(**vertex)
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
