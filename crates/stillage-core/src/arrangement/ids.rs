//! Typed indices of a subdivision. Two half-edges of an edge differ in the lowest bit.

use serde::{Deserialize, Serialize};

macro_rules! id {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
        #[serde(transparent)]
        pub struct $name(pub u32);

        impl $name {
            /// The id as an index.
            #[must_use]
            pub const fn index(self) -> usize {
                self.0 as usize
            }
        }

        impl std::fmt::Display for $name {
            fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                self.0.fmt(formatter)
            }
        }
    };
}

id!(
    /// A vertex.
    VertexId
);
id!(
    /// An undirected edge. Link `i` of the adjacency graph is the dual of edge `i`.
    EdgeId
);
id!(
    /// One direction of an edge; its face lies on the left.
    HalfEdgeId
);
id!(
    /// A face. Node `i` of the adjacency graph is the dual of face `i`.
    FaceId
);

impl HalfEdgeId {
    /// The same edge in the other direction.
    #[must_use]
    pub const fn twin(self) -> Self {
        Self(self.0 ^ 1)
    }

    /// The edge of this half-edge.
    #[must_use]
    pub const fn edge(self) -> EdgeId {
        EdgeId(self.0 >> 1)
    }
}

impl EdgeId {
    /// The half-edge from the edge's first vertex to its second.
    #[must_use]
    pub const fn forward(self) -> HalfEdgeId {
        HalfEdgeId(self.0 << 1)
    }
}

impl FaceId {
    /// The unbounded face.
    pub const OUTER: Self = Self(0);
}
