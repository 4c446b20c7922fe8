//! The words that stand for the values of the core's enumerations.

use stillage_core::annotation::Evidence;
use stillage_core::layout::{LocationOccupancy, Side};
use stillage_core::semantics::{Cogency, Connectivity};

/// Words of [`evidence`].
pub const EVIDENCE: &[&str] = &["observed", "interpolated"];
/// Words of [`cogency`].
pub const COGENCY: &[&str] = &["cogent", "storage-access", "invalid"];
/// Words of [`connectivity`].
pub const CONNECTIVITY: &[&str] = &["disconnected", "storage-access", "connected"];
/// Words of [`side`].
pub const SIDES: &[&str] = &["left", "right"];
/// Words of [`occupancy`].
pub const OCCUPANCY: &[&str] = &["occupied", "empty", "unknown"];

/// What the geometry of a face or edge rests on.
pub const fn evidence(evidence: Evidence) -> &'static str {
    match evidence {
        Evidence::Observed => "observed",
        Evidence::Interpolated => "interpolated",
    }
}

/// C(e).
pub const fn cogency(cogency: Cogency) -> &'static str {
    match cogency {
        Cogency::Cogent => "cogent",
        Cogency::StorageAccess => "storage-access",
        Cogency::Invalid => "invalid",
    }
}

/// C(l).
pub const fn connectivity(connectivity: Connectivity) -> &'static str {
    match connectivity {
        Connectivity::Disconnected => "disconnected",
        Connectivity::StorageAccess => "storage-access",
        Connectivity::Connected => "connected",
    }
}

/// The side of an aisle.
pub const fn side(side: Side) -> &'static str {
    match side {
        Side::Left => "left",
        Side::Right => "right",
    }
}

/// Whether goods stand in a location.
pub const fn occupancy(occupancy: LocationOccupancy) -> &'static str {
    match occupancy {
        LocationOccupancy::Occupied => "occupied",
        LocationOccupancy::Empty => "empty",
        LocationOccupancy::Unknown => "unknown",
    }
}
