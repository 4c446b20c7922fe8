//! The doubly connected edge list: topology in `half_edges` and `cycles`, positions beside it.

use serde::{Deserialize, Serialize};

use super::ids::{EdgeId, FaceId, HalfEdgeId, VertexId};
use crate::geometry::{Point, polygon, ring_area};

/// What an edge comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub enum EdgeSource {
    /// A boundary of a region or of the map.
    Boundary,
    /// The line with this index.
    Line(u32),
    /// A correction: a person drew it.
    Drawn,
}

/// One direction of an edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct HalfEdge {
    /// Where it starts.
    pub origin: VertexId,
    /// The half-edge that follows around its face.
    pub next: HalfEdgeId,
    /// The half-edge before it around its face.
    pub previous: HalfEdgeId,
    /// The face on its left.
    pub face: FaceId,
}

/// The subdivision S = (vertices, edges, faces) of the paper (II-B), with N(e) and M(f).
///
/// Ids are canonical: vertices ascend by (y, x), edges by their vertices (the lower first), faces by the first
/// half-edge of their outer cycle, and with it by their first vertex; face 0 is the unbounded one. Every edge separates
/// two different faces.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Subdivision {
    /// Step of the lattice that the vertices lie on, metres; a power of two.
    pub(super) step: f64,
    /// Positions by vertex, grid frame, metres.
    pub(super) positions: Vec<Point>,
    /// Half-edges; 2e and 2e + 1 are the two directions of edge e.
    pub(super) half_edges: Vec<HalfEdge>,
    /// What each edge comes from.
    pub(super) sources: Vec<EdgeSource>,
    /// By face: one half-edge of each boundary cycle, the outer cycle first (face 0 has only inner ones).
    pub(super) cycles: Vec<Vec<HalfEdgeId>>,
}

impl Subdivision {
    /// Number of vertices.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    /// Number of edges.
    #[must_use]
    pub fn edge_count(&self) -> usize {
        self.sources.len()
    }

    /// Number of faces, the unbounded one included: ids run from 0 to below this.
    #[must_use]
    pub fn face_count(&self) -> usize {
        self.cycles.len()
    }

    /// All vertices.
    pub fn vertices(&self) -> impl ExactSizeIterator<Item = VertexId> + use<> {
        (0..self.positions.len() as u32).map(VertexId)
    }

    /// All edges.
    pub fn edges(&self) -> impl ExactSizeIterator<Item = EdgeId> + use<> {
        (0..self.sources.len() as u32).map(EdgeId)
    }

    /// The bounded faces.
    pub fn faces(&self) -> impl ExactSizeIterator<Item = FaceId> + use<> {
        (1..self.cycles.len().max(1) as u32).map(FaceId)
    }

    /// Position of a vertex.
    #[must_use]
    pub fn position(&self, vertex: VertexId) -> Point {
        self.positions[vertex.index()]
    }

    /// The record of a half-edge.
    #[must_use]
    pub fn half_edge(&self, half_edge: HalfEdgeId) -> HalfEdge {
        self.half_edges[half_edge.index()]
    }

    /// Where a half-edge ends.
    #[must_use]
    pub fn target(&self, half_edge: HalfEdgeId) -> VertexId {
        self.half_edge(half_edge.twin()).origin
    }

    /// The two ends of an edge.
    #[must_use]
    pub fn ends(&self, edge: EdgeId) -> [VertexId; 2] {
        let forward = edge.forward();
        [self.half_edge(forward).origin, self.target(forward)]
    }

    /// The positions of the two ends of an edge.
    #[must_use]
    pub fn segment(&self, edge: EdgeId) -> [Point; 2] {
        self.ends(edge).map(|vertex| self.position(vertex))
    }

    /// The neighbourhood function N(e): the faces left and right of an edge.
    #[must_use]
    pub fn sides(&self, edge: EdgeId) -> [FaceId; 2] {
        let forward = edge.forward();
        [self.half_edge(forward).face, self.half_edge(forward.twin()).face]
    }

    /// What an edge comes from.
    #[must_use]
    pub fn source(&self, edge: EdgeId) -> EdgeSource {
        self.sources[edge.index()]
    }

    /// Length of an edge, metres.
    #[must_use]
    pub fn length(&self, edge: EdgeId) -> f64 {
        let [start, end] = self.segment(edge);
        (end - start).norm()
    }

    /// The half-edges of the cycle that `start` lies on.
    pub fn cycle(&self, start: HalfEdgeId) -> impl Iterator<Item = HalfEdgeId> + '_ {
        let mut at = Some(start);
        std::iter::from_fn(move || {
            let current = at?;
            let next = self.half_edge(current).next;
            at = (next != start).then_some(next);
            Some(current)
        })
    }

    /// One half-edge of each boundary cycle of a face, the outer cycle first.
    #[must_use]
    pub fn cycles(&self, face: FaceId) -> &[HalfEdgeId] {
        &self.cycles[face.index()]
    }

    /// The half-edges around a face, cycle after cycle.
    pub fn boundary(&self, face: FaceId) -> impl Iterator<Item = HalfEdgeId> + '_ {
        self.cycles(face).iter().flat_map(|&start| self.cycle(start))
    }

    /// The rings of a face: the outer one counter-clockwise, then the holes clockwise; first points not repeated.
    ///
    /// Rings are simple: a cycle that comes through a vertex twice (a hole that touches the outline, say) is taken
    /// apart there, as GeoJSON and OGC Simple Features require.
    #[must_use]
    pub fn rings(&self, face: FaceId) -> Vec<Vec<Point>> {
        let vertices = |&start: &HalfEdgeId| self.cycle(start).map(|half| self.half_edge(half).origin);
        let simple = self.cycles(face).iter().flat_map(|start| polygon::simple_rings(vertices(start)));
        let mut rings: Vec<Vec<Point>> =
            simple.map(|ring| ring.into_iter().map(|vertex| self.position(vertex)).collect()).collect();
        rings.sort_by_key(|ring| ring_area(ring) < 0.0);
        rings
    }

    /// Area of a bounded face, square metres.
    #[must_use]
    pub fn area(&self, face: FaceId) -> f64 {
        polygon::area(&self.rings(face))
    }
}
