//! Features as the API document describes them. The bytes are written by [`crate::formats::geojson`].
#![allow(dead_code, reason = "these types describe what is written straight to bytes")]

use jiff::Timestamp;
use serde::Serialize;
use serde_json::Value;
use utoipa::ToSchema;

use super::link::Link;

/// Features in GeoJSON (RFC 7946).
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = FeatureCollection)]
#[serde(rename_all = "camelCase")]
pub struct FeatureCollectionView {
    /// `FeatureCollection`
    #[schema(example = "FeatureCollection")]
    r#type: String,
    /// Features that were selected.
    number_matched: usize,
    /// Features of this page.
    number_returned: usize,
    /// When the answer was made.
    #[schema(value_type = String, format = DateTime)]
    time_stamp: Timestamp,
    links: Vec<Link>,
    features: Vec<FeatureView>,
}

/// Features in GeoJSON (RFC 7946), all at once.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = FeatureList)]
#[serde(rename_all = "camelCase")]
pub struct FeatureListView {
    /// `FeatureCollection`
    #[schema(example = "FeatureCollection")]
    r#type: String,
    /// Features of this answer.
    number_returned: usize,
    features: Vec<FeatureView>,
}

/// A feature in GeoJSON (RFC 7946). Its properties are those of its collection.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Feature)]
pub struct FeatureView {
    /// `Feature`
    #[schema(example = "Feature")]
    r#type: String,
    /// A number; the code of a location.
    #[schema(value_type = FeatureIdView)]
    id: Value,
    /// A GeoJSON geometry: `Point`, `LineString`, `MultiLineString`, `Polygon` or `MultiPolygon`.
    #[schema(value_type = Object, example = json!({"type": "Point", "coordinates": [0.000012345, 0.000023456]}))]
    geometry: Value,
    #[schema(value_type = Object, example = json!({"label": "co", "labelName": "corridor", "areaM2": 61.2}))]
    properties: Value,
    #[serde(skip_serializing_if = "Option::is_none")]
    links: Option<Vec<Link>>,
}

/// Id of a feature.
#[derive(Debug, Serialize, ToSchema)]
#[serde(untagged)]
#[schema(as = FeatureId)]
pub enum FeatureIdView {
    /// Faces, edges and all else.
    Number(u64),
    /// The code of a location.
    Text(String),
}
