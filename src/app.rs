//! The use cases: one method for each thing a user can ask of the service. (to be completed)

use std::collections::BTreeMap;
use std::sync::Arc;

use jiff::Timestamp;
use serde::{Deserialize, Serialize};
use stillage_core::analysis::Diagnostic;
use stillage_core::annotation::CellFaces;
use stillage_core::layout::Location;
use stillage_core::semantics::{Assignment, RuleSetDraft, SemanticMap, Suggestion};
use stillage_core::{Analysis, AnalysisOptions, OccupancyGrid};
use uuid::Uuid;

use crate::config::Config;
use crate::geojson::Georeference;
use crate::ingest::{IngestError, MapSource};

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

/// An analysed map in memory, ready to answer. Shared, immutable; replaced when the semantics change.
#[derive(Debug)]
pub struct MapContext {
    pub record: MapRecord,
    pub grid: OccupancyGrid,
    pub analysis_id: Uuid,
    pub analysis: Arc<Analysis>,
    pub cells: CellFaces,
    pub semantics: SemanticsRecord,
    pub semantic: SemanticMap,
    pub suggestions: Vec<Suggestion>,
    pub locations: Vec<Location>,
}

/// A field of a request that is wrong.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct FieldProblem {
    /// JSON pointer.
    pub pointer: String,
    pub detail: String,
}

/// Why a use case could not be carried out.
#[derive(Debug, thiserror::Error)]
pub enum AppError {
    #[error("there is no {kind} {id}")]
    NotFound { kind: &'static str, id: String },
    #[error("map {map} has no finished analysis yet: see job {job:?}")]
    NotAnalysed { map: Uuid, job: Option<Uuid> },
    #[error("{detail}")]
    Invalid { detail: String, fields: Vec<FieldProblem> },
    #[error(transparent)]
    Ingest(#[from] IngestError),
    #[error("the resource is at version {current}, not at the one in If-Match")]
    PreconditionFailed { current: u64 },
    #[error("this write needs an If-Match header with the ETag that was read")]
    PreconditionRequired,
    #[error("{0}")]
    Conflict(String),
    /// Needs more than is configured: memory of a job.
    #[error("{0}")]
    TooLarge(String),
    #[error("the queue is full: try again in {retry_after_s} s")]
    Busy { retry_after_s: u32 },
    #[error("the server is short of disk space")]
    NoSpace,
    #[error("the store cannot be reached")]
    Unavailable,
    #[error("internal error")]
    Internal(#[source] Box<dyn std::error::Error + Send + Sync>),
}

/// The service without its edges.
#[derive(Debug)]
pub struct App {
    config: Config,
}

#[allow(clippy::unused_async, reason = "skeleton")]
impl App {
    /// Opens the data folder (exclusively), migrates the database and starts the worker.
    pub async fn open(config: Config) -> Result<Arc<Self>, AppError> {
        Ok(Arc::new(Self { config }))
    }
    /// The configuration it runs with.
    #[must_use]
    pub const fn config(&self) -> &Config {
        &self.config
    }
    /// Stops claiming, lets running jobs end within the grace period or puts them back, and closes the store.
    pub async fn shutdown(&self) {
        todo!()
    }
    /// Whether the store answers, is migrated and has space.
    pub async fn ready(&self) -> Result<(), AppError> {
        todo!()
    }
    /// Decodes and stores a map and its first job, in one transaction. `true` when the job is new (202), `false` when
    /// the idempotency key had been seen with the same content.
    pub async fn create_map(&self, map: NewMap) -> Result<(JobRecord, bool), AppError> {
        let _ = map;
        todo!()
    }
    /// Maps, newest first.
    pub async fn maps(&self, limit: u32, after: Option<Uuid>) -> Result<Vec<MapRecord>, AppError> {
        let _ = (limit, after);
        todo!()
    }
    pub async fn map(&self, id: Uuid) -> Result<MapRecord, AppError> {
        let _ = id;
        todo!()
    }
    /// Renames or georeferences. `if_match` is optional here.
    pub async fn update_map(&self, id: Uuid, patch: MapPatch, if_match: Option<u64>) -> Result<MapRecord, AppError> {
        let _ = (id, patch, if_match);
        todo!()
    }
    /// Dismisses its jobs and deletes everything of the map.
    pub async fn delete_map(&self, id: Uuid) -> Result<(), AppError> {
        let _ = id;
        todo!()
    }
    /// Analyses again with other options; identical options answer the existing analysis.
    pub async fn create_analysis(&self, map: Uuid, options: AnalysisOptions) -> Result<AnalysisTicket, AppError> {
        let _ = (map, options);
        todo!()
    }
    pub async fn analyses(&self, map: Uuid) -> Result<Vec<AnalysisRecord>, AppError> {
        let _ = map;
        todo!()
    }
    pub async fn jobs(&self, filter: JobFilter) -> Result<Vec<JobRecord>, AppError> {
        let _ = filter;
        todo!()
    }
    pub async fn job(&self, id: Uuid) -> Result<JobRecord, AppError> {
        let _ = id;
        todo!()
    }
    /// Dismisses: queued at once, running within a second. A finished job is a conflict.
    pub async fn dismiss_job(&self, id: Uuid) -> Result<JobRecord, AppError> {
        let _ = id;
        todo!()
    }
    /// Wakes whenever some job changed; the receiver then reads [`Self::job`].
    #[must_use]
    pub fn job_changes(&self) -> tokio::sync::watch::Receiver<u64> {
        todo!()
    }
    pub async fn rule_sets(&self) -> Result<Vec<RuleSetRecord>, AppError> {
        todo!()
    }
    pub async fn rule_set(&self, id: &str) -> Result<RuleSetRecord, AppError> {
        let _ = id;
        todo!()
    }
    /// Creates; an id in use is a conflict.
    pub async fn create_rule_set(&self, id: &str, draft: RuleSetDraft) -> Result<RuleSetRecord, AppError> {
        let _ = (id, draft);
        todo!()
    }
    /// Replaces; needs `if_match`.
    pub async fn put_rule_set(
        &self,
        id: &str,
        draft: RuleSetDraft,
        if_match: Option<u64>,
    ) -> Result<RuleSetRecord, AppError> {
        let _ = (id, draft, if_match);
        todo!()
    }
    /// Deletes; needs `if_match`. Maps keep the rule set they were assigned with.
    pub async fn delete_rule_set(&self, id: &str, if_match: Option<u64>) -> Result<(), AppError> {
        let _ = (id, if_match);
        todo!()
    }
    /// The semantics in force: the newest assigned version, or the suggestion (version 0).
    pub async fn semantics(&self, map: Uuid) -> Result<SemanticsRecord, AppError> {
        let _ = map;
        todo!()
    }
    /// Makes a new version; needs `if_match`, the version in force.
    pub async fn put_semantics(
        &self,
        map: Uuid,
        new: NewSemantics,
        if_match: Option<u64>,
    ) -> Result<SemanticsRecord, AppError> {
        let _ = (map, new, if_match);
        todo!()
    }
    /// All assigned versions, newest first.
    pub async fn semantics_versions(&self, map: Uuid) -> Result<Vec<SemanticsRecord>, AppError> {
        let _ = map;
        todo!()
    }
    /// The analysed map, from memory or the store.
    pub async fn context(&self, map: Uuid) -> Result<Arc<MapContext>, AppError> {
        let _ = map;
        todo!()
    }
    /// Counts by job state, for the metrics.
    pub async fn job_counts(&self) -> Result<BTreeMap<&'static str, u64>, AppError> {
        todo!()
    }
}
