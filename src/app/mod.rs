//! The use cases: one method for each thing a user can ask of the service.
//!
//! | file | what it answers |
//! | --- | --- |
//! | `maps` | upload, list, rename |
//! | `deletion` | maps are deleted, and restored for a while after that |
//! | `jobs` | analyses and the jobs that make them |
//! | `rule_sets` | the vocabulary of labels |
//! | `semantics`, `semantics_change` | the human decision on a map, its versions |
//! | `carrying`, `site_carrying` | what was decided on another analysis, or on an earlier map of the site, carried over |
//! | `corrections` | what people corrected about a map |
//! | `history` | back and forth in the versions |
//! | `proposals` | analyses as they would answer if they were in force |
//! | `label_preview` | what a change of the labels would do |
//! | `face_labels` | the label of a single face |
//! | `registries` | uploads aligned to an earlier map, the codes of a site's places |
//! | `names`, `name_import` | what people call locations, places, aisles and rows |
//! | `comparisons` | what changed between two maps, or two versions of the semantics |
//! | `grid` | the cells of a map, before any analysis |
//! | `context`, `map_context`, `context_cache`, `map_states` | the analysed map in memory, with its collections |
//! | `stored_blobs`, `mending` | its upload and its analysis from the store; what is damaged is made again |
//! | `geometric_level` | its analysis, as made and as corrected |
//! | `routers`, `latest` | its routers and navigation graphs, the latest kept |
//! | `exports` | its files for other programs |
//! | `service` | what the use cases share, start and stop |
//! | `caller`, `keyring`, `sign_in`, `tokens`, `audit` | who asks, with which key, and who changed what |
//! | `operation` | the figures that operators read |
//! | `evaluations` | how well it fits the truth of its site |
//!
//! Every use case takes its [`Caller`] first. What concerns the service itself (readiness, metrics, the orderly stop)
//! takes none. Nothing here knows HTTP; nothing here holds SQL.

mod audit;
mod caller;
mod carrying;
mod comparisons;
mod context;
mod context_cache;
mod corrections;
mod deletion;
mod error;
mod evaluations;
mod exports;
mod face_labels;
mod file_context;
mod geometric_level;
mod grid;
mod history;
mod jobs;
mod keyring;
mod label_preview;
mod latest;
mod map_context;
mod map_states;
mod maps;
mod mending;
mod name_import;
mod names;
mod operation;
mod proposals;
mod registries;
mod routers;
mod rule_sets;
mod semantics;
mod semantics_change;
mod service;
mod sign_in;
mod site_carrying;
mod stored_blobs;
#[cfg(test)]
mod tests;
mod tokens;

pub use crate::jobs::processes::{ANALYSIS, ProcessDescription};
pub use crate::records::{
    AnalysisRecord, AnalysisTicket, CorrectionId, JobFilter, JobRecord, JobState, MapPatch, MapRecord, NewMap,
    RuleSetRecord, SemanticsOrigin, SemanticsRecord, StageReport,
};
pub use crate::store::with_entry;
pub use caller::Caller;
pub use comparisons::{LocationComparison, MapComparison, PairAlignment, ReadingComparison};
pub use corrections::check_corrections;
pub use deletion::DeletedMap;
pub use error::{AppError, FieldProblem};
pub use file_context::FileMap;
pub use geometric_level::AppliedCorrections;
pub use grid::GridSource;
pub use label_preview::LabelPreview;
pub use map_context::MapContext;
pub use name_import::{NameChange, NameReport};
pub use names::{Nameable, area_kind};
pub use proposals::Proposal;
pub use semantics_change::{RuleSetChoice, SemanticsChange, Unnamed, WantedCorrection};
pub use service::App;
pub use sign_in::Credential;
