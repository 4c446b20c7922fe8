//! The collections of a map by name.

/// A collection of features.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Collection {
    /// Faces of the subdivision, with their labels.
    Faces,
    /// Edges of the subdivision, with their cogency.
    Edges,
    /// Vertices of the subdivision.
    Vertices,
    /// Nodes of the adjacency graph.
    Nodes,
    /// Links of the adjacency graph, with their connectivity.
    Links,
    /// Lines that the subdivision was made from.
    Lines,
    /// Regions of one pattern.
    Regions,
    /// Rooms, and mutually open faces of one label, merged.
    Places,
    /// Narrow passages between places.
    Doors,
    /// Storage locations.
    Locations,
    /// Aisles between rows of locations.
    Aisles,
    /// Rows of locations along one side of an aisle.
    Rows,
}

impl Collection {
    /// All of them, in the order in which they are listed.
    pub const ALL: [Self; 12] = [
        Self::Faces,
        Self::Edges,
        Self::Vertices,
        Self::Nodes,
        Self::Links,
        Self::Lines,
        Self::Regions,
        Self::Places,
        Self::Doors,
        Self::Locations,
        Self::Aisles,
        Self::Rows,
    ];

    /// The id in URLs and file names.
    #[must_use]
    pub const fn id(self) -> &'static str {
        match self {
            Self::Faces => "faces",
            Self::Edges => "edges",
            Self::Vertices => "vertices",
            Self::Nodes => "nodes",
            Self::Links => "links",
            Self::Lines => "lines",
            Self::Regions => "regions",
            Self::Places => "places",
            Self::Doors => "doors",
            Self::Locations => "locations",
            Self::Aisles => "aisles",
            Self::Rows => "rows",
        }
    }

    /// The collection with an id.
    #[must_use]
    pub fn find(id: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|collection| collection.id() == id)
    }
}
