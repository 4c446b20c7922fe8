//! From noded pieces to the doubly connected edge list.
//!
//! Method: sort the half-edges around every vertex, link each to the next one around its face, follow the cycles (M. de
//! Berg et al., *Computational Geometry*, 3rd ed., 2.2-2.3). A piece with the same cycle on both sides bounds nothing:
//! it has a loose end, or is the only connection between two parts. Such pieces are dropped, so that every edge
//! separates two faces and every link of the dual joins two nodes. The author's code drops loose ends once, and no
//! connections.
//!
//! Each connected component has one clockwise cycle, its outline, which is a hole of the face around the component; the
//! first edge to the left of the component's lowest vertex bounds that face. All decisions are exact. Cost: O(E log E)
//! for E edges.

use super::buckets::Buckets;
use super::edges_to_the_left;
use super::ids::{FaceId, HalfEdgeId, VertexId};
use super::lattice::{LatticePoint, cross};
use super::noding::Piece;
use super::subdivision::{HalfEdge, Subdivision};
use crate::watch::{Stopped, Watch};

/// Builds the subdivision of noded, sorted pieces; `step` is the lattice step in metres.
pub(super) fn build(mut pieces: Vec<Piece>, step: f64, watch: &Watch<'_>) -> Result<Subdivision, Stopped> {
    drop_pieces_that_bound_nothing(&mut pieces);
    watch.check()?;
    let links = Links::between(&pieces);
    let cycles = Cycles::along(&links);
    watch.check()?;
    let faces = Faces::of(&pieces, &links, &cycles, watch)?;
    let half_edge = |half: usize| HalfEdge {
        origin: links.origins[half],
        next: links.next[half],
        previous: links.previous[half],
        face: faces.by_cycle[cycles.cycle_of[half] as usize],
    };
    Ok(Subdivision {
        step,
        positions: links.vertices.iter().map(|vertex| vertex.position(step)).collect(),
        half_edges: (0..links.origins.len()).map(half_edge).collect(),
        sources: pieces.iter().map(|piece| piece.source).collect(),
        cycles: faces.of_face,
    })
}

/// Drops pieces with the same cycle on both sides. One pass is enough: all others lie on closed ways without them.
fn drop_pieces_that_bound_nothing(pieces: &mut Vec<Piece>) {
    let cycles = Cycles::along(&Links::between(pieces));
    let mut sides = cycles.cycle_of.chunks_exact(2);
    pieces.retain(|_| sides.next().is_some_and(|cycles| cycles[0] != cycles[1]));
}

/// How the half-edges of the pieces follow one another. Piece `e` has the half-edges 2e (up) and 2e + 1 (down).
struct Links {
    vertices: Vec<LatticePoint>,
    origins: Vec<VertexId>,
    next: Vec<HalfEdgeId>,
    previous: Vec<HalfEdgeId>,
}

impl Links {
    fn between(pieces: &[Piece]) -> Self {
        let mut vertices: Vec<_> = pieces.iter().flat_map(|piece| [piece.segment.low, piece.segment.high]).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let id_of = |point| VertexId(vertices.partition_point(|&vertex| vertex < point) as u32);
        let origins: Vec<_> =
            pieces.iter().flat_map(|piece| [id_of(piece.segment.low), id_of(piece.segment.high)]).collect();

        // Around each vertex, counter-clockwise: upward half-edges leave at angles in [0, pi), downward ones in
        // [pi, 2 pi); within either the sign of the cross product decides, the same for a direction and its reverse.
        let leaving: Vec<_> = origins.iter().map(|vertex| vertex.0).zip(0..).collect();
        let mut spokes = Buckets::pack(vertices.len(), &leaving);
        let direction = |half: u32| pieces[HalfEdgeId(half).edge().index()].segment.direction();
        let mut next = vec![HalfEdgeId(0); origins.len()];
        let mut previous = next.clone();
        for vertex in 0..vertices.len() {
            let around = spokes.of_mut(vertex);
            around.sort_unstable_by(|&first, &second| {
                let by_half_plane = (first & 1).cmp(&(second & 1));
                by_half_plane.then_with(|| 0.cmp(&cross(direction(first), direction(second))))
            });
            // Coming in along the twin of a half-edge, the next edge of the face on the left is the clockwise
            // neighbour.
            let mut clockwise = around.last().copied().unwrap_or_default();
            for &spoke in &*around {
                let twin = HalfEdgeId(spoke).twin();
                next[twin.index()] = HalfEdgeId(clockwise);
                previous[clockwise as usize] = twin;
                clockwise = spoke;
            }
        }
        Self { vertices, origins, next, previous }
    }
}

/// The cycles that the half-edges form, numbered by their least half-edge.
struct Cycles {
    cycle_of: Vec<u32>,
    starts: Vec<HalfEdgeId>,
}

impl Cycles {
    fn along(links: &Links) -> Self {
        const UNSEEN: u32 = u32::MAX;
        let mut cycle_of = vec![UNSEEN; links.next.len()];
        let mut starts = Vec::new();
        for start in 0..links.next.len() {
            let mut at = start;
            while cycle_of[at] == UNSEEN {
                cycle_of[at] = starts.len() as u32;
                at = links.next[at].index();
            }
            if cycle_of[start] == starts.len() as u32 {
                starts.push(HalfEdgeId(start as u32));
            }
        }
        Self { cycle_of, starts }
    }
}

/// Which face each cycle bounds, and the cycles of each face.
struct Faces {
    by_cycle: Vec<FaceId>,
    of_face: Vec<Vec<HalfEdgeId>>,
}

impl Faces {
    fn of(pieces: &[Piece], links: &Links, cycles: &Cycles, watch: &Watch<'_>) -> Result<Self, Stopped> {
        let mut by_cycle = vec![FaceId::OUTER; cycles.starts.len()];
        let mut of_face = vec![Vec::new()];
        let mut outlines = Vec::new();
        for (cycle, &start) in cycles.starts.iter().enumerate() {
            if doubled_area(links, start) > 0 {
                by_cycle[cycle] = FaceId(of_face.len() as u32);
                of_face.push(vec![start]);
            } else {
                outlines.push(cycle);
            }
        }
        // Starts ascend, so outlines ascend by their lowest vertex, and the face to the left of one is known already.
        let lowest: Vec<_> =
            outlines.iter().map(|&cycle| pieces[cycles.starts[cycle].edge().index()].segment.low).collect();
        for (&cycle, edge) in outlines.iter().zip(edges_to_the_left::find(pieces, &lowest, watch)?) {
            let face = edge.map_or(FaceId::OUTER, |edge| {
                // The face to the right of the edge is on the left of its downward half-edge.
                by_cycle[cycles.cycle_of[edge.forward().twin().index()] as usize]
            });
            by_cycle[cycle] = face;
            of_face[face.index()].push(cycles.starts[cycle]);
        }
        Ok(Self { by_cycle, of_face })
    }
}

/// Twice the signed area of a cycle in lattice units.
fn doubled_area(links: &Links, start: HalfEdgeId) -> i128 {
    let vertex = |half: HalfEdgeId| links.vertices[links.origins[half.index()].index()];
    let anchor = vertex(start);
    let mut area = 0;
    let mut at = start;
    loop {
        let next = links.next[at.index()];
        area += i128::from(cross(anchor.to(vertex(at)), anchor.to(vertex(next))));
        if next == start {
            return area;
        }
        at = next;
    }
}
