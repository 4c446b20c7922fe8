//! What hangs on a map: its record and upload, analyses, pictures, semantics, corrections and evaluation; and the rule sets.

pub mod analyses;
pub mod cogency_matrix;
pub mod comparisons;
pub mod corrections;
pub(crate) mod corrections_body;
pub mod deletion;
pub mod evaluations;
mod face_differences;
pub mod history;
pub mod label_preview;
pub mod map;
pub mod names;
pub mod pictures;
pub mod registry;
pub mod rule_sets;
pub mod semantics;
mod semantics_body;
pub mod upload;
pub mod version_changes;
