//! Storage locations as rows of tables: what the profiles of inventory systems and spreadsheets read.

use stillage_core::layout::Location;

use super::source::ExportSource;
use crate::features::{Value, rounded, words};

/// Names of the inventory system that a map does not know.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct InventoryOptions {
    /// Name of the warehouse: parent location in Odoo (`WH/Stock`), warehouse number in SAP EWM (4 characters),
    /// location code in Business Central.
    pub warehouse: String,
    /// Storage type in SAP EWM (4 characters), zone code in Business Central.
    pub storage_type: String,
}

impl Default for InventoryOptions {
    /// Names that importers take; clients give those of their site.
    fn default() -> Self {
        Self { warehouse: "WH".to_owned(), storage_type: "BULK".to_owned() }
    }
}

/// A location with what columns read.
#[derive(Debug, Clone, Copy)]
pub(super) struct LocationLine<'a> {
    pub options: &'a InventoryOptions,
    pub location: &'a Location,
    pub label: &'a str,
    /// Map frame, metres.
    pub center: [f64; 2],
    /// Map frame, degrees.
    pub heading: f64,
    /// x and y in metres, heading in degrees.
    pub approach: Option<[f64; 3]>,
    /// Name of the node that serves it.
    pub node: Option<&'a str>,
}

/// Name of a column, and how its value is read.
pub(super) type SheetColumn = (&'static str, for<'a> fn(&'a LocationLine<'a>) -> Value<'a>);

/// All that is known of a location. Importers rely on the order: new columns come last.
pub(super) const ALL: &[SheetColumn] = &[
    ("code", |line| line.location.code.as_str().into()),
    ("label", |line| line.label.into()),
    ("aisle", |line| line.location.aisle.into()),
    ("bay", |line| line.location.bay.into()),
    ("side", |line| line.location.side.map(words::side).into()),
    ("row", |line| line.location.row.into()),
    ("depthInRow", |line| line.location.depth_in_row.into()),
    ("x", |line| line.center[0].into()),
    ("y", |line| line.center[1].into()),
    ("widthM", |line| rounded(line.location.width).into()),
    ("depthM", |line| rounded(line.location.depth).into()),
    ("areaM2", |line| rounded(line.location.area).into()),
    ("headingDeg", |line| line.heading.into()),
    ("occupancy", |line| words::occupancy(line.location.occupancy.state).into()),
    ("occupancyConfidence", |line| rounded(line.location.occupancy.confidence).into()),
    ("approachX", |line| line.approach.map(|pose| pose[0]).into()),
    ("approachY", |line| line.approach.map(|pose| pose[1]).into()),
    ("approachHeadingDeg", |line| line.approach.map(|pose| pose[2]).into()),
    ("node", |line| line.node.into()),
];

/// A line for each location of a map, by code.
pub(super) fn lines<'a>(source: &ExportSource<'a>, options: &'a InventoryOptions) -> Vec<LocationLine<'a>> {
    let line = |(location, node): (&'a Location, Option<usize>)| LocationLine {
        options,
        location,
        label: source.location_label(location),
        center: source.position(location.center),
        heading: source.heading_degrees(location.heading),
        approach: location.approach.map(|pose| {
            let [x, y] = source.position(pose.position);
            [x, y, source.heading_degrees(pose.heading)]
        }),
        node: node.map(|index| source.graph.nodes[index].name.as_str()),
    };
    source.layout.locations.iter().zip(source.serving_nodes()).map(line).collect()
}
