//! What is known of a collection before any feature of it is seen.

use std::sync::LazyLock;

use super::collection::Collection;
use super::geometry::GeometryType;
use super::id::FeatureId;
use super::property::Property;
use super::rows::{
    aisles, doors, edges, faces, lines, links, locations, nodes, places, regions, storage_rows, vertices,
};
use super::table::Table;

/// What the features of a collection are.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CollectionSchema {
    /// Name for people.
    pub title: &'static str,
    /// What its features are.
    pub description: &'static str,
    /// The shapes that its features have.
    pub geometry: &'static [GeometryType],
    /// Their properties, in the order in which they are written; the first is the id.
    pub properties: Vec<Property>,
}

/// The schemas, in the order of [`Collection::ALL`].
static SCHEMAS: LazyLock<[CollectionSchema; Collection::ALL.len()]> = LazyLock::new(|| {
    Collection::ALL.map(|collection| match collection {
        Collection::Faces => schema(&faces::TABLE),
        Collection::Edges => schema(&edges::TABLE),
        Collection::Vertices => schema(&vertices::TABLE),
        Collection::Nodes => schema(&nodes::TABLE),
        Collection::Links => schema(&links::TABLE),
        Collection::Lines => schema(&lines::TABLE),
        Collection::Regions => schema(&regions::TABLE),
        Collection::Places => schema(&places::TABLE),
        Collection::Doors => schema(&doors::TABLE),
        Collection::Locations => schema(&locations::TABLE),
        Collection::Aisles => schema(&aisles::TABLE),
        Collection::Rows => schema(&storage_rows::TABLE),
    })
});

fn schema<R>(table: &Table<R>) -> CollectionSchema {
    CollectionSchema {
        title: table.title,
        description: table.description,
        geometry: table.geometry,
        properties: table.columns.iter().map(|column| column.property).collect(),
    }
}

impl CollectionSchema {
    /// The schema of a collection.
    #[must_use]
    pub fn of(collection: Collection) -> &'static Self {
        &SCHEMAS[collection as usize]
    }

    /// The index of a property.
    #[must_use]
    pub fn find(&self, name: &str) -> Option<usize> {
        self.properties.iter().position(|property| property.name == name)
    }

    /// Reads the id of a feature.
    ///
    /// # Errors
    /// What is wrong with the text, to be put after its name.
    pub fn feature_id(&self, text: &str) -> Result<FeatureId, &'static str> {
        FeatureId::read(text, self.properties[0].kind)
    }
}
