//! What a kind of job is.

use std::fmt;

use serde_json::Value;
use stillage_core::{Stopped, Watch};

use crate::ingest::{IngestError, MapSource};
use crate::store::queue::JobResult;

/// What a process is, for those who choose one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ProcessDescription {
    /// Its id, under which jobs name it.
    pub id: &'static str,
    /// One line for people.
    pub title: &'static str,
    /// What it does.
    pub description: &'static str,
    /// Raised when the same map and inputs give other outputs.
    pub version: u32,
    /// What it is given beside the map of the job.
    pub inputs: &'static [Parameter],
    /// What it makes.
    pub outputs: &'static [Parameter],
}

/// An input or output of a process.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Parameter {
    /// Member of the JSON object of the inputs or outputs.
    pub name: &'static str,
    /// One line for people.
    pub title: &'static str,
    /// Name of its type among the schemas of the OpenAPI document, or a type of JSON Schema.
    pub schema: &'static str,
}

/// What a process computes on.
#[derive(Debug)]
pub struct Work<'a> {
    /// The upload of the job's map.
    pub source: &'a MapSource,
    /// The inputs, as the job holds them.
    pub inputs: &'a Value,
}

/// Why there is no result.
#[derive(Debug, thiserror::Error)]
pub enum ComputeError {
    /// Asked to stop.
    #[error(transparent)]
    Stopped(#[from] Stopped),
    /// The inputs are not those of the process.
    #[error("{0}")]
    Inputs(String),
    /// The map cannot be read with these inputs.
    #[error("the map cannot be read: {0}")]
    Map(#[from] IngestError),
    /// A defect of the program.
    #[error("the process {process} hit a defect of the program ({panic}); other jobs are not affected")]
    Panicked {
        /// Id of the process.
        process: String,
        /// Message of the panic.
        panic: String,
    },
}

/// A kind of job.
pub trait Process: fmt::Debug + Send + Sync + 'static {
    /// What it is.
    fn description(&self) -> &ProcessDescription;

    /// Computes a job. Parallel work goes to the rayon pool of the calling thread.
    ///
    /// # Errors
    /// Why there is no result. None of these errors is tried again: the same code on the same bytes does the same.
    fn compute(&self, work: &Work<'_>, watch: &Watch<'_>) -> Result<JobResult, ComputeError>;
}
