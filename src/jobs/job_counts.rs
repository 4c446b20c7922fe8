//! What becomes of the jobs of a worker, counted.

use std::sync::Arc;
use std::time::Duration;

use crate::measures::{JOB_ATTEMPTS, JOB_DURATION, JOB_ENDS, JOB_STAGES, Measures};
use crate::records::{JobState, StageReport};

/// How the work of this process on a job ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum AttemptEnd {
    /// The job ended so.
    Job(JobState),
    /// It will be tried again.
    Requeued,
    /// The process stops.
    GivenBack,
    /// Somebody else has it, or its map is gone.
    Lost,
}

impl AttemptEnd {
    const ALL: [Self; 6] = [
        Self::Job(JobState::Successful),
        Self::Job(JobState::Failed),
        Self::Job(JobState::Dismissed),
        Self::Requeued,
        Self::GivenBack,
        Self::Lost,
    ];

    const fn name(self) -> &'static str {
        match self {
            Self::Job(state) => state.name(),
            Self::Requeued => "requeued",
            Self::GivenBack => "given-back",
            Self::Lost => "lost",
        }
    }
}

/// What becomes of the jobs of a worker.
#[derive(Debug)]
pub(super) struct JobCounts(Arc<Measures>);

impl JobCounts {
    /// Counts on the measures of a service.
    pub(super) fn new(measures: Arc<Measures>) -> Self {
        measures.counter(JOB_ATTEMPTS, &[]).absolute(0);
        for end in AttemptEnd::ALL {
            measures.counter(JOB_ENDS, &[("end", end.name())]).absolute(0);
        }
        Self(measures)
    }

    pub(super) fn begun(&self) {
        self.0.counter(JOB_ATTEMPTS, &[]).increment(1);
    }

    pub(super) fn ended(&self, end: AttemptEnd, after: Duration) {
        self.0.counter(JOB_ENDS, &[("end", end.name())]).increment(1);
        self.0.histogram(JOB_DURATION, &[]).record(after.as_secs_f64());
    }

    pub(super) fn stages(&self, stages: &[StageReport]) {
        for stage in stages {
            self.0.histogram(JOB_STAGES, &[("stage", &stage.name)]).record(stage.wall_s);
        }
    }
}
