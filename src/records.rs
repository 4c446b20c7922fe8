//! What the service stores, as plain data: the words in which `store`, `jobs`, `app` and the edges speak.

use jiff::Timestamp;
use serde::{Deserialize, Serialize};
use stillage_core::AnalysisOptions;
use stillage_core::analysis::Diagnostic;
use stillage_core::semantics::{Assignment, RuleSetDraft};
use uuid::Uuid;

use crate::geojson::Georeference;
use crate::ingest::MapSource;

/// A map to be analysed.
#[derive(Debug, Clone)]
pub struct NewMap {
    /// What was uploaded.
    pub source: MapSource,
    /// Name for people.
    pub name: String,
    /// Options of its first analysis.
    pub options: AnalysisOptions,
    /// Where it lies on Earth.
    pub georeference: Option<Georeference>,
    /// The client's `Idempotency-Key`: the same key with the same content answers the same job.
    pub idempotency_key: Option<String>,
}

/// A stored map.
#[derive(Debug, Clone, PartialEq)]
pub struct MapRecord {
    pub id: Uuid,
    pub name: String,
    pub created: Timestamp,
    pub updated: Timestamp,
    pub width: u32,
    pub height: u32,
    pub resolution: f64,
    pub georeference: Option<Georeference>,
    /// The analysis that answers, when one is finished.
    pub analysis: Option<Uuid>,
    /// Remarks of the ingest.
    pub warnings: Vec<Diagnostic>,
    /// Raised with every change (the strong ETag of the record).
    pub version: u64,
}

/// Changes to a map; absent fields stay.
#[derive(Debug, Clone, Default)]
pub struct MapPatch {
    pub name: Option<String>,
    /// `Some(None)` takes the georeference away.
    pub georeference: Option<Option<Georeference>>,
}

/// A finished analysis.
#[derive(Debug, Clone, PartialEq)]
pub struct AnalysisRecord {
    pub id: Uuid,
    pub map: Uuid,
    pub created: Timestamp,
    pub options: AnalysisOptions,
    pub stages: Vec<StageReport>,
    pub diagnostics: Vec<Diagnostic>,
}

/// What one stage cost.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct StageReport {
    pub name: String,
    /// Wall-clock seconds.
    pub wall_s: f64,
    /// CPU seconds of the process.
    pub cpu_s: f64,
}

/// State of a job, in the words of OGC API Processes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum JobState {
    Accepted,
    Running,
    Successful,
    Failed,
    Dismissed,
}

impl JobState {
    /// Every state, in the order of a job's life.
    pub const ALL: [Self; 5] = [Self::Accepted, Self::Running, Self::Successful, Self::Failed, Self::Dismissed];

    /// The name on the wire and in the database.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Accepted => "accepted",
            Self::Running => "running",
            Self::Successful => "successful",
            Self::Failed => "failed",
            Self::Dismissed => "dismissed",
        }
    }

    /// The state with a name.
    #[must_use]
    pub fn find(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|state| state.name() == name)
    }

    /// Whether nothing more will happen to the job.
    #[must_use]
    pub const fn is_final(self) -> bool {
        matches!(self, Self::Successful | Self::Failed | Self::Dismissed)
    }
}

/// A job.
#[derive(Debug, Clone, PartialEq)]
pub struct JobRecord {
    pub id: Uuid,
    pub map: Uuid,
    pub state: JobState,
    /// 0 to 100.
    pub progress: u8,
    /// The stage it is in.
    pub stage: Option<String>,
    pub stages: Vec<StageReport>,
    /// For people.
    pub message: String,
    pub attempt: u32,
    pub created: Timestamp,
    pub started: Option<Timestamp>,
    pub finished: Option<Timestamp>,
    pub updated: Timestamp,
    /// The analysis it made.
    pub analysis: Option<Uuid>,
}

/// Which jobs to list: newest first, after a job when paging.
#[derive(Debug, Clone, Default)]
pub struct JobFilter {
    pub states: Vec<JobState>,
    pub map: Option<Uuid>,
    pub limit: u32,
    pub after: Option<Uuid>,
}

/// A stored rule set.
#[derive(Debug, Clone, PartialEq)]
pub struct RuleSetRecord {
    pub id: String,
    pub draft: RuleSetDraft,
    /// Built in, so that it cannot be changed.
    pub built_in: bool,
    /// From 1, raised with every change.
    pub version: u64,
}

/// One version of the human level of a map.
#[derive(Debug, Clone, PartialEq)]
pub struct SemanticsRecord {
    pub rule_set: String,
    /// The rule set as it was when this version was made.
    pub draft: RuleSetDraft,
    pub assignment: Assignment,
    /// 0 is the suggestion; assigned versions count from 1.
    pub version: u64,
    pub origin: SemanticsOrigin,
    pub created: Timestamp,
}

/// Who decided.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SemanticsOrigin {
    /// Nobody yet: the suggestion is in force.
    Suggested,
    /// A person.
    Assigned,
}

/// A new version of the human level.
#[derive(Debug, Clone)]
pub struct NewSemantics {
    /// The rule set; the one in force when absent.
    pub rule_set: Option<String>,
    pub assignment: Assignment,
}

/// The result of asking for an analysis.
#[derive(Debug, Clone, PartialEq)]
pub enum AnalysisTicket {
    /// The same options were analysed before.
    Existing(AnalysisRecord),
    /// A job will do it.
    Job(JobRecord),
}
