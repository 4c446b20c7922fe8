//! The collections of an analysed map as typed data: what they are, their rows and shapes, and the query on them.
//!
//! | file | what it has |
//! | --- | --- |
//! | `collection` | the collections by name |
//! | `schema`, `property` | title, description, shapes and properties of a collection |
//! | `rows` | a file for each collection: its columns, and how its rows are read off a map |
//! | `feature`, `id`, `geometry`, `value`, `words` | one feature |
//! | `names` | what people call the things of a map |
//! | `query` | which features: by ids, by a box, in which order, page by page; which of their properties |
//! | `view`, `shape`, `rings` | the map that is read; outlines of faces and of what they make up |
//!
//! A [`Feature`] carries its shape in map-frame metres. What all properties have in common: lengths are metres and
//! areas square metres; orientations and headings are degrees counter-clockwise from the map's x axis (orientations of
//! undirected lines in [-90, 90), headings in [-180, 180)); positions among the properties are map-frame metres.
//! Numbers are rounded to four decimals: a tenth of a millimetre.
//!
//! Pure: nothing here knows HTTP or how a feature is written. O(size of the collection).

mod collection;
mod feature;
mod geometry;
mod id;
mod names;
mod property;
pub mod query;
mod rings;
pub mod rows;
mod schema;
mod shape;
mod table;
mod value;
mod view;
pub(crate) mod words;

#[cfg(test)]
pub(crate) mod tests;

pub use collection::Collection;
pub use feature::{Feature, Row};
pub use geometry::{Geometry, GeometryType, Ring};
pub use id::FeatureId;
pub use names::{MapNames, Naming};
pub use property::{Kind, Property};
pub use schema::CollectionSchema;
pub use shape::place_shape;
pub use value::{BoxValue, Pose, Value};
pub use view::{AnalysedMap, LabelWords, rounded};

/// The features of a collection, by id.
#[must_use]
pub fn features(view: &AnalysedMap<'_>, collection: Collection) -> Vec<Feature> {
    match collection {
        Collection::Faces => wrap(rows::faces::read(view), Row::Face),
        Collection::Edges => wrap(rows::edges::read(view), Row::Edge),
        Collection::Vertices => wrap(rows::vertices::read(view), Row::Vertex),
        Collection::Nodes => wrap(rows::nodes::read(view), Row::Node),
        Collection::Links => wrap(rows::links::read(view), Row::Link),
        Collection::Lines => wrap(rows::lines::read(view), Row::Line),
        Collection::Regions => wrap(rows::regions::read(view), Row::Region),
        Collection::Places => wrap(rows::places::read(view), Row::Place),
        Collection::Doors => wrap(rows::doors::read(view), Row::Door),
        Collection::Locations => wrap(rows::locations::read(view), Row::Location),
        Collection::Aisles => wrap(rows::aisles::read(view), Row::Aisle),
        Collection::Rows => wrap(rows::storage_rows::read(view), Row::StorageRow),
    }
}

fn wrap<R>(rows: Vec<(Geometry, R)>, row: impl Fn(R) -> Row) -> Vec<Feature> {
    rows.into_iter().map(|(geometry, each)| Feature::new(geometry, row(each))).collect()
}
