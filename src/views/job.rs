//! Jobs, in the words of OGC API Processes.

use jiff::Timestamp;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::id::Id;
use super::link::Link;
use super::remarks::StageView;
use crate::records::{JobRecord, JobState};

/// A job: `statusInfo` of OGC API Processes.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Job)]
#[serde(rename_all = "camelCase")]
pub struct JobView {
    #[serde(rename = "jobID")]
    job_id: Id,
    /// `semantic-map`
    #[serde(rename = "processID")]
    #[schema(example = "semantic-map")]
    process_id: String,
    /// `process`
    #[schema(example = "process")]
    r#type: &'static str,
    status: JobStatus,
    /// Percent.
    #[schema(minimum = 0, maximum = 100)]
    progress: u8,
    /// For people.
    message: String,
    #[schema(value_type = String, format = DateTime)]
    created: Timestamp,
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Option<String>, format = DateTime)]
    started: Option<Timestamp>,
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Option<String>, format = DateTime)]
    finished: Option<Timestamp>,
    #[schema(value_type = String, format = DateTime)]
    updated: Timestamp,
    /// The map that is analysed.
    map_id: Id,
    /// The analysis that was made.
    #[serde(skip_serializing_if = "Option::is_none")]
    analysis_id: Option<Id>,
    /// The stage it is in.
    #[serde(skip_serializing_if = "Option::is_none")]
    stage: Option<String>,
    /// What the finished stages cost.
    stages: Vec<StageView>,
    /// How often it was begun.
    attempt: u32,
    links: Vec<Link>,
}

/// State of a job.
#[derive(Debug, Clone, Copy, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "lowercase")]
#[schema(as = StatusCode)]
pub enum JobStatus {
    /// It waits.
    Accepted,
    /// A worker has it.
    Running,
    /// Its result is there.
    Successful,
    /// It has no result; the message says why.
    Failed,
    /// It was cancelled.
    Dismissed,
}

impl From<JobState> for JobStatus {
    fn from(state: JobState) -> Self {
        match state {
            JobState::Accepted => Self::Accepted,
            JobState::Running => Self::Running,
            JobState::Successful => Self::Successful,
            JobState::Failed => Self::Failed,
            JobState::Dismissed => Self::Dismissed,
        }
    }
}

impl JobView {
    /// A stored job.
    #[must_use]
    pub fn new(job: JobRecord, links: Vec<Link>) -> Self {
        let analysis_id = job.analysis().map(Id);
        Self {
            job_id: Id(job.id),
            process_id: job.process,
            r#type: "process",
            status: job.state.into(),
            progress: job.progress,
            message: job.message,
            created: job.created,
            started: job.started,
            finished: job.finished,
            updated: job.updated,
            map_id: Id(job.map),
            analysis_id,
            stage: job.stage,
            stages: job.stages.iter().map(Into::into).collect(),
            attempt: job.attempt,
            links,
        }
    }
}
