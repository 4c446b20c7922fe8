//! Storage locations with codes, aisles, bays and access.
//!
//! | module | what comes out |
//! | --- | --- |
//! | [`mod@locations`] | every storage face as a location, by code |
//! | [`location`] | what is known of one |
//! | [`access`] | its access edges, its frame, and where a robot stands before it |
//! | [`aisles`] | the numbers of its aisle and bay |
//! | [`codes`] | its code |
//! | [`mod@occupancy`] | whether goods stand in it |
//!
//! Source: the paper ends at pallet cells with storage-access edges; the codes follow the habit of warehouses:
//! `aisle-bay` with digits of fixed width, odd bays on the left and even ones on the right of the aisle's direction.
//! Cost: O(faces + edges + n log n) for n locations. Limits: a face is a location however small it is; locations behind
//! others, without an access edge of their own, get aisle 0.

mod access;
mod aisles;
mod codes;
mod location;
mod locations;
mod occupancy;

#[cfg(test)]
mod tests;

pub use location::{ApproachPose, Location, Side};
pub use locations::locations;
pub use occupancy::LocationOccupancy;

pub(crate) use occupancy::occupancy;
