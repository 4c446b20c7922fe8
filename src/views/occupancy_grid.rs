//! The `nav_msgs/OccupancyGrid` message as it is sent.
#![allow(dead_code, reason = "it describes the message, which the ingest reads")]

use utoipa::ToSchema;

/// A `nav_msgs/OccupancyGrid` message, for the document: it is read by [`crate::ingest`].
#[derive(Debug, ToSchema)]
pub struct OccupancyGridMessage {
    /// Frame and time; not used.
    header: Option<serde_json::Value>,
    info: OccupancyGridInfo,
    /// Cells, row-major from the lower left corner: -1 unknown, 0 free to 100 occupied.
    #[schema(example = json!([0, 100, 0, -1]))]
    data: Vec<i8>,
}

/// `nav_msgs/MapMetaData`
#[derive(Debug, ToSchema)]
pub struct OccupancyGridInfo {
    /// Side of a cell, metres.
    #[schema(exclusive_minimum = 0, example = 0.05)]
    resolution: f64,
    /// Columns.
    #[schema(minimum = 1, example = 2)]
    width: u32,
    /// Rows.
    #[schema(minimum = 1, example = 2)]
    height: u32,
    /// Pose of the lower left corner: `position {x, y, z}`, `orientation {x, y, z, w}`.
    #[schema(example = json!({"position": {"x": 0, "y": 0, "z": 0}, "orientation": {"x": 0, "y": 0, "z": 0, "w": 1}}))]
    origin: serde_json::Value,
}
