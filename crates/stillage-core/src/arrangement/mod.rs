//! The subdivision of the plane by a set of segments (paper, II-B: S = (Vertices, Edges, Faces)).
//!
//! ```text
//! tiles and lines ── sources ── SourceSegment ── lattice ── noding ── builder ── Subdivision ── cell_faces
//!                               metres           integers   pieces    half-edges                face of every cell
//! ```
//!
//! Input is rounded to an integer lattice once, noded by iterated snap rounding and linked into a doubly connected edge
//! list. All decisions are exact integer arithmetic, so no input makes it fail and the order of the input does not
//! matter. The author's code intersects all pairs symbolically instead and compares tangent angles as floating-point
//! numbers, which fails for near parallels and coincident lines; [`noding`] describes what happens to them here.
//!
//! Cost: O(n + k log k) for n segments with k crossings spread over the map.

mod buckets;
mod builder;
mod cell_faces;
mod cell_overlap;
mod dissolve;
mod edges_to_the_left;
mod face_at;
mod ids;
mod invariants;
mod kept_parts;
mod lattice;
mod noding;
mod redrawing;
mod sources;
mod subdivision;

#[cfg(test)]
mod cell_faces_tests;
#[cfg(test)]
mod golden_tests;
#[cfg(test)]
mod tests;

pub use cell_faces::CellFaces;
pub(crate) use kept_parts::KeptParts;
pub(crate) use redrawing::Redrawing;

pub use cell_overlap::CellOverlap;
pub use ids::{EdgeId, FaceId, HalfEdgeId, VertexId};
pub use sources::{SourceSegment, source_segments};
pub use subdivision::{EdgeSource, HalfEdge, Subdivision};

use crate::watch::{Stopped, Watch};
use lattice::{LatticePoint, LatticeSegment};
use noding::Piece;

/// Subdivides the plane by segments.
///
/// The edges of the result meet only in their ends and each separates two faces: a segment, or a part of one, that has
/// a loose end or bounds nothing is dropped. Where segments coincide, the edge gets the least of their sources.
/// Segments shorter than the lattice step (61 micrometres, more for maps above 16 km) and those without finite ends are
/// dropped too.
///
/// # Errors
/// [`Stopped`] when the watch says so.
pub fn arrange(segments: &[SourceSegment], watch: &Watch<'_>) -> Result<Subdivision, Stopped> {
    let (pieces, step) = snap(segments);
    let pieces = noding::node(pieces, watch)?;
    builder::build(pieces, step, watch)
}

/// Rounds segments to the lattice; also answers its step in metres.
fn snap(segments: &[SourceSegment]) -> (Vec<Piece>, f64) {
    let coordinates = |segment: &SourceSegment| [segment.start.x, segment.start.y, segment.end.x, segment.end.y];
    let is_finite = |segment: &&SourceSegment| coordinates(segment).iter().all(|coordinate| coordinate.is_finite());
    let finite = || segments.iter().filter(is_finite);
    let step = lattice::step_for(finite().flat_map(coordinates).map(f64::abs).fold(0.0, f64::max));
    let piece = |segment: &SourceSegment| {
        let end = |point| LatticePoint::nearest(point, step);
        let source = segment.source;
        LatticeSegment::between(end(segment.start), end(segment.end)).map(|segment| Piece { segment, source })
    };
    (finite().filter_map(piece).collect(), step)
}
