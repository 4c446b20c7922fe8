//! What changed between two maps of a site, or between two readings of one analysis.
//!
//! [`compare`] takes the places of two maps in one frame (an alignment carries the new ones there) and tells which are
//! the same, which came, which went, and what is different about those that stayed. [`compare_faces`] does so for the faces
//! of one grid. Exchanging the maps exchanges added and removed, filled and emptied, and nothing else.
//!
//! Cost: O(n log n + pairs of places whose boxes meet). Limits: a place that moved further than its own size is one that
//! went and one that came, unless it kept its code.

mod comparison;
mod faces;
mod footprint;
mod matching;
mod overlap;

#[cfg(test)]
mod tests;

pub use comparison::{ComparedPlace, Comparison, PlaceChange, PlaceMatch, compare};
pub use faces::{FaceDifference, LabelledFace, LabelledFaces, compare_faces};
pub use footprint::Footprint;
pub use matching::{LEAST_SHARE, Pair, pairs};
pub use overlap::greatest_overlap;
