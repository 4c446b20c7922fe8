//! Jobs.

use std::time::Duration;

use jiff::Timestamp;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use uuid::Uuid;

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
