//! How one location is reached: its access edges, its frame, and where a robot stands before it.
//!
//! Source: the storage-access edges of the paper's section II-C; the frame and the approach are our own.
//! Cost: O(edges of the face and of the face it is reached from). Limits: the approach is computed from faces, not from
//! cells; routing finds out whether its cell is free.

use super::location::ApproachPose;
use crate::analysis::Analysis;
use crate::arrangement::{EdgeId, FaceId, HalfEdgeId};
use crate::geometry::{OrientedBox, Point, Vector, direction, polygon, segment};
use crate::semantics::{Cogency, SemanticMap};

/// Distance of the middle of a robot from the access edge before which it stands, metres: our choice, half a robot of
/// 1.2 m and 0.2 m to spare. Where the face before the edge is less than twice as deep, half its depth is taken.
const STANDING_DISTANCE_M: f64 = 0.8;

/// Place, size and access of one location.
#[derive(Debug, Clone)]
pub(super) struct Access {
    /// The storage face.
    pub face: FaceId,
    /// Its centroid.
    pub center: Point,
    /// Extent along the best access edge, metres.
    pub width: f64,
    /// Extent across it, metres.
    pub depth: f64,
    /// Direction into the location, radians.
    pub heading: f64,
    /// All access edges, the best first.
    pub edges: Vec<EdgeId>,
    /// More about the best one.
    pub best: Option<BestAccess>,
}

/// The access edge that decides the frame of a location.
#[derive(Debug, Clone, Copy)]
pub(super) struct BestAccess {
    /// The drivable face before it.
    pub from: FaceId,
    /// Its middle.
    pub middle: Point,
    /// Where a robot stands.
    pub approach: ApproachPose,
}

impl Access {
    /// Finds the access of a storage face.
    pub fn of(face: FaceId, analysis: &Analysis, semantic: &SemanticMap) -> Self {
        let halves = access_half_edges(face, analysis, semantic);
        let annotation = &analysis.faces[face.index()];
        let rings = analysis.subdivision.rings(face);
        let frame = halves.first().map(|&half| AccessFrame::of(half, analysis));
        // Without an access edge, the location is taken to be entered at its short side.
        let inward = frame.as_ref().map_or_else(|| direction(annotation.heading), |frame| frame.inward);
        let heading = inward.y.atan2(inward.x);
        let outline = rings.first().into_iter().flatten().copied();
        let half_extents = OrientedBox::around(outline, heading).map_or([0.0; 2], |extent| extent.half_extents);
        Self {
            face,
            center: center(&rings),
            width: 2.0 * half_extents[1],
            depth: 2.0 * half_extents[0],
            heading,
            edges: halves.iter().map(|half| half.edge()).collect(),
            best: frame.map(|frame| frame.access(heading, analysis)),
        }
    }
}

/// The half-edges of a face over which it is reached; first the one with the greatest passable length.
fn access_half_edges(face: FaceId, analysis: &Analysis, semantic: &SemanticMap) -> Vec<HalfEdgeId> {
    let subdivision = &analysis.subdivision;
    let gives_access = |half: &HalfEdgeId| {
        let before = subdivision.half_edge(half.twin()).face;
        semantic.cogency[half.edge().index()] == Cogency::StorageAccess && semantic.label(before).is_drivable()
    };
    // Open length counts whole, unknown length half, obstructed length nothing.
    let passable = |half: HalfEdgeId| {
        let annotation = &analysis.edges[half.edge().index()];
        subdivision.length(half.edge()) * (1.0 + annotation.open - annotation.support) / 2.0
    };
    let length = |half: HalfEdgeId| subdivision.length(half.edge());
    let mut halves: Vec<HalfEdgeId> = subdivision.boundary(face).filter(gives_access).collect();
    halves.sort_by(|&first, &second| {
        let by_passable = passable(second).total_cmp(&passable(first));
        by_passable.then(length(second).total_cmp(&length(first))).then(first.cmp(&second))
    });
    halves
}

/// Place and direction of the best access edge.
struct AccessFrame {
    from: FaceId,
    middle: Point,
    /// Unit vector into the location.
    inward: Vector,
}

impl AccessFrame {
    fn of(half: HalfEdgeId, analysis: &Analysis) -> Self {
        let subdivision = &analysis.subdivision;
        let start = subdivision.position(subdivision.half_edge(half).origin);
        let end = subdivision.position(subdivision.target(half));
        let along = end - start;
        // The location lies on the left of its half-edge.
        let inward = Vector::new(-along.y, along.x).try_normalize(0.0).unwrap_or_else(Vector::x);
        Self { from: subdivision.half_edge(half.twin()).face, middle: nalgebra::center(&start, &end), inward }
    }

    fn access(self, heading: f64, analysis: &Analysis) -> BestAccess {
        let outward = -self.inward;
        let room = room_ahead(self.middle, outward, self.from, analysis);
        let position = self.middle + outward * STANDING_DISTANCE_M.min(room / 2.0);
        BestAccess { from: self.from, middle: self.middle, approach: ApproachPose { position, heading } }
    }
}

/// How far a face reaches from a point of its boundary, metres.
fn room_ahead(from: Point, ahead: Vector, face: FaceId, analysis: &Analysis) -> f64 {
    // Edges nearer than this, in metres, are the one that the point lies on: lines of an analysis are 10 mm apart at
    // least.
    const SAME_EDGE_M: f64 = 1e-6;
    let subdivision = &analysis.subdivision;
    let hits = subdivision.boundary(face).filter_map(|half| {
        // Parallel edges give no number, and no hit.
        let [distance, share] = segment::crossing(from, ahead, subdivision.segment(half.edge()));
        (distance > SAME_EDGE_M && (0.0..=1.0).contains(&share)).then_some(distance)
    });
    let room = hits.fold(f64::INFINITY, f64::min);
    if room.is_finite() { room } else { 0.0 }
}

/// Centroid of a face; its first point where it has no area.
fn center(rings: &[Vec<Point>]) -> Point {
    polygon::centroid(rings).or_else(|| rings.iter().flatten().next().copied()).unwrap_or_else(Point::origin)
}
