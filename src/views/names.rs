//! Names that people bring along.
#![allow(dead_code, reason = "the bodies describe what the ingest reads")]

use serde::Serialize;
use utoipa::ToSchema;

use crate::app::{NameChange, NameReport};
use crate::ingest::NamedCollection;

/// Labelled polygons: a GeoJSON feature collection.
#[derive(Debug, ToSchema)]
#[schema(as = NamedPolygons)]
pub struct NamedPolygonsBody {
    #[schema(example = "FeatureCollection")]
    r#type: String,
    features: Vec<NamedPolygon>,
}

/// An area with what it is called.
#[derive(Debug, ToSchema)]
pub struct NamedPolygon {
    #[schema(example = "Feature")]
    r#type: String,
    properties: NamedPolygonProperties,
    /// A polygon or multi-polygon in the coordinates of `crs`: it names what it covers best.
    #[schema(value_type = Object, example = json!({"type": "Polygon", "coordinates": [[[0, 0], [1.2, 0], [1.2, 0.8], [0, 0.8], [0, 0]]]}))]
    geometry: serde_json::Value,
}

/// What an area is called. Other properties are left out.
#[derive(Debug, ToSchema)]
pub struct NamedPolygonProperties {
    /// Of locations only.
    #[schema(max_length = 18, example = "A-07-12")]
    code: Option<String>,
    name: Option<String>,
    groups: Option<Vec<String>>,
    /// What it names: `locations` (when absent), `places`, `aisles` or `rows`.
    #[schema(example = "locations")]
    collection: Option<String>,
}

/// What an import of names did, or would do.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = NameReport)]
#[serde(rename_all = "camelCase")]
pub struct NameReportView {
    /// Whether nothing was written.
    dry_run: bool,
    /// Rows or polygons read.
    rows: usize,
    /// Things that nobody had given a code or name before.
    named: usize,
    /// Things that have another code, name or groups than people gave before.
    renamed: usize,
    /// Rows that say what was known.
    unchanged: usize,
    /// Locations of the map that no row is for.
    unmatched: usize,
    /// What changes.
    changes: Vec<NameChangeView>,
}

/// What one row changes.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = NameChange)]
pub struct NameChangeView {
    /// The row: `/rows/7` (the header is row 1) or `/features/3`.
    row: String,
    /// The collection of what it names.
    #[schema(example = "locations")]
    collection: &'static str,
    /// The code that it had; the id of places, aisles and rows.
    #[schema(example = "03-012")]
    before: String,
    /// The code that it has now, or the same id.
    #[schema(example = "A-07-12")]
    now: String,
    /// The name that it has now.
    #[serde(skip_serializing_if = "Option::is_none")]
    name: Option<String>,
}

impl From<NameChange> for NameChangeView {
    fn from(change: NameChange) -> Self {
        let collection = match change.collection {
            NamedCollection::Locations => "locations",
            NamedCollection::Places => "places",
            NamedCollection::Aisles => "aisles",
            NamedCollection::Rows => "rows",
        };
        Self { row: change.row, collection, before: change.before, now: change.now, name: change.name }
    }
}

impl NameReportView {
    /// The report of an import.
    #[must_use]
    pub fn new(report: NameReport, dry_run: bool) -> Self {
        let NameReport { rows, named, renamed, unchanged, unmatched, changes } = report;
        let changes = changes.into_iter().map(Into::into).collect();
        Self { dry_run, rows, named, renamed, unchanged, unmatched, changes }
    }
}
