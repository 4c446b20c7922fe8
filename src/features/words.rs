//! The words that stand for the values of the core's enumerations.

use stillage_core::annotation::Evidence;
use stillage_core::layout::{OccupancyState, Side};
use stillage_core::semantics::{Cogency, Connectivity, Functionality};

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

/// Words of [`functionality`].
pub const FUNCTIONALITIES: &[&str] = &["drivable", "storage-access", "connection", "access", "storage", "work-place"];

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
pub const fn occupancy(occupancy: OccupancyState) -> &'static str {
    match occupancy {
        OccupancyState::Occupied => "occupied",
        OccupancyState::Empty => "empty",
        OccupancyState::Unknown => "unknown",
    }
}

/// What a place is for.
pub const fn functionality(functionality: Functionality) -> &'static str {
    match functionality {
        Functionality::Drivable => "drivable",
        Functionality::StorageAccess => "storage-access",
        Functionality::Connection => "connection",
        Functionality::Access => "access",
        Functionality::Storage => "storage",
        Functionality::WorkPlace => "work-place",
    }
}

#[cfg(test)]
mod tests {
    use std::fmt::Debug;

    use serde::Serialize;
    use serde::de::DeserializeOwned;
    use serde_json::{from_value, json, to_value};

    use super::*;

    /// Every word is the name that the core gives to a value, and the value's word.
    fn check<T: Debug + Copy + Serialize + DeserializeOwned>(words: &[&str], word: fn(T) -> &'static str) {
        for &name in words {
            let value: T = from_value(json!(name)).unwrap_or_else(|_| panic!("{name} is no word of the core"));
            assert_eq!((word(value), to_value(value).unwrap()), (name, json!(name)));
        }
    }

    #[test]
    fn the_words_are_those_of_the_core() {
        // Evidence has no words in the core.
        check(COGENCY, cogency);
        check(CONNECTIVITY, connectivity);
        check(SIDES, side);
        check(OCCUPANCY, occupancy);
        check(FUNCTIONALITIES, functionality);
    }
}
