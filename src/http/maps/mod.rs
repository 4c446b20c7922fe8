//! What hangs on a map: its record and upload, analyses, pictures, semantics and evaluation; and the rule sets.

pub mod analyses;
pub mod cogency_matrix;
pub mod comparisons;
pub mod deletion;
pub mod evaluations;
pub mod label_preview;
pub mod map;
pub mod names;
pub mod pictures;
pub mod registry;
pub mod rule_sets;
pub mod semantics;
mod semantics_body;
pub mod upload;
