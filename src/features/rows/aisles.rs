//! Aisles: straight drivable ground with locations along it.

use stillage_core::layout::Aisle;

use super::common::{GROUPS, NAME};
use crate::features::geometry::{Geometry, GeometryType};
use crate::features::names::Naming;
use crate::features::property::{Kind, Property};
use crate::features::table::{Column, Table};
use crate::features::view::{AnalysedMap, rounded};

/// An aisle. Lengths in metres, codes from its start.
#[derive(Debug, Clone, PartialEq)]
pub struct AisleRow {
    /// Its number.
    pub id: u32,
    /// What people call it.
    pub naming: Naming,
    /// Length of its middle line.
    pub length: f64,
    /// Distance between its sides.
    pub width: f64,
    /// Where it points, degrees, `[-180, 180)`.
    pub heading: f64,
    /// Id of the place it runs through.
    pub place: u32,
    /// Codes of the locations on its left.
    pub left: Vec<String>,
    /// Codes of those on its right.
    pub right: Vec<String>,
}

/// The collection.
pub const TABLE: Table<AisleRow> = Table {
    title: "Aisles",
    description: "Aisles between rows of storage locations, as middle lines from their start",
    geometry: &[GeometryType::LineString],
    columns: &[
        Column::new(Property::new("id", Kind::Integer, "Id", "Number of the aisle, as in the codes"), |aisle| {
            aisle.id.into()
        }),
        Column::new(NAME, |aisle| aisle.naming.name.as_deref().into()),
        Column::new(GROUPS, |aisle| aisle.naming.groups.as_slice().into()),
        Column::new(Property::new("lengthM", Kind::Number, "Length", "Length of its middle line").unit("m"), |aisle| {
            aisle.length.into()
        }),
        Column::new(
            Property::new("widthM", Kind::Number, "Width", "Distance between the fronts of its two sides").unit("m"),
            |aisle| aisle.width.into(),
        ),
        Column::new(
            Property::new(
                "headingDeg",
                Kind::Number,
                "Heading",
                "Where it points, counter-clockwise from the map's x axis, from -180 to 180",
            )
            .unit("deg"),
            |aisle| aisle.heading.into(),
        ),
        Column::new(Property::new("place", Kind::Integer, "Place", "Id of the place it runs through"), |aisle| {
            aisle.place.into()
        }),
        Column::new(
            Property::new("left", Kind::Texts, "Left", "Codes of the locations on its left, from its start"),
            |aisle| aisle.left.as_slice().into(),
        ),
        Column::new(
            Property::new("right", Kind::Texts, "Right", "Codes of the locations on its right, from its start"),
            |aisle| aisle.right.as_slice().into(),
        ),
    ],
};

/// The aisles of a map, by number.
#[must_use]
pub fn read(view: &AnalysedMap<'_>) -> Vec<(Geometry, AisleRow)> {
    let row = |(index, aisle): (usize, &Aisle)| AisleRow {
        id: aisle.number,
        naming: view.names.aisle(index),
        length: rounded(aisle.length()),
        width: rounded(aisle.width),
        heading: view.heading_degrees(aisle.heading()),
        place: aisle.corridor,
        left: view.codes(&aisle.left),
        right: view.codes(&aisle.right),
    };
    let line = |aisle: &Aisle| Geometry::LineString(aisle.center_line.map(|end| view.position(end)).to_vec());
    view.layout.aisles.iter().enumerate().map(|(index, aisle)| (line(aisle), row((index, aisle)))).collect()
}
