//! What `stillage analyze` found.

use stillage_core::analysis::Diagnostic;
use stillage_core::layout::Layout;
use stillage_core::semantics::{Assignment, SemanticMap, Suggestion};
use stillage_core::{Analysis, OccupancyGrid};

/// Everything that is found, ready to be written.
pub(super) struct Findings {
    pub(super) name: String,
    pub(super) grid: OccupancyGrid,
    pub(super) analysis: Analysis,
    pub(super) suggestions: Vec<Suggestion>,
    pub(super) assignment: Assignment,
    pub(super) semantic: SemanticMap,
    pub(super) layout: Layout,
    /// Remarks of the ingest and the analysis.
    pub(super) diagnostics: Vec<Diagnostic>,
}
