//! Layout Interchange Format 2.0, for fleet managers.
//!
//! Source: VDMA, LIF 2.0.0 as of September 2026 (branch `dev/V2`),
//! github.com/Intralogistics-2X-LIF/Layout-Interchange-Format. Method and cost: see `lif_layout`; beyond version 1 each
//! edge tells the free ground beside it (`corridor`), half of the lane's width at its narrowest on either side. Limits:
//! the text is a draft.

use serde::Serialize;
use stillage_core::graph::Lane;

use super::lif_layout::{LifDocument, VEHICLE_TYPE, document};
use super::source::ExportSource;
use crate::features::rounded;

/// Version of the format.
const VERSION: &str = "2.0.0";

/// What an edge means to a type of vehicle.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Lif2EdgeProperties {
    vehicle_type_id: &'static str,
    vehicle_orientations: [f64; 1],
    orientation_type: &'static str,
    corridor: LifCorridor,
}

/// How far a vehicle may leave the course to either side, metres.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct LifCorridor {
    maximum_left_width: f64,
    maximum_right_width: f64,
    /// The whole outline of the vehicle stays within.
    corridor_reference_point: &'static str,
}

/// The layout of a map as LIF 2.0.
#[must_use]
pub fn layout(source: &ExportSource<'_>) -> LifDocument<Lif2EdgeProperties> {
    document(source, VERSION, |lane: &Lane| Lif2EdgeProperties {
        vehicle_type_id: VEHICLE_TYPE,
        vehicle_orientations: [0.0],
        orientation_type: "TANGENTIAL",
        corridor: LifCorridor {
            maximum_left_width: rounded(lane.width / 2.0),
            maximum_right_width: rounded(lane.width / 2.0),
            corridor_reference_point: "CONTOUR",
        },
    })
}
