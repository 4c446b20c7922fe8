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
    /// For people.
    pub detail: String,
}

/// Why a use case could not be carried out.
#[derive(Debug, thiserror::Error)]
pub enum AppError {
    /// There is no such thing.
    #[error("there is no {kind} {id}")]
    NotFound {
        /// What was looked for.
        kind: &'static str,
        /// Under which id.
        id: String,
    },
    /// The map is there, its analysis is not.
    #[error("map {map} has no finished analysis yet: see job {job:?}")]
    NotAnalysed {
        /// The map.
        map: Uuid,
        /// Its newest job.
        job: Option<Uuid>,
    },
    /// Something in the request is wrong.
    #[error("{detail}")]
    Invalid {
        /// For people.
        detail: String,
        /// The fields that are wrong, when it is fields.
        fields: Vec<FieldProblem>,
    },
    /// The upload cannot be read.
    #[error(transparent)]
    Ingest(#[from] IngestError),
    /// No key, or one that opens nothing.
    #[error("{0}")]
    Unauthorized(String),
    /// Somebody changed the resource since it was read.
    #[error("the resource is at version {current}, not at the one in If-Match")]
    PreconditionFailed {
        /// The version it is at.
        current: u64,
    },
    /// The write does not say what it replaces.
    #[error("this write needs an If-Match header with the ETag that was read")]
    PreconditionRequired,
    /// Two maps that were to be of one site are not.
    #[error("{0}")]
    NotSameSite(String),
    /// Against the state of the resource.
    #[error("{0}")]
    Conflict(String),
    /// Needs more than is configured: memory of a job.
    #[error("{0}")]
    TooLarge(String),
    /// As many jobs wait as may.
    #[error("the queue is full: try again in {retry_after_s} s")]
    Busy {
        /// When to try again, seconds.
        retry_after_s: u32,
    },
    /// As many jobs of the tenant wait as may.
    #[error("{most} jobs of a tenant may wait at the same time: try again in {retry_after_s} s")]
    TooManyJobs {
        /// As many.
        most: u64,
        /// When to try again, seconds.
        retry_after_s: u32,
    },
    /// The tenant has as much as it may.
    #[error("{0}")]
    OverQuota(String),
    /// Below the floor of free space.
    #[error("the server is short of disk space")]
    NoSpace,
    /// The database is held by somebody else, or the service is about to stop.
    #[error("the store cannot be reached")]
    Unavailable,
    /// What was stored is not what was written, and cannot be made again.
    #[error("{0}")]
    Damaged(String),
    /// The same of what is being made again.
    #[error("{0}")]
    BeingMended(String),
    /// For the log, not for clients.
    #[error("internal error")]
    Internal(#[source] Box<dyn std::error::Error + Send + Sync>),
}

impl AppError {
    /// Whether the same may succeed later without anyone mending anything by hand.
    pub(crate) fn is_transient(&self) -> bool {
        match self {
            Self::Unavailable | Self::NoSpace | Self::Busy { .. } => true,
            Self::Internal(source) => source.downcast_ref::<StoreError>().is_some_and(StoreError::is_transient),
            _ => false,
        }
    }

    /// A value of a request that cannot be used.
    pub(crate) fn invalid(pointer: &str, detail: impl Into<String>) -> Self {
        let field = FieldProblem { pointer: pointer.to_owned(), detail: detail.into() };
        Self::Invalid { detail: field.detail.clone(), fields: vec![field] }
    }

    /// The same of values that lie below a pointer in the request.
    pub(crate) fn below(mut self, pointer: &str) -> Self {
        if let Self::Invalid { fields, .. } = &mut self {
            for field in fields {
                field.pointer.insert_str(0, pointer);
            }
        }
        self
    }

    pub(crate) fn not_found(kind: &'static str, id: impl Into<String>) -> Self {
        Self::NotFound { kind, id: id.into() }
    }
}

impl From<StoreError> for AppError {
    fn from(error: StoreError) -> Self {
        match error {
            StoreError::NoSpace => Self::NoSpace,
            StoreError::Busy | StoreError::Blob(_) => Self::Unavailable,
            unreadable @ StoreError::Format { .. } => Self::Conflict(unreadable.to_string()),
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
