//! Finished analyses, and what is asked for one.

use jiff::Timestamp;
use stillage_core::AnalysisOptions;
use stillage_core::analysis::Diagnostic;
use uuid::Uuid;

use super::job::{JobRecord, StageReport};

/// A finished analysis.
#[derive(Debug, Clone, PartialEq)]
pub struct AnalysisRecord {
    /// Its id.
    pub id: Uuid,
    /// The map it belongs to.
    pub map: Uuid,
    /// When it was made.
    pub created: Timestamp,
    /// The options, whole.
    pub options: AnalysisOptions,
    /// What each stage cost.
    pub stages: Vec<StageReport>,
    /// What the user should know about the result.
    pub diagnostics: Vec<Diagnostic>,
}

/// The result of asking for an analysis.
#[derive(Debug, Clone, PartialEq)]
pub enum AnalysisTicket {
    /// The same options were analysed before.
    Existing(Box<AnalysisRecord>),
    /// A job will do it.
    Job(Box<JobRecord>),
}
