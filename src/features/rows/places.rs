//! Places.

use std::sync::Arc;

use stillage_core::semantics::Place;

use super::common::{FUNCTIONALITY, GROUPS, LABEL_NAME, NAME};
use crate::features::geometry::{Geometry, GeometryType};
use crate::features::names::Naming;
use crate::features::property::{Kind, Property};
use crate::features::shape;
use crate::features::table::{Column, Table};
use crate::features::view::{AnalysedMap, LabelWords, rounded};

/// A place.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaceRow {
    id: u32,
    naming: Naming,
    label: Arc<LabelWords>,
    area: f64,
    room: Option<u32>,
    faces: Vec<u32>,
}

/// The collection.
pub const TABLE: Table<PlaceRow> = Table {
    title: "Places",
    description: "Rooms, and mutually open faces of one label, merged: corridors, junctions, blocks",
    geometry: GeometryType::AREAS,
    columns: &[
        Column::new(Property::new("id", Kind::Integer, "Id", "Number of the place"), |place| place.id.into()),
        Column::new(NAME, |place| place.naming.name.as_deref().into()),
        Column::new(GROUPS, |place| place.naming.groups.as_slice().into()),
        Column::new(
            Property::new("label", Kind::Text, "Label", "Id of the label; of a room that of most of its area"),
            |place| place.label.id.as_str().into(),
        ),
        Column::new(LABEL_NAME, |place| place.label.name.as_str().into()),
        Column::new(FUNCTIONALITY, |place| place.label.functionality.as_slice().into()),
        Column::new(Property::new("areaM2", Kind::Number, "Area", "Area").unit("m2"), |place| place.area.into()),
        Column::new(
            Property::new("room", Kind::Integer, "Room", "Number of the room it is, if walls bound it").nullable(),
            |place| place.room.into(),
        ),
        Column::new(Property::new("faces", Kind::Integers, "Faces", "Ids of its faces, ascending"), |place| {
            place.faces.as_slice().into()
        }),
    ],
};

/// The places of a map, by id.
#[must_use]
pub fn read(view: &AnalysedMap<'_>) -> Vec<(Geometry, PlaceRow)> {
    let labels = view.labels();
    let row = |(index, place): (usize, &Place)| {
        let id = index as u32;
        let geometry = shape::place_shape(view, id);
        let row = PlaceRow {
            id,
            naming: view.names.place(index),
            label: labels.of(place.label),
            area: rounded(place.area),
            room: place.room,
            faces: place.faces.iter().map(|face| face.0).collect(),
        };
        (geometry, row)
    };
    view.semantic.places.iter().enumerate().map(row).collect()
}
