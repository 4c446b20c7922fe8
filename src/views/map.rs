//! Maps.

use jiff::Timestamp;
use serde::Serialize;
use utoipa::ToSchema;

use super::alignment::MapAlignmentView;
use super::georeference::GeoreferenceView;
use super::id::Id;
use super::link::Link;
use super::remarks::DiagnosticView;
use crate::records::MapRecord;

/// A map: its landing page.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = MapSummary)]
#[serde(rename_all = "camelCase")]
pub struct MapView {
    id: Id,
    /// Name for people.
    name: String,
    /// The name, as the landing page of an OGC API calls it.
    title: String,
    #[schema(value_type = String, format = DateTime)]
    created: Timestamp,
    #[schema(value_type = String, format = DateTime)]
    updated: Timestamp,
    /// Columns of the grid.
    width: u32,
    /// Rows of the grid.
    height: u32,
    /// Side of a cell, metres.
    resolution_m: f64,
    georeference: GeoreferenceView,
    /// Its site: maps of one site share the codes of its places.
    site: Id,
    /// How it lies on the earlier map that it was uploaded with; absent for the first map of a site.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = MapAlignmentView, required = false)]
    alignment: Option<MapAlignmentView>,
    /// The analysis that answers; absent until the first one is finished.
    #[serde(skip_serializing_if = "Option::is_none")]
    analysis_id: Option<Id>,
    /// Remarks of the upload.
    warnings: Vec<DiagnosticView>,
    /// Raised with every change; the `ETag`.
    version: u64,
    links: Vec<Link>,
}

impl MapView {
    /// A stored map.
    #[must_use]
    pub fn new(map: MapRecord, links: Vec<Link>) -> Self {
        Self {
            id: Id(map.id),
            title: map.name.clone(),
            name: map.name,
            created: map.created,
            updated: map.updated,
            width: map.width,
            height: map.height,
            resolution_m: map.resolution,
            georeference: GeoreferenceView::of(map.georeference, &map.point_pairs),
            site: Id(map.site),
            alignment: map.alignment.map(Into::into),
            analysis_id: map.analysis.map(Id),
            warnings: map.warnings.iter().map(Into::into).collect(),
            version: map.version,
            links,
        }
    }
}

/// A page of maps.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "camelCase")]
pub struct MapList {
    /// Newest first.
    pub maps: Vec<MapView>,
    /// Itself, the deleted maps, and the next page.
    pub links: Vec<Link>,
}
