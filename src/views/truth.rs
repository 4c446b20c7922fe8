//! The truth of a site as it is sent.
#![allow(dead_code, reason = "it describes what the ingest reads")]

use utoipa::ToSchema;

/// The truth of a site: a GeoJSON feature collection in metres of the map frame.
#[derive(Debug, ToSchema)]
#[schema(as = GroundTruth)]
pub struct TruthBody {
    #[schema(example = "FeatureCollection")]
    r#type: String,
    features: Vec<TruthFeature>,
}

/// Something true of an area.
#[derive(Debug, ToSchema)]
pub struct TruthFeature {
    #[schema(example = "Feature")]
    r#type: String,
    properties: TruthProperties,
    /// A polygon or multi-polygon, in metres of the map frame.
    #[schema(value_type = Object, example = json!({"type": "Polygon", "coordinates": [[[0, 0], [1.2, 0], [1.2, 0.8], [0, 0.8], [0, 0]]]}))]
    geometry: serde_json::Value,
}

/// What is true.
#[derive(Debug, ToSchema)]
pub struct TruthProperties {
    /// `pallet` (a place for one pallet), `corridor`, `junction` or `region`; anything else is left out.
    #[schema(example = "pallet")]
    label: String,
    /// Part of the site; `A` when absent.
    region: Option<String>,
    /// Whether something stood on a place; yes when absent.
    occupied: Option<bool>,
    /// Share of the surroundings of a place that was seen; 1 when absent. Places below one half do not count.
    #[schema(minimum = 0, maximum = 1)]
    observed: Option<f64>,
    /// Direction of the rows of a region, degrees counter-clockwise from the map's x axis.
    #[schema(minimum = -360, maximum = 360)]
    angle_deg: Option<f64>,
}
