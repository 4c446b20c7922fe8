//! What happened to the stores of this process since it began, for the metrics.

use std::sync::atomic::{AtomicU64, Ordering};

static BUSY_CALLS: AtomicU64 = AtomicU64::new(0);
static RESCUED_JOBS: AtomicU64 = AtomicU64::new(0);

/// Calls that a database did not answer because it was busy or away.
#[must_use]
pub fn busy_calls() -> u64 {
    BUSY_CALLS.load(Ordering::Relaxed)
}

/// Jobs that were taken from a worker that was gone.
#[must_use]
pub fn rescued_jobs() -> u64 {
    RESCUED_JOBS.load(Ordering::Relaxed)
}

pub(super) fn count_busy_call() {
    BUSY_CALLS.fetch_add(1, Ordering::Relaxed);
}

pub(super) fn count_rescued_job() {
    RESCUED_JOBS.fetch_add(1, Ordering::Relaxed);
}
