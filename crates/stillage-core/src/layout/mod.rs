//! Storage locations with codes, and the aisles and rows that they form.
//!
//! | module | what comes out |
//! | --- | --- |
//! | [`mod@layout`] | locations, aisles and rows, numbered |
//! | [`layout_options`], [`layout_spec`] | how they are to be cut and numbered: as people wish, and as it is done |
//! | [`code`], [`code_template`] | what a code may be; how codes are written |
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
//! a location however small it is; locations that no aisle leads to get aisle 0. Codes are unique and have at most
//! [`LONGEST_CODE`] characters: where a template would make longer ones, the default template is used for all.

mod access;
mod aisle;
mod aisles;
mod approach;
mod code;
mod code_template;
mod depths;
mod draft;
#[expect(clippy::module_inception, reason = "the layout is what this module makes")]
mod layout;
mod layout_options;
mod layout_spec;
mod location;
mod occupancy;
mod rows;

#[cfg(test)]
mod tests;

pub use aisle::{Aisle, Row};
pub use approach::approach_before;
pub use code::{CodeProblem, LONGEST_CODE, check_code};
pub use code_template::{CodeTemplate, TemplateProblem};
pub use layout::{Layout, layout};
pub use layout_options::LayoutOptions;
pub use layout_spec::LayoutSpec;
pub use location::{ApproachPose, Location, Side};
pub use occupancy::{LocationOccupancy, OccupancyState};

pub(crate) use occupancy::occupancy;
