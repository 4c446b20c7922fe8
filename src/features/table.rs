//! A collection as a table: its columns, each with the way to read it from a row.

use super::geometry::GeometryType;
use super::property::Property;
use super::value::Value;

/// What a collection is and which properties its rows have.
#[derive(Debug)]
pub struct Table<R: 'static> {
    /// Name for people.
    pub title: &'static str,
    /// What its features are.
    pub description: &'static str,
    /// The shapes that its features have.
    pub geometry: &'static [GeometryType],
    /// Its properties, in the order in which they are written; the first is the id.
    pub columns: &'static [Column<R>],
}

/// A property of a row.
#[derive(Debug)]
pub struct Column<R> {
    /// What is known of it.
    pub property: Property,
    /// Reads it.
    pub value: for<'a> fn(&'a R) -> Value<'a>,
}

impl<R> Column<R> {
    /// A property and the way to read it.
    pub const fn new(property: Property, value: for<'a> fn(&'a R) -> Value<'a>) -> Self {
        Self { property, value }
    }
}
