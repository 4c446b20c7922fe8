//! Storage locations.

use std::sync::Arc;

use stillage_core::layout::{ApproachPose, Location};

use super::common::{GROUPS, LABEL, LABEL_NAME, NAME};
use crate::features::geometry::{Geometry, GeometryType};
use crate::features::names::Naming;
use crate::features::property::{Kind, Property};
use crate::features::rings::polygons;
use crate::features::shape;
use crate::features::table::{Column, Table};
use crate::features::value::Pose;
use crate::features::view::{AnalysedMap, LabelWords, rounded};
use crate::features::words;

/// A storage location. Positions and lengths in metres of the map frame.
#[derive(Debug, Clone, PartialEq)]
pub struct LocationRow {
    /// Its id: `aisle-bay`.
    pub code: String,
    /// What people call it.
    pub naming: Naming,
    /// Whether its code waits for a person to confirm it.
    pub stale: bool,
    /// Id of its face.
    pub face: u32,
    /// Which part of the face it is.
    pub part: u32,
    /// Of how many parts its face is.
    pub parts: u32,
    /// Its label.
    pub label: Arc<LabelWords>,
    /// Number of its aisle, 0 without one.
    pub aisle: u32,
    /// Number of its bay in the aisle.
    pub bay: u32,
    /// Number of its row, 0 without one.
    pub row: u32,
    /// How deep in the row it lies, from 1.
    pub depth_in_row: u32,
    /// `left` or `right` of the aisle.
    pub side: Option<&'static str>,
    /// x and y of its centre.
    pub centre: [f64; 2],
    /// Extent along the access edge.
    pub width: f64,
    /// Extent away from the access edge.
    pub depth: f64,
    /// Direction from the access edge into it, degrees, `[-180, 180)`.
    pub heading: f64,
    /// Square metres.
    pub area: f64,
    /// `occupied`, `empty` or `unknown`.
    pub occupancy: &'static str,
    /// Share of its known cells that are occupied.
    pub occupied: f64,
    /// How sure the occupancy is.
    pub occupancy_confidence: f64,
    /// Ids of the edges through which it is reached, the best first.
    pub access_edges: Vec<u32>,
    /// Id of the drivable face before the best access edge.
    pub access_from: Option<u32>,
    /// Id of the place before it.
    pub corridor: Option<u32>,
    /// Where a vehicle stands to reach it.
    pub approach: Option<Pose>,
}

/// The collection.
pub const TABLE: Table<LocationRow> = Table {
    title: "Locations",
    description: "Storage locations with code, aisle, bay, occupancy and approach",
    geometry: GeometryType::AREAS,
    columns: &[
        Column::new(Property::new("code", Kind::Text, "Code", "Aisle and bay, unique in the map"), |location| {
            location.code.as_str().into()
        }),
        Column::new(NAME, |location| location.naming.name.as_deref().into()),
        Column::new(GROUPS, |location| location.naming.groups.as_slice().into()),
        Column::new(
            Property::new("stale", Kind::Boolean, "Stale", "Whether its code waits for a person to confirm it"),
            |location| location.stale.into(),
        ),
        Column::new(Property::new("face", Kind::Integer, "Face", "Id of its face"), |location| location.face.into()),
        Column::new(
            Property::new("part", Kind::Integer, "Part", "Which part of its face it is, from 0; 0 for a whole face"),
            |location| location.part.into(),
        ),
        Column::new(
            Property::new("parts", Kind::Integer, "Parts", "Of how many parts its face is; 1 for a whole face"),
            |location| location.parts.into(),
        ),
        Column::new(LABEL, |location| location.label.id.as_str().into()),
        Column::new(LABEL_NAME, |location| location.label.name.as_str().into()),
        Column::new(
            Property::new("aisle", Kind::Integer, "Aisle", "Number of its aisle; 0 without access"),
            |location| location.aisle.into(),
        ),
        Column::new(
            Property::new("bay", Kind::Integer, "Bay", "Number in its aisle: odd on the left, even on the right"),
            |location| location.bay.into(),
        ),
        Column::new(Property::new("row", Kind::Integer, "Row", "Number of its row; 0 without access"), |location| {
            location.row.into()
        }),
        Column::new(
            Property::new("depthInRow", Kind::Integer, "Depth in row", "1 at the aisle, 2 behind that, and so on"),
            |location| location.depth_in_row.into(),
        ),
        Column::new(
            Property::new("side", Kind::Word(words::SIDES), "Side", "Side of the aisle, along its direction")
                .nullable(),
            |location| location.side.into(),
        ),
        Column::new(Property::new("centre", Kind::Position, "Centre", "Its centre, map frame").unit("m"), |location| {
            location.centre.into()
        }),
        Column::new(
            Property::new("widthM", Kind::Number, "Width", "Extent along its access edge").unit("m"),
            |location| location.width.into(),
        ),
        Column::new(
            Property::new("depthM", Kind::Number, "Depth", "Extent away from its access edge").unit("m"),
            |location| location.depth.into(),
        ),
        Column::new(
            Property::new(
                "headingDeg",
                Kind::Number,
                "Heading",
                "Direction from the access edge into it, counter-clockwise from the map's x axis, from -180 to 180",
            )
            .unit("deg"),
            |location| location.heading.into(),
        ),
        Column::new(Property::new("areaM2", Kind::Number, "Area", "Its area").unit("m2"), |location| {
            location.area.into()
        }),
        Column::new(
            Property::new(
                "occupancy",
                Kind::Word(words::OCCUPANCY),
                "Occupancy",
                "Whether goods were seen in it, none were seen, or nobody looked",
            ),
            |location| location.occupancy.into(),
        ),
        Column::new(
            Property::new(
                "occupiedFraction",
                Kind::Number,
                "Occupied fraction",
                "Share of its known cells that are occupied, away from its border",
            ),
            |location| location.occupied.into(),
        ),
        Column::new(
            Property::new(
                "occupancyConfidence",
                Kind::Number,
                "Occupancy confidence",
                "How surely the occupancy is told, from 0 to 1",
            ),
            |location| location.occupancy_confidence.into(),
        ),
        Column::new(
            Property::new(
                "accessEdges",
                Kind::Integers,
                "Access edges",
                "Ids of the edges through which it is reached, the best first",
            ),
            |location| location.access_edges.as_slice().into(),
        ),
        Column::new(
            Property::new(
                "accessFrom",
                Kind::Integer,
                "Access from",
                "Id of the drivable face before the best access edge",
            )
            .nullable(),
            |location| location.access_from.into(),
        ),
        Column::new(
            Property::new(
                "corridor",
                Kind::Integer,
                "Corridor",
                "Id of the place before it: a corridor, a junction, a room",
            )
            .nullable(),
            |location| location.corridor.into(),
        ),
        Column::new(
            Property::new(
                "approach",
                Kind::Pose,
                "Approach",
                "Where a vehicle stands to reach it, map frame; none where it finds no room",
            )
            .nullable(),
            |location| location.approach.into(),
        ),
    ],
};

/// The storage locations of a map, by code.
#[must_use]
pub fn read(view: &AnalysedMap<'_>) -> Vec<(Geometry, LocationRow)> {
    let labels = view.labels();
    let approach = |pose: ApproachPose| {
        let [x, y] = view.rounded_position(pose.position);
        Pose { x, y, heading_deg: view.heading_degrees(pose.heading) }
    };
    let row = |(index, location): (usize, &Location)| LocationRow {
        code: location.code.clone(),
        naming: view.names.location(index),
        stale: view.names.is_stale(index),
        face: location.face.0,
        part: location.part,
        parts: location.parts,
        label: labels.of(location.label),
        aisle: location.aisle,
        bay: location.bay,
        row: location.row,
        depth_in_row: location.depth_in_row,
        side: location.side.map(words::side),
        centre: view.rounded_position(location.center),
        width: rounded(location.width),
        depth: rounded(location.depth),
        heading: view.heading_degrees(location.heading),
        area: rounded(location.area),
        occupancy: words::occupancy(location.occupancy.state),
        occupied: rounded(location.occupancy.fraction),
        occupancy_confidence: rounded(location.occupancy.confidence),
        access_edges: location.access_edges.iter().map(|edge| edge.0).collect(),
        access_from: location.access_from.map(|face| face.0),
        corridor: location.corridor,
        approach: location.approach.map(approach),
    };
    let shape = |location: &Location| {
        let outline = location.outline.iter().map(|&point| view.position(point)).collect();
        if location.parts > 1 { Geometry::area(polygons(vec![outline])) } else { shape::of_face(view, location.face) }
    };
    let mut rows: Vec<_> = view
        .layout
        .locations
        .iter()
        .enumerate()
        .map(|(index, location)| (shape(location), row((index, location))))
        .collect();
    // Codes come from the registry of the site, not from where a location lies.
    rows.sort_by(|(_, one), (_, other)| one.code.cmp(&other.code));
    rows
}
