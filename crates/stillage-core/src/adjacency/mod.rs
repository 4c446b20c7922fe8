//! The adjacency graph A = (nodes, links), dual of the subdivision (paper, II-B).
//!
//! The dual D is the identity on ids: node i is the dual of face i, link i of edge i, so D(D(x)) = x by construction.
//! Two faces that share several edges are joined by as many links (the author's code joins them by one), and no link
//! joins a node to itself, since every edge of a subdivision separates two faces.
//!
//! The position of a node is a point well inside its face: see [`pole()`]. Cost: O(edges), and the search for the
//! points.

mod pole;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

pub(crate) use pole::pole;

use crate::arrangement::{EdgeId, FaceId, Subdivision};
use crate::geometry::Point;
use crate::watch::{Stopped, Watch};

/// Dual graph of a subdivision: node i is the dual of face i, link i of edge i.
///
/// Edges on the outer boundary have no link. The unbounded face has no node (its entry is unused).
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct AdjacencyGraph {
    /// A point well inside each face, by face id (entry 0 unused), grid frame, metres.
    pub(crate) positions: Vec<Point>,
    /// Per face: (edge to cross, face behind it), ascending by edge.
    pub(crate) neighbors: Vec<Vec<(EdgeId, FaceId)>>,
}

impl AdjacencyGraph {
    /// Builds the dual.
    ///
    /// # Errors
    /// [`Stopped`] when the watch says so.
    pub fn dual(subdivision: &Subdivision, watch: &Watch<'_>) -> Result<Self, Stopped> {
        Self::with_positions(subdivision, |_| None, watch)
    }

    /// The dual of a redrawn subdivision; `known` are the positions of the faces that were not redrawn.
    ///
    /// # Errors
    /// [`Stopped`] when the watch says so.
    pub(crate) fn with_positions(
        subdivision: &Subdivision,
        known: impl Fn(FaceId) -> Option<Point> + Sync,
        watch: &Watch<'_>,
    ) -> Result<Self, Stopped> {
        let mut positions = vec![Point::origin(); subdivision.face_count()];
        positions.par_iter_mut().enumerate().skip(1).try_for_each(|(face, position)| {
            watch.check()?;
            let face = FaceId(face as u32);
            *position = known(face).unwrap_or_else(|| pole(&subdivision.rings(face)));
            Ok(())
        })?;
        let mut neighbors = vec![Vec::new(); subdivision.face_count()];
        for edge in subdivision.edges() {
            let [left, right] = subdivision.sides(edge);
            if left != FaceId::OUTER && right != FaceId::OUTER {
                neighbors[left.index()].push((edge, right));
                neighbors[right.index()].push((edge, left));
            }
        }
        Ok(Self { positions, neighbors })
    }

    /// A point well inside a face.
    #[must_use]
    pub fn position(&self, face: FaceId) -> Point {
        self.positions[face.index()]
    }

    /// The links of a node: (edge to cross, face behind it), ascending by edge.
    #[must_use]
    pub fn links(&self, face: FaceId) -> &[(EdgeId, FaceId)] {
        &self.neighbors[face.index()]
    }
}

#[cfg(test)]
mod tests;
