//! Rows: storage locations side by side along one side of an aisle.

use stillage_core::layout::Row;

use super::common::{GROUPS, NAME};
use crate::features::geometry::{Geometry, GeometryType};
use crate::features::names::Naming;
use crate::features::property::{Kind, Property};
use crate::features::table::{Column, Table};
use crate::features::view::{AnalysedMap, rounded};
use crate::features::words;

/// A row of locations. Lengths in metres, codes from the start of its aisle.
#[derive(Debug, Clone, PartialEq)]
pub struct StorageRow {
    /// Its number.
    pub id: u32,
    /// What people call it.
    pub naming: Naming,
    /// Number of its aisle.
    pub aisle: u32,
    /// `left` or `right` of the aisle.
    pub side: &'static str,
    /// Length of its middle line.
    pub length: f64,
    /// Extent away from the aisle.
    pub depth: f64,
    /// How many places lie one behind the other.
    pub layers: u32,
    /// Codes of its locations.
    pub locations: Vec<String>,
}

/// The collection.
pub const TABLE: Table<StorageRow> = Table {
    title: "Rows",
    description: "Rows of storage locations along one side of an aisle, as middle lines",
    geometry: &[GeometryType::LineString],
    columns: &[
        Column::new(Property::new("id", Kind::Integer, "Id", "Number of the row"), |row| row.id.into()),
        Column::new(NAME, |row| row.naming.name.as_deref().into()),
        Column::new(GROUPS, |row| row.naming.groups.as_slice().into()),
        Column::new(Property::new("aisle", Kind::Integer, "Aisle", "Number of the aisle it is reached from"), |row| {
            row.aisle.into()
        }),
        Column::new(
            Property::new("side", Kind::Word(words::SIDES), "Side", "Side of the aisle, along its direction"),
            |row| row.side.into(),
        ),
        Column::new(Property::new("lengthM", Kind::Number, "Length", "Length of its middle line").unit("m"), |row| {
            row.length.into()
        }),
        Column::new(Property::new("depthM", Kind::Number, "Depth", "Extent away from its aisle").unit("m"), |row| {
            row.depth.into()
        }),
        Column::new(
            Property::new("layers", Kind::Integer, "Layers", "How many locations lie one behind the other"),
            |row| row.layers.into(),
        ),
        Column::new(
            Property::new(
                "locations",
                Kind::Texts,
                "Locations",
                "Codes of its locations, from the start of the aisle; those behind others follow them",
            ),
            |row| row.locations.as_slice().into(),
        ),
    ],
};

/// The rows of a map, by number.
#[must_use]
pub fn read(view: &AnalysedMap<'_>) -> Vec<(Geometry, StorageRow)> {
    let record = |(index, row): (usize, &Row)| StorageRow {
        id: row.number,
        naming: view.names.row(index),
        aisle: row.aisle,
        side: words::side(row.side),
        length: rounded(row.length()),
        depth: rounded(row.depth),
        layers: row.layers,
        locations: view.codes(&row.locations),
    };
    let line = |row: &Row| Geometry::LineString(row.center_line.map(|end| view.position(end)).to_vec());
    view.layout.rows.iter().enumerate().map(|(index, row)| (line(row), record((index, row)))).collect()
}
