//! Why a correction came to nothing.

use super::check::CorrectionProblem;
use crate::watch::Stopped;

/// Why a correction came to nothing.
#[derive(Debug)]
pub(super) enum Failure {
    /// It does not fit.
    Unfit(CorrectionProblem),
    /// The computation was stopped.
    Stopped,
}

impl Failure {
    pub fn unfit(pointer: impl Into<String>, message: impl Into<String>) -> Self {
        Self::Unfit(CorrectionProblem { pointer: pointer.into(), message: message.into() })
    }
}

impl From<CorrectionProblem> for Failure {
    fn from(problem: CorrectionProblem) -> Self {
        Self::Unfit(problem)
    }
}

impl From<Stopped> for Failure {
    fn from(_: Stopped) -> Self {
        Self::Stopped
    }
}
