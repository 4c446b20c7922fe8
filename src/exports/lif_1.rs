//! Layout Interchange Format 1.0, for fleet managers.
//!
//! Source: VDMA, LIF 1.0, github.com/Intralogistics-2X-LIF/Layout-Interchange-Format, and the schema of Continua
//! Systems that came before it. Method, cost and limits: see `lif_layout`. The two texts differ in the unit of
//! `vehicleOrientation` (radians and degrees): it is 0 here, along the edge, and means the same in both.

use serde::Serialize;

use super::lif_layout::{LifDocument, VEHICLE_TYPE, document};
use super::source::ExportSource;

/// Version of the format.
const VERSION: &str = "1.0.0";

/// What an edge means to a type of vehicle.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Lif1EdgeProperties {
    vehicle_type_id: &'static str,
    vehicle_orientation: f64,
    orientation_type: &'static str,
    /// Required by the schema of VDMA, unknown as such to that of Continua. Edges are straight: vehicles turn at nodes.
    rotation_allowed: bool,
}

/// The layout of a map as LIF 1.0.
#[must_use]
pub fn layout(source: &ExportSource<'_>) -> LifDocument<Lif1EdgeProperties> {
    document(source, VERSION, |_| Lif1EdgeProperties {
        vehicle_type_id: VEHICLE_TYPE,
        vehicle_orientation: 0.0,
        orientation_type: "TANGENTIAL",
        rotation_allowed: false,
    })
}
