//! The adjacency graph A = (nodes, links), dual of the subdivision. (to be written)
use crate::arrangement::{EdgeId, FaceId, Subdivision};
use crate::geometry::Point;
use serde::{Deserialize, Serialize};

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
    #[must_use]
    pub fn dual(subdivision: &Subdivision) -> Self {
        let _ = subdivision;
        todo!()
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
