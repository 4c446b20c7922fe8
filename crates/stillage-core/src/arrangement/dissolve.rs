//! Joins faces: builds a subdivision without some of its edges.
//!
//! The other edges still meet only in their ends, so the half-edges are linked anew and all invariants hold by
//! construction; an edge that then has one face on both sides is dropped as well. Vertices, edges and faces are
//! numbered anew in the same canonical order. Cost: that of [`builder`].

use super::builder;
use super::ids::EdgeId;
use super::lattice::{LatticePoint, LatticeSegment};
use super::noding::Piece;
use super::subdivision::Subdivision;
use crate::watch::{Stopped, Watch};

impl Subdivision {
    /// The subdivision without the edges that `is_dissolved` names: the faces on their two sides are one. Without an
    /// edge of the outer boundary, the face behind it is part of the unbounded one.
    ///
    /// # Errors
    /// [`Stopped`] when the watch says so.
    pub fn dissolve(&self, is_dissolved: impl Fn(EdgeId) -> bool, watch: &Watch<'_>) -> Result<Self, Stopped> {
        let kept = self.edges().filter(|&edge| !is_dissolved(edge));
        builder::build(kept.map(|edge| self.piece(edge)).collect(), self.step, watch)
    }

    /// An edge on the lattice.
    pub(super) fn piece(&self, edge: EdgeId) -> Piece {
        let [low, high] = self.segment(edge).map(|point| LatticePoint::nearest(point, self.step));
        Piece { segment: LatticeSegment { low, high }, source: self.source(edge) }
    }
}
