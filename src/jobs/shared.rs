//! What the job slots of a worker share with the jobs that run in them.

use std::sync::Arc;
use std::time::Duration;

use jiff::Timestamp;
use tokio::sync::watch;
use tokio::time::Instant;

use super::contact::Contact;
use super::job_counts::JobCounts;
use super::processes::Processes;
use super::retry::backoff;
use super::signals::Signals;
use crate::store::queue::Terms;
use crate::store::{Store, StoreError};

/// A slot looks at the queue at least this often, whatever it is told: a signal is only a hint.
pub(super) const POLL: Duration = Duration::from_secs(1);

/// What the worker is configured with.
#[derive(Debug, Clone, Copy)]
pub(super) struct Settings {
    /// How long a claim lasts without a heartbeat.
    pub(super) lease: Duration,
    /// How often a job is tried in all.
    pub(super) max_attempts: u32,
    /// How many jobs of one tenant may run at the same time.
    pub(super) running_of_tenant: u64,
    pub(super) heartbeat: Duration,
    /// How long deleted maps are kept.
    pub(super) keep_deleted: Duration,
}

/// The store, the processes, and when to stop.
#[derive(Debug)]
pub(super) struct Shared {
    pub(super) store: Arc<dyn Store>,
    pub(super) processes: Processes,
    pub(super) signals: Arc<Signals>,
    pub(super) settings: Settings,
    contact: Contact,
    pub(super) counts: JobCounts,
    /// Set once: from when on running jobs are put back.
    stop_at: watch::Sender<Option<Instant>>,
}

impl Shared {
    pub(super) fn new(
        store: Arc<dyn Store>,
        processes: Processes,
        signals: Arc<Signals>,
        settings: Settings,
        counts: JobCounts,
    ) -> Self {
        // Claims are renewed after a third of their lease, and idle slots ask once in a while.
        let contact = Contact::new((settings.lease / 2).max(3 * POLL));
        Self { store, processes, signals, settings, contact, counts, stop_at: watch::Sender::new(None) }
    }

    /// The time by the clock of the store, and the terms of a claim at this time.
    pub(super) async fn now(&self) -> Result<(Timestamp, Terms), StoreError> {
        let now = self.store.clock().await?;
        let Settings { lease, max_attempts, running_of_tenant, .. } = self.settings;
        let in_touch_since = self.contact.answered(now);
        Ok((now, Terms { lease, max_attempts, running_of_tenant, backoff, in_touch_since }))
    }

    /// Asks the slots to stop; jobs that run are put back after a grace period. Only the first call counts.
    pub(super) fn stop(&self, grace: Duration) {
        self.stop_at.send_if_modified(|at| at.is_none() && at.replace(Instant::now() + grace).is_none());
    }

    /// Whether the worker was told to stop.
    pub(super) fn is_stopping(&self) -> bool {
        self.stop_at.borrow().is_some()
    }

    /// Waits for a request to stop: the end of its grace period.
    pub(super) async fn stop_requested(&self) -> Option<Instant> {
        let mut stop_at = self.stop_at.subscribe();
        // The sender lives as long as this value.
        stop_at.wait_for(Option::is_some).await.ok().and_then(|at| *at)
    }

    /// Waits for a request to stop, and for its grace period.
    pub(super) async fn grace_is_over(&self) {
        if let Some(at) = self.stop_requested().await {
            tokio::time::sleep_until(at).await;
        }
    }
}
