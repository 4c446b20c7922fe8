//! What the service stores, as plain data. `store`, `jobs`, `app` and the edges pass these types to each other.

use std::fmt;
use std::time::Duration;

use jiff::Timestamp;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use stillage_core::AnalysisOptions;
use stillage_core::alignment::SiteAlignment;
use stillage_core::analysis::Diagnostic;
use stillage_core::geometry::RigidMotion;
use stillage_core::layout::LayoutOptions;
use stillage_core::semantics::{Assignment, LabelSubject, RuleSetDraft};
use uuid::Uuid;

use crate::coordinates::{Georeference, PointPair, Survey};
use crate::ingest::MapSource;

/// Whose a map, job or rule set is. What belongs to one tenant does not exist for another.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Tenant(String);

impl Tenant {
    /// The only tenant of a service without keys.
    #[must_use]
    pub fn local() -> Self {
        Self::new("local")
    }

    /// Nobody: whose the maps are that were deleted and may be restored. No caller is nobody.
    #[must_use]
    pub fn nobody() -> Self {
        Self::new("")
    }

    /// The tenant with this id.
    #[must_use]
    pub fn new(id: impl Into<String>) -> Self {
        Self(id.into())
    }

    /// Its id.
    #[must_use]
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

impl fmt::Display for Tenant {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.0)
    }
}

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
    pub georeference: Option<Survey>,
    /// An earlier map of the same site, on which it is aligned.
    pub previous: Option<Uuid>,
    /// The client's `Idempotency-Key`: the same key with the same content answers the same job.
    pub idempotency_key: Option<String>,
}

/// A stored map.
#[derive(Debug, Clone, PartialEq)]
pub struct MapRecord {
    /// Its id.
    pub id: Uuid,
    /// Name for people.
    pub name: String,
    /// When it was uploaded.
    pub created: Timestamp,
    /// When it last changed.
    pub updated: Timestamp,
    /// Columns of the grid.
    pub width: u32,
    /// Rows of the grid.
    pub height: u32,
    /// Side of a cell, metres.
    pub resolution: f64,
    /// Where it lies on Earth.
    pub georeference: Option<Georeference>,
    /// The pairs of points that its georeference was fitted to.
    pub point_pairs: Vec<PointPair>,
    /// Its site: the id of the site's first map, which may be deleted since.
    pub site: Uuid,
    /// How it lies on the earlier map that it was uploaded with.
    pub alignment: Option<AlignmentRecord>,
    /// The analysis that answers, when one is finished.
    pub analysis: Option<Uuid>,
    /// Remarks of the ingest.
    pub warnings: Vec<Diagnostic>,
    /// Raised with every change (the strong `ETag` of the record).
    pub version: u64,
}

impl MapRecord {
    /// From its map frame to the frame of its site.
    #[must_use]
    pub fn to_site(&self) -> RigidMotion {
        self.alignment.map_or_else(RigidMotion::identity, |alignment| alignment.to_site)
    }
}

/// How a map lies on an earlier one of its site.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct AlignmentRecord {
    /// The earlier map.
    pub previous: Uuid,
    /// From this map to the earlier one.
    pub found: SiteAlignment,
    /// From this map to the frame of the site: that of its first map.
    pub to_site: RigidMotion,
}

/// Changes to a map; absent fields stay.
#[derive(Debug, Clone, Default)]
pub struct MapPatch {
    /// Its new name.
    pub name: Option<String>,
    /// `Some(None)` takes the georeference away.
    pub georeference: Option<Option<Survey>>,
}

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

/// What one stage cost.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct StageReport {
    /// The stage.
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
    /// It waits.
    Accepted,
    /// A worker has it.
    Running,
    /// Its outputs are there.
    Successful,
    /// It has no outputs; the message says why.
    Failed,
    /// It was cancelled.
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
    /// Its id.
    pub id: Uuid,
    /// The map it works on; it is deleted with it.
    pub map: Uuid,
    /// Id of the process that computes it.
    pub process: String,
    /// What the process is given beside the map, as a JSON object.
    pub inputs: Value,
    /// What the process made, as a JSON object; absent until then.
    pub outputs: Option<Value>,
    /// Where it is in its life.
    pub state: JobState,
    /// 0 to 100.
    pub progress: u8,
    /// The stage it is in.
    pub stage: Option<String>,
    /// What the stages that ended cost.
    pub stages: Vec<StageReport>,
    /// For people.
    pub message: String,
    /// Attempts begun, those not counted that ended with an orderly stop of the service.
    pub attempt: u32,
    /// When it was accepted.
    pub created: Timestamp,
    /// When its first attempt began.
    pub started: Option<Timestamp>,
    /// When it reached its final state.
    pub finished: Option<Timestamp>,
    /// When it last changed.
    pub updated: Timestamp,
}

impl JobRecord {
    /// The analysis it made.
    #[must_use]
    pub fn analysis(&self) -> Option<Uuid> {
        self.outputs.as_ref()?.get("analysis")?.as_str()?.parse().ok()
    }

    /// What became of the job when its map was deleted, and the job with it.
    #[must_use]
    pub fn deleted(self, now: Timestamp) -> Self {
        let message = "the map was deleted, and its jobs with it".to_owned();
        // Later than every change before, whatever the clock does.
        let next = Timestamp::from_microsecond(self.updated.as_microsecond() + 1).unwrap_or(now);
        let updated = now.max(next);
        Self { state: JobState::Dismissed, stage: None, message, finished: Some(now), updated, ..self }
    }
}

/// Which jobs to list: newest first, after a job when paging.
#[derive(Debug, Clone, Default)]
pub struct JobFilter {
    /// In one of these states; all when empty.
    pub states: Vec<JobState>,
    /// Of one of these processes; of all when empty.
    pub processes: Vec<String>,
    /// Of this map.
    pub map: Option<Uuid>,
    /// Accepted at this time or later.
    pub created_from: Option<Timestamp>,
    /// Accepted at this time or earlier.
    pub created_to: Option<Timestamp>,
    /// Begun, and over after this time or longer, or running for so long already.
    pub min_duration: Option<Duration>,
    /// Begun, and over within this time, or not running for longer yet.
    pub max_duration: Option<Duration>,
    /// At most this many.
    pub limit: u32,
    /// Older than this one.
    pub after: Option<Uuid>,
}

/// A stored rule set.
#[derive(Debug, Clone, PartialEq)]
pub struct RuleSetRecord {
    /// Its id.
    pub id: String,
    /// The labels and rules.
    pub draft: RuleSetDraft,
    /// Built in, so that it cannot be changed.
    pub built_in: bool,
    /// From 1, raised with every change.
    pub version: u64,
}

/// One version of the human level of a map.
#[derive(Debug, Clone, PartialEq)]
pub struct SemanticsRecord {
    /// The analysis whose categories it names.
    pub analysis: Uuid,
    /// Id of the rule set.
    pub rule_set: String,
    /// The rule set as it was when this version was made.
    pub draft: RuleSetDraft,
    /// The decision.
    pub assignment: Assignment,
    /// How locations are cut and numbered.
    pub layout: LayoutOptions,
    /// 0 is the suggestion; assigned versions count from 1.
    pub version: u64,
    /// Who decided.
    pub origin: SemanticsOrigin,
    /// What became of the decisions on another analysis, where it was carried over from them.
    pub carried: Option<CarryRecord>,
    /// When it was made.
    pub created: Timestamp,
}

/// What became of the decisions of a version when they were carried over to another analysis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct CarryRecord {
    /// The version, which a person made.
    pub from: u64,
    /// Decisions that hold on the other analysis, too.
    pub kept: usize,
    /// The others.
    pub lost: Vec<LostDecision>,
}

/// A decision that could not be carried over.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct LostDecision {
    /// What had the label on the analysis it was decided on.
    #[serde(flatten)]
    pub subject: LabelSubject,
    /// Id of the label.
    pub label: String,
    /// A point inside, in metres of the map frame.
    pub at: [f64; 2],
}

/// Who decided.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SemanticsOrigin {
    /// Nobody, or a person who went back to the suggestion.
    Suggested,
    /// A person.
    Assigned,
    /// A person, on another analysis of the map.
    Carried,
}

impl SemanticsOrigin {
    /// All of them.
    const ALL: [Self; 3] = [Self::Suggested, Self::Assigned, Self::Carried];

    /// The name in the database.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Suggested => "suggested",
            Self::Assigned => "assigned",
            Self::Carried => "carried",
        }
    }

    /// The origin with a name.
    #[must_use]
    pub fn find(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|origin| origin.name() == name)
    }
}

/// The result of asking for an analysis.
#[derive(Debug, Clone, PartialEq)]
pub enum AnalysisTicket {
    /// The same options were analysed before.
    Existing(Box<AnalysisRecord>),
    /// A job will do it.
    Job(Box<JobRecord>),
}
