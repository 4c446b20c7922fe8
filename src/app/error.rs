//! Why a use case could not be carried out.

use serde::Serialize;
use stillage_core::semantics::{AssignmentProblem, RuleSetProblem};
use stillage_core::spec::OptionProblem;
use uuid::Uuid;

use crate::ingest::IngestError;
use crate::store::StoreError;

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

impl AppError {
    /// A value of a request that cannot be used.
    pub(crate) fn invalid(pointer: &str, detail: impl Into<String>) -> Self {
        let field = FieldProblem { pointer: pointer.to_owned(), detail: detail.into() };
        Self::Invalid { detail: field.detail.clone(), fields: vec![field] }
    }

    pub(crate) fn not_found(kind: &'static str, id: impl ToString) -> Self {
        Self::NotFound { kind, id: id.to_string() }
    }
}

impl From<StoreError> for AppError {
    fn from(error: StoreError) -> Self {
        match error {
            StoreError::NoSpace => Self::NoSpace,
            StoreError::Busy => Self::Unavailable,
            other => Self::Internal(Box::new(other)),
        }
    }
}

impl From<Vec<OptionProblem>> for AppError {
    fn from(problems: Vec<OptionProblem>) -> Self {
        let field = |problem: OptionProblem| FieldProblem {
            pointer: format!("/options{}", problem.pointer),
            detail: problem.message,
        };
        Self::Invalid {
            detail: "the options are out of range".into(),
            fields: problems.into_iter().map(field).collect(),
        }
    }
}

impl From<Vec<RuleSetProblem>> for AppError {
    fn from(problems: Vec<RuleSetProblem>) -> Self {
        let field = |problem: RuleSetProblem| FieldProblem { pointer: problem.pointer, detail: problem.message };
        Self::Invalid { detail: "the rule set is wrong".into(), fields: problems.into_iter().map(field).collect() }
    }
}

impl From<Vec<AssignmentProblem>> for AppError {
    fn from(problems: Vec<AssignmentProblem>) -> Self {
        let field = |problem: AssignmentProblem| FieldProblem { pointer: problem.pointer, detail: problem.message };
        Self::Invalid { detail: "the assignment is wrong".into(), fields: problems.into_iter().map(field).collect() }
    }
}
