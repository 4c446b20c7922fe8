//! A feature: the row of a collection with its id and its shape.

use stillage_core::geometry::Bounds;

use super::collection::Collection;
use super::geometry::Geometry;
use super::id::FeatureId;
use super::rows::{
    aisles, doors, edges, faces, lines, links, locations, nodes, places, regions, storage_rows, vertices,
};
use super::schema::CollectionSchema;
use super::value::Value;

/// A feature in map-frame metres.
#[derive(Debug, Clone, PartialEq)]
pub struct Feature {
    /// Unique in its collection.
    pub id: FeatureId,
    /// The box around its shape.
    pub bounds: Bounds,
    /// Its shape.
    pub geometry: Geometry,
    /// What is known of it.
    pub row: Row,
}

/// What is known of a feature: one type of row for each collection.
#[derive(Debug, Clone, PartialEq)]
#[allow(missing_docs, reason = "each is the row of the collection of its name")]
pub enum Row {
    Face(faces::FaceRow),
    Edge(edges::EdgeRow),
    Vertex(vertices::VertexRow),
    Node(nodes::NodeRow),
    Link(links::LinkRow),
    Line(lines::LineRow),
    Region(regions::RegionRow),
    Place(places::PlaceRow),
    Door(doors::DoorRow),
    Location(locations::LocationRow),
    Aisle(aisles::AisleRow),
    StorageRow(storage_rows::StorageRow),
}

impl Row {
    /// The collection it belongs to.
    #[must_use]
    pub const fn collection(&self) -> Collection {
        match self {
            Self::Face(_) => Collection::Faces,
            Self::Edge(_) => Collection::Edges,
            Self::Vertex(_) => Collection::Vertices,
            Self::Node(_) => Collection::Nodes,
            Self::Link(_) => Collection::Links,
            Self::Line(_) => Collection::Lines,
            Self::Region(_) => Collection::Regions,
            Self::Place(_) => Collection::Places,
            Self::Door(_) => Collection::Doors,
            Self::Location(_) => Collection::Locations,
            Self::Aisle(_) => Collection::Aisles,
            Self::StorageRow(_) => Collection::Rows,
        }
    }

    /// The value of a property, by its index in the schema.
    ///
    /// # Panics
    /// Where the schema has no such property.
    #[must_use]
    pub fn value(&self, index: usize) -> Value<'_> {
        match self {
            Self::Face(row) => (faces::TABLE.columns[index].value)(row),
            Self::Edge(row) => (edges::TABLE.columns[index].value)(row),
            Self::Vertex(row) => (vertices::TABLE.columns[index].value)(row),
            Self::Node(row) => (nodes::TABLE.columns[index].value)(row),
            Self::Link(row) => (links::TABLE.columns[index].value)(row),
            Self::Line(row) => (lines::TABLE.columns[index].value)(row),
            Self::Region(row) => (regions::TABLE.columns[index].value)(row),
            Self::Place(row) => (places::TABLE.columns[index].value)(row),
            Self::Door(row) => (doors::TABLE.columns[index].value)(row),
            Self::Location(row) => (locations::TABLE.columns[index].value)(row),
            Self::Aisle(row) => (aisles::TABLE.columns[index].value)(row),
            Self::StorageRow(row) => (storage_rows::TABLE.columns[index].value)(row),
        }
    }
}

impl Feature {
    /// A feature with its id, which is the first property of its row, and the box around it.
    #[must_use]
    pub fn new(geometry: Geometry, row: Row) -> Self {
        let id = match row.value(0) {
            Value::Integer(number) => FeatureId::Number(number),
            Value::Text(text) => FeatureId::Text(text.to_owned()),
            other => unreachable!("the first property of a row is its id, and {other:?} is none"),
        };
        Self { id, bounds: geometry.bounds(), geometry, row }
    }

    /// The value of a property; `None` where its collection has no such property.
    #[must_use]
    pub fn property(&self, name: &str) -> Option<Value<'_>> {
        CollectionSchema::of(self.row.collection()).find(name).map(|index| self.row.value(index))
    }
}
