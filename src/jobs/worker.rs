//! The job slots: they wait for work, take it, and stop when told.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use tokio::task::JoinHandle;
use tracing::Instrument as _;

use super::compute::ComputePool;
use super::housekeeping::delete_hidden;
use super::job_counts::JobCounts;
use super::processes::Processes;
use super::running::Running;
use super::shared::{POLL, Settings, Shared};
use super::signals::Signals;
use crate::config::Config;
use crate::core_split::JobCores;
use crate::measures::Measures;
use crate::store::{Store, StoreError};

/// Works on the queue of a store.
#[derive(Debug)]
pub struct Worker {
    shared: Shared,
    threads_per_slot: usize,
    cores: Option<JobCores>,
    slots: Mutex<Vec<JoinHandle<()>>>,
}

impl Worker {
    /// A worker with its job slots running.
    #[must_use]
    pub fn start(
        config: &Config,
        store: Arc<dyn Store>,
        processes: Processes,
        signals: Arc<Signals>,
        measures: Arc<Measures>,
    ) -> Arc<Self> {
        let settings = Settings {
            lease: config.lease,
            max_attempts: config.max_attempts,
            running_of_tenant: config.quotas.running_jobs,
            heartbeat: config.heartbeat,
            keep_deleted: config.keep_deleted,
        };
        let worker = Arc::new(Self {
            shared: Shared::new(store, processes, signals, settings, JobCounts::new(measures)),
            threads_per_slot: (config.compute_threads / config.job_slots.max(1)).max(1),
            cores: config.job_cores.clone(),
            slots: Mutex::new(Vec::new()),
        });
        let slots = (0..config.job_slots).map(|_| tokio::spawn(Arc::clone(&worker).slot())).collect();
        *worker.slots() = slots;
        worker
    }

    /// Works in the calling task until no job is due. For tests and one-off commands.
    pub async fn run_until_empty(&self) -> Result<(), StoreError> {
        let pool = self.pool();
        while self.work(&pool).await? {}
        Ok(())
    }

    /// Stops claiming; jobs that run may go on for `grace` and are then put back. Returns when all slots are empty.
    pub async fn stop(&self, grace: Duration) {
        self.shared.stop(grace);
        let slots = std::mem::take(&mut *self.slots());
        for slot in slots {
            if let Err(error) = slot.await {
                tracing::error!(%error, "a job slot broke down");
            }
        }
    }

    async fn slot(self: Arc<Self>) {
        let pool = self.pool();
        while !self.shared.is_stopping() {
            match self.work(&pool).await {
                Ok(true) => continue,
                Ok(false) => {}
                Err(error) => tracing::warn!(%error, "the queue could not be worked on; it will be tried again"),
            }
            if let Err(error) = delete_hidden(&*self.shared.store, self.shared.settings.keep_deleted).await {
                tracing::warn!(%error, "deleted maps could not be removed; it will be tried again");
            }
            tokio::select! {
                () = self.shared.signals.wait_for_a_job() => {}
                () = tokio::time::sleep(POLL) => {}
                _ = self.shared.stop_requested() => {}
            }
        }
    }

    /// Takes a job and sees it to its end; `false` when none is due, or there is no room for a result.
    async fn work(&self, pool: &ComputePool) -> Result<bool, StoreError> {
        let Shared { store, signals, .. } = &self.shared;
        if let Err(error) = store.check_space() {
            tracing::warn!(%error, "no job is begun");
            return Ok(false);
        }
        let (now, terms) = self.shared.now().await?;
        let Some(claim) = store.claim(&terms, now).await? else { return Ok(false) };
        // Of the highest level, so that every line about the job has its ids.
        let (job, map, attempt) = (claim.job, claim.map, claim.attempt);
        let span = tracing::error_span!("job", %job, %map, process = claim.process, attempt);
        // More may wait: several that were queued at once are told of once, and another slot may be idle.
        signals.queued();
        Running::new(&self.shared, claim).run(pool).instrument(span).await?;
        Ok(true)
    }

    fn pool(&self) -> ComputePool {
        ComputePool::new(self.threads_per_slot, self.cores.as_ref())
    }

    fn slots(&self) -> std::sync::MutexGuard<'_, Vec<JoinHandle<()>>> {
        self.slots.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
