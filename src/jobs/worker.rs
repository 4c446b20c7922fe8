//! The job slots: they wait for work, take it, and stop when told.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use tokio::sync::{Notify, watch};
use tokio::task::JoinHandle;
use tokio::time::Instant;

use super::compute::ComputePool;
use super::processes::Processes;
use super::retry::backoff;
use super::running::Running;
use crate::config::Config;
use crate::store::queue::Terms;
use crate::store::{Store, StoreError, now};

/// A slot looks at the queue at least this often, whatever it is told: a signal is only a hint.
const POLL: Duration = Duration::from_secs(1);

/// What the worker is configured with.
#[derive(Debug, Clone, Copy)]
pub(super) struct Settings {
    pub terms: Terms,
    pub heartbeat: Duration,
}

/// What happens to jobs of this process, for those who wait for it. A hint only: jobs of other processes change, too.
#[derive(Debug)]
pub struct Signals {
    changes: watch::Sender<u64>,
    queued: Notify,
}

impl Default for Signals {
    fn default() -> Self {
        Self { changes: watch::Sender::new(0), queued: Notify::new() }
    }
}

impl Signals {
    /// A job was queued.
    pub fn queued(&self) {
        self.queued.notify_one();
        self.changed();
    }

    /// Some job changed.
    pub fn changed(&self) {
        self.changes.send_modify(|count| *count = count.wrapping_add(1));
    }

    /// Wakes whenever some job changed.
    #[must_use]
    pub fn changes(&self) -> watch::Receiver<u64> {
        self.changes.subscribe()
    }
}

/// Works on the queue of a store.
#[derive(Debug)]
pub struct Worker {
    store: Arc<dyn Store>,
    processes: Processes,
    signals: Arc<Signals>,
    settings: Settings,
    threads_per_slot: usize,
    /// Set once: from when on running jobs are put back.
    stop_at: watch::Sender<Option<Instant>>,
    slots: Mutex<Vec<JoinHandle<()>>>,
}

impl Worker {
    /// A worker with its job slots running.
    #[must_use]
    pub fn start(config: &Config, store: Arc<dyn Store>, processes: Processes, signals: Arc<Signals>) -> Arc<Self> {
        let worker = Arc::new(Self {
            store,
            processes,
            signals,
            settings: Settings {
                terms: Terms { lease: config.lease, max_attempts: config.max_attempts, backoff },
                heartbeat: config.heartbeat,
            },
            threads_per_slot: (config.compute_threads / config.job_slots.max(1)).max(1),
            stop_at: watch::Sender::new(None),
            slots: Mutex::new(Vec::new()),
        });
        let slots = (0..config.job_slots).map(|_| tokio::spawn(Arc::clone(&worker).slot())).collect();
        *worker.slots() = slots;
        worker
    }

    /// Works in the calling task until no job is due. For tests and one-off commands.
    pub async fn run_until_empty(&self) -> Result<(), StoreError> {
        let pool = ComputePool::new(self.threads_per_slot);
        while self.work(&pool).await? {}
        Ok(())
    }

    /// Stops claiming; jobs that run may go on for `grace` and are then put back. Returns when all slots are empty.
    pub async fn stop(&self, grace: Duration) {
        self.stop_at.send_if_modified(|at| at.is_none() && at.replace(Instant::now() + grace).is_none());
        let slots = std::mem::take(&mut *self.slots());
        for slot in slots {
            if let Err(error) = slot.await {
                tracing::error!(%error, "a job slot broke down");
            }
        }
    }

    /// Whether the worker was told to stop.
    #[must_use]
    pub fn is_stopping(&self) -> bool {
        self.stop_at.borrow().is_some()
    }

    pub(super) fn store(&self) -> &dyn Store {
        &*self.store
    }

    pub(super) const fn processes(&self) -> &Processes {
        &self.processes
    }

    pub(super) fn signals(&self) -> &Signals {
        &self.signals
    }

    pub(super) const fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Waits for a request to stop, and for its grace period.
    pub(super) async fn grace_is_over(&self) {
        let mut stop_at = self.stop_at.subscribe();
        // The sender lives as long as this worker.
        let Ok(Some(at)) = stop_at.wait_for(Option::is_some).await.map(|at| *at) else { return };
        tokio::time::sleep_until(at).await;
    }

    async fn slot(self: Arc<Self>) {
        let pool = ComputePool::new(self.threads_per_slot);
        let mut stop_at = self.stop_at.subscribe();
        while !self.is_stopping() {
            match self.work(&pool).await {
                Ok(true) => continue,
                Ok(false) => {}
                Err(error) => tracing::warn!(%error, "the queue could not be worked on; it will be tried again"),
            }
            tokio::select! {
                () = self.signals.queued.notified() => {}
                () = tokio::time::sleep(POLL) => {}
                _ = stop_at.wait_for(Option::is_some) => {}
            }
        }
    }

    /// Takes a job and sees it to its end; `false` when none is due, or there is no room for a result.
    async fn work(&self, pool: &ComputePool) -> Result<bool, StoreError> {
        if let Err(error) = self.store.check_space() {
            tracing::warn!(%error, "no job is begun");
            return Ok(false);
        }
        let Some(claim) = self.store.claim(&self.settings.terms, now()).await? else { return Ok(false) };
        tracing::info!(job = %claim.job, process = claim.process, map = %claim.map, attempt = claim.attempt, "job begun");
        self.signals.changed();
        Running::new(self, claim).run(pool).await?;
        Ok(true)
    }

    fn slots(&self) -> std::sync::MutexGuard<'_, Vec<JoinHandle<()>>> {
        self.slots.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
