//! Storage locations with codes, and the aisles and rows that they form.
//!
//! | module | what comes out |
//! | --- | --- |
//! | [`mod@layout`] | locations, aisles and rows, numbered |
//! | [`layout_spec`], [`code_template`] | how they are cut and numbered; how codes are written |
//! | [`location`], [`aisle`] | what is known of a location, of an aisle and of a row |
//! | [`access`] | the side from which each storage face is reached |
//! | [`draft`] | the ground of each location; faces with room for several loads are cut |
//! | [`depths`] | which locations lie behind others |
//! | [`aisles`], [`rows`] | which fronts lie along one aisle; its course, and the rows along it |
//! | [`mod@approach`] | where a vehicle stands before a location |
//! | [`mod@occupancy`] | whether goods stand in it |
//!
//! Source: the paper ends at pallet cells with storage-access edges; the codes follow the habit of warehouses:
//! `aisle-bay` with digits of fixed width, odd bays on the left and even ones on the right of the aisle's direction,
//! places behind others with their depth at the end. Cost: O(faces + edges + n log n) for n locations. Limits: a face is
//! a location however small it is; locations that no aisle leads to get aisle 0.

mod access;
mod aisle;
mod aisles;
mod approach;
mod code_template;
mod depths;
mod draft;
#[expect(clippy::module_inception, reason = "the layout is what this module makes")]
mod layout;
mod layout_spec;
mod location;
mod occupancy;
mod rows;

#[cfg(test)]
mod tests;

pub use aisle::{Aisle, Row};
pub use approach::approach_before;
pub use code_template::{CodeTemplate, LONGEST_CODE, TemplateProblem};
pub use layout::{Layout, layout};
pub use layout_spec::LayoutSpec;
pub use location::{ApproachPose, Location, Side};
pub use occupancy::{LocationOccupancy, OccupancyState};

pub(crate) use occupancy::occupancy;
