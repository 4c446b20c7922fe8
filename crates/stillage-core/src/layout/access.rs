//! From which side each storage face is reached.
//!
//! Method: the storage-access edges of a face (paper, section II-C) are grouped by the direction they face. A side counts
//! by the length along which a vehicle finds room before it. Places of one row are reached from one side: a place follows
//! its neighbours beside it where it has a side that faces their way. A place that no rule gives access to, and that lies
//! behind none that has, is reached from any drivable ground on which a vehicle finds room before it: that of a crossing,
//! or that behind a narrow strip. Cost: O(edges x samples). Limits: three rounds of following, so only the two places at
//! each end of a row can be mended.

use std::f64::consts::{FRAC_PI_4, PI};

use rayon::prelude::*;

use crate::arrangement::{EdgeId, FaceId, HalfEdgeId};
use crate::geometry::{DisjointSets, Point, Vector, direction};
use crate::semantics::Cogency;
use crate::site_map::SiteMap;

/// Edges whose directions differ by less than this face the same way, radians: half the angle between two sides.
const SAME_WAY: f64 = FRAC_PI_4;
/// Distance between two points of an edge before which room is looked for, metres: the width of a wheel.
const SAMPLE_M: f64 = 0.1;
/// How far before an edge a vehicle may stand beyond its own radius, metres: goods may overhang the border by this.
const REACH_M: f64 = 0.6;
/// How often places follow their neighbours.
const ROUNDS: usize = 3;
/// A side that nothing can drive up to counts as this share of its length: better than none.
const BLOCKED_SIDE: f64 = 0.01;

/// One side of a storage face with drivable ground before it.
#[derive(Debug, Clone)]
pub(super) struct AccessSide {
    /// Direction out of the face, radians.
    pub outward: f64,
    /// The drivable face before it.
    pub from: FaceId,
    /// Its half-edges, those with the most room first; the storage face lies on their left.
    pub halves: Vec<HalfEdgeId>,
    /// Length along which there is room before it, metres.
    room: f64,
}

impl AccessSide {
    /// Ids of its edges, those with the most room first.
    pub fn edges(&self) -> Vec<EdgeId> {
        self.halves.iter().map(|half| half.edge()).collect()
    }
}

/// The sides of each face from which it can be reached by the rules, that from which it is reached first.
pub(super) fn sides_of(map: &SiteMap<'_>, faces: &[FaceId], radius: f64) -> Vec<Vec<AccessSide>> {
    let mut sides: Vec<Vec<AccessSide>> =
        faces.par_iter().map(|&face| sides_of_face(map, face, |half| access_by_rule(map, half, radius))).collect();
    agree(map, faces, &mut sides);
    sides
}

/// Gives the faces at these indices the sides before which a vehicle finds room on any drivable ground.
pub(super) fn reach_from_any_ground(
    map: &SiteMap<'_>,
    faces: &[FaceId],
    without: &[usize],
    radius: f64,
    sides: &mut [Vec<AccessSide>],
) {
    let found: Vec<Vec<AccessSide>> = without
        .par_iter()
        .map(|&index| sides_of_face(map, faces[index], |half| any_access(map, half, radius)))
        .collect();
    for (&index, found) in without.iter().zip(found) {
        sides[index] = found;
    }
    agree(map, faces, sides);
}

/// Lets the places of one row be reached from one side.
fn agree(map: &SiteMap<'_>, faces: &[FaceId], sides: &mut [Vec<AccessSide>]) {
    follow_neighbours(map, faces, sides);
    agree_along_rows(map, faces, sides);
}

/// What lies before an edge.
#[derive(Debug, Clone, Copy)]
struct Before {
    /// The drivable face.
    from: FaceId,
    /// Length of the edge along which a vehicle finds room there, metres.
    room: f64,
}

/// What lies before an edge through which the rules give access.
fn access_by_rule(map: &SiteMap<'_>, half: HalfEdgeId, radius: f64) -> Option<Before> {
    let from = map.analysis.subdivision.half_edge(half.twin()).face;
    let gives_access = map.semantic.cogency[half.edge().index()] == Cogency::StorageAccess && map.is_drivable(from);
    let length = map.analysis.subdivision.length(half.edge());
    gives_access.then(|| Before { from, room: length * room_before(map, half, radius).0.max(BLOCKED_SIDE) })
}

/// What lies before an edge where a vehicle finds room, whatever the rules say.
fn any_access(map: &SiteMap<'_>, half: HalfEdgeId, radius: f64) -> Option<Before> {
    let across = map.analysis.subdivision.half_edge(half.twin()).face;
    if across == FaceId::OUTER || map.semantic.label(across).is_storage() {
        return None;
    }
    let (share, stand) = room_before(map, half, radius);
    Some(Before { from: map.face_at(stand?), room: map.analysis.subdivision.length(half.edge()) * share })
}

fn sides_of_face(map: &SiteMap<'_>, face: FaceId, before: impl Fn(HalfEdgeId) -> Option<Before>) -> Vec<AccessSide> {
    let measure = |half| {
        let out = outward(map, half);
        Some((before(half)?, out.y.atan2(out.x), half))
    };
    let mut measured: Vec<(Before, f64, HalfEdgeId)> =
        map.analysis.subdivision.boundary(face).filter_map(measure).collect();
    measured.sort_by(|first, second| second.0.room.total_cmp(&first.0.room).then(first.2.cmp(&second.2)));
    let mut sides: Vec<AccessSide> = Vec::new();
    for (Before { from, room }, out, half) in measured {
        match sides.iter_mut().find(|side| turn_between(side.outward, out) < SAME_WAY) {
            Some(side) => {
                side.room += room;
                side.halves.push(half);
            }
            None => sides.push(AccessSide { outward: out, from, halves: vec![half], room }),
        }
    }
    sides.sort_by(|first, second| second.room.total_cmp(&first.room).then(first.halves[0].cmp(&second.halves[0])));
    sides
}

/// Unit vector out of a storage face across one of its half-edges.
pub(super) fn outward(map: &SiteMap<'_>, half: HalfEdgeId) -> Vector {
    let subdivision = &map.analysis.subdivision;
    let along =
        subdivision.position(subdivision.target(half)) - subdivision.position(subdivision.half_edge(half).origin);
    // The storage face lies on the left.
    Vector::new(along.y, -along.x).try_normalize(0.0).unwrap_or_else(Vector::x)
}

/// Share of an edge before which a vehicle can stand, and the first such point.
fn room_before(map: &SiteMap<'_>, half: HalfEdgeId, radius: f64) -> (f64, Option<Point>) {
    let out = outward(map, half);
    let [start, end] = map.analysis.subdivision.segment(half.edge());
    let samples = ((end - start).norm() / SAMPLE_M).ceil().max(1.0) as usize;
    let steps = (REACH_M / map.grid.resolution()).ceil() as usize;
    let stand_before = |sample: usize| {
        let place = start + (end - start) * ((sample as f64 + 0.5) / samples as f64);
        let mut stands = (0..=steps).map(|step| place + out * (radius + step as f64 * map.grid.resolution()));
        stands.find(|&stand| map.clearance.at(stand) >= radius && map.is_drivable(map.face_at(stand)))
    };
    let mut stands = (0..samples).filter_map(stand_before);
    let first = stands.next();
    let open = usize::from(first.is_some()) + stands.count();
    (open as f64 / samples as f64, first)
}

/// The angle between two directions, radians.
fn turn_between(first: f64, second: f64) -> f64 {
    ((first - second + PI).rem_euclid(2.0 * PI) - PI).abs()
}

/// The storage faces beside each one: pairs of indices and the edge between them.
fn neighbours(map: &SiteMap<'_>, faces: &[FaceId]) -> Vec<([usize; 2], [Point; 2])> {
    let subdivision = &map.analysis.subdivision;
    let mut index = vec![usize::MAX; subdivision.face_count()];
    for (at, face) in faces.iter().enumerate() {
        index[face.index()] = at;
    }
    let pair = |edge: EdgeId| {
        let [left, right] = subdivision.sides(edge).map(|face| index[face.index()]);
        (left != usize::MAX && right != usize::MAX && left != right).then(|| ([left, right], subdivision.segment(edge)))
    };
    subdivision.edges().filter_map(pair).collect()
}

/// Whether a border between two places runs along the direction from which one of them is reached: they lie side by side.
fn is_beside(outward: f64, [start, end]: [Point; 2]) -> bool {
    (end - start).try_normalize(0.0).is_some_and(|along| along.dot(&direction(outward)).abs() > SAME_WAY.cos())
}

/// Lets places at the ends of rows, which have a side to the cross aisle, follow the places beside them.
fn follow_neighbours(map: &SiteMap<'_>, faces: &[FaceId], sides: &mut [Vec<AccessSide>]) {
    let pairs = neighbours(map, faces);
    for _ in 0..ROUNDS {
        let mut votes: Vec<Vec<f64>> = vec![Vec::new(); sides.len()];
        for &([one, other], border) in &pairs {
            for (voter, follower) in [(one, other), (other, one)] {
                let Some(way) = sides[voter].first().map(|side| side.outward) else { continue };
                if is_beside(way, border) {
                    votes[follower].push(way);
                }
            }
        }
        for (own, votes) in sides.iter_mut().zip(&votes) {
            let Some(first) = own.first() else { continue };
            let is_backed = votes.iter().any(|&way| turn_between(way, first.outward) < SAME_WAY);
            let backed =
                own.iter().position(|side| votes.iter().any(|&way| turn_between(way, side.outward) < SAME_WAY));
            if let (false, Some(backed)) = (is_backed, backed) {
                own[..=backed].rotate_right(1);
            }
        }
    }
}

/// Rows that are open on both sides are reached from the one with more room, all along.
fn agree_along_rows(map: &SiteMap<'_>, faces: &[FaceId], sides: &mut [Vec<AccessSide>]) {
    let mut chains = DisjointSets::new(faces.len());
    for ([one, other], border) in neighbours(map, faces) {
        let beside = |at: usize| sides[at].first().is_some_and(|side| is_beside(side.outward, border));
        if beside(one) && beside(other) {
            chains.join(one, other);
        }
    }
    let roots: Vec<usize> = (0..faces.len()).map(|at| chains.find(at)).collect();
    // Room by the way of the chain's first place, and against it.
    let mut room = vec![[0.0; 2]; faces.len()];
    let ways: Vec<Option<f64>> = roots.iter().map(|&root| sides[root].first().map(|side| side.outward)).collect();
    for (at, &root) in roots.iter().enumerate() {
        let Some(way) = ways[root] else { continue };
        for side in &sides[at] {
            let turn = turn_between(side.outward, way);
            if turn < SAME_WAY {
                room[root][0] += side.room;
            } else if turn > PI - SAME_WAY {
                room[root][1] += side.room;
            }
        }
    }
    for (at, &root) in roots.iter().enumerate() {
        let Some(way) = ways[root] else { continue };
        let way = if room[root][1] > room[root][0] { way + PI } else { way };
        if let Some(best) = sides[at].iter().position(|side| turn_between(side.outward, way) < SAME_WAY) {
            sides[at][..=best].rotate_right(1);
        }
    }
}
