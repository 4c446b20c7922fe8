//! Codes and given names that outlive relabelling, another analysis and a new scan.
//!
//! A [`Registry`] belongs to a site. It holds every place that ever had a code there, on the ground where it was first
//! seen or last confirmed, in the map frame of the site's first map. [`Registry::carry`] takes the freshly numbered
//! locations of a map of the site and gives each the code of the place it is; what is new gets a code that was never used.
//!
//! | what is found | code | state |
//! | --- | --- | --- |
//! | a place with at least half of its ground in common | kept | current |
//! | less ground in common, two that could be it, or an alignment in doubt | kept | stale until confirmed |
//! | nothing on its ground | never given to another | lost; current again when it comes back |
//! | a location where no place was | the proposed one, or the next free number in its aisle | current |
//!
//! Where people wish another template, entrance or width of places, [`Registry::renumbered`] writes all codes anew but those
//! that people gave ([`Registry::give`]). Places in the sense of the semantic map, aisles and rows have no codes: those that
//! people named are kept as areas, and found again by the ground they have in common ([`Registry::areas_of`]).
//!
//! The same registry and locations give the same codes, in whatever order the locations come, and once is as good as
//! twice. Cost: that of [`crate::compare::pairs`].

mod areas;
mod carry;
mod entry;
mod given;
mod name_rules;
mod named_area;
mod next_code;
mod renumber;

#[cfg(test)]
mod tests;

pub use areas::AreaRings;
pub use carry::{Carried, GivenCode, NumberedLocation, Trust};
pub use entry::{PlaceState, Registry, RegistryEntry, UnknownCodes};
pub use given::{CodeConflict, CodeOwner, Given};
pub use name_rules::{checked_group, checked_groups, checked_name};
pub use named_area::{AreaKind, NamedArea};
