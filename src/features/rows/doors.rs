//! Doors between places.

use stillage_core::rooms::Door;

use crate::features::geometry::{Geometry, GeometryType};
use crate::features::property::{Kind, Property};
use crate::features::table::{Column, Table};
use crate::features::view::{AnalysedMap, rounded};

/// A door.
#[derive(Debug, Clone, PartialEq)]
pub struct DoorRow {
    id: u32,
    width: f64,
    /// The places on both sides.
    sides: [Option<u32>; 2],
    links: Vec<u32>,
}

/// The collection.
pub const TABLE: Table<DoorRow> = Table {
    title: "Doors",
    description: "Narrow passages between two places, from jamb to jamb",
    geometry: &[GeometryType::LineString],
    columns: &[
        Column::new(Property::new("id", Kind::Integer, "Id", "Number of the door"), |door| door.id.into()),
        Column::new(Property::new("widthM", Kind::Number, "Width", "Distance between the jambs").unit("m"), |door| {
            door.width.into()
        }),
        Column::new(Property::new("from", Kind::Integer, "From", "Id of the place on one side").nullable(), |door| {
            door.sides[0].into()
        }),
        Column::new(Property::new("to", Kind::Integer, "To", "Id of the place on the other side").nullable(), |door| {
            door.sides[1].into()
        }),
        Column::new(Property::new("links", Kind::Integers, "Links", "Ids of the links that lead through it"), |door| {
            door.links.as_slice().into()
        }),
    ],
};

/// The doors of a map, by id.
#[must_use]
pub fn read(view: &AnalysedMap<'_>) -> Vec<(Geometry, DoorRow)> {
    let row = |(index, door): (usize, &Door)| {
        let row = DoorRow {
            id: index as u32,
            width: rounded(door.width()),
            sides: door.faces.map(|face| view.semantic.face_places[face.index()]),
            links: door.edges.iter().filter(|&&edge| view.has_link(edge)).map(|edge| edge.0).collect(),
        };
        (Geometry::LineString(door.ends.map(|end| view.position(end)).to_vec()), row)
    };
    view.analysis.rooms.doors.iter().enumerate().map(row).collect()
}
