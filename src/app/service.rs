//! The service without its edges: what the use cases share.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use tokio::sync::{Semaphore, watch};
use tokio::task::JoinSet;

use super::context_cache::ContextCache;
use super::error::AppError;
use super::geometric_level::LastCorrected;
use super::keyring::Keyring;
use super::map_states::MapStates;
use super::mending::Mending;
use crate::config::Config;
use crate::jobs::processes::{AnalysisProcess, Processes};
use crate::jobs::{Signals, Worker, forget_old_entries, measure_old_blobs};
use crate::measures::Measures;
use crate::store::{self, Capacity, Full, Outdated, Store, StoreError, now};

/// A blob whose row never came is removed at a start after this time.
const ORPHAN_AGE: Duration = Duration::from_hours(24);

/// When a client may try again after finding the queue full, seconds: about the time of a job on a large map.
const RETRY_AFTER_S: u32 = 10;

/// The service without its edges.
#[derive(Debug)]
pub struct App {
    pub(super) config: Config,
    pub(super) store: Arc<dyn Store>,
    worker: Arc<Worker>,
    pub(super) signals: Arc<Signals>,
    pub(super) contexts: ContextCache,
    pub(super) states: MapStates,
    pub(super) last_corrected: LastCorrected,
    pub(super) mending: Arc<Mending>,
    /// `None` where requests need no key.
    pub(super) keyring: Option<Keyring>,
    pub(super) measures: Arc<Measures>,
    /// Bounds how many uploads and contexts are decoded at the same time, and with that their memory.
    pub(super) decoders: Semaphore,
    is_stopping: AtomicBool,
    /// Ends with the service.
    _background: JoinSet<()>,
}

impl App {
    /// Opens the store, migrates its database, takes up the jobs that an earlier process left, and starts the worker.
    pub async fn open(config: Config) -> Result<Arc<Self>, AppError> {
        let store = store::open(&config).await?;
        take_up(&*store, config.max_attempts).await?;
        let keyring = Keyring::open(&config).await?;
        if keyring.is_none() && !store.keys().keys(None).await?.is_empty() {
            tracing::warn!("there are API keys, but requests do not need one: start with --keys required");
        }
        let processes = Processes::standard(config.limits);
        Ok(Self::start(config, store, keyring, processes))
    }

    /// Starts the worker of a service on an open store.
    pub(super) fn start(
        config: Config,
        store: Arc<dyn Store>,
        keyring: Option<Keyring>,
        processes: Processes,
    ) -> Arc<Self> {
        let signals = Arc::new(Signals::default());
        let measures = Arc::new(Measures::new());
        let worker = Worker::start(&config, Arc::clone(&store), processes, Arc::clone(&signals), Arc::clone(&measures));
        let mut background = JoinSet::new();
        if store.is_shared() {
            background.spawn(pass_on_changes(Arc::clone(&store), Arc::clone(&signals)));
        }
        if keyring.is_some() {
            background.spawn(forget_old_entries(Arc::clone(&store), config.keep_audit));
        }
        background.spawn(measure_old_blobs(Arc::clone(&store)));
        let contexts = ContextCache::new(config.cached_maps);
        let decoders = Semaphore::new(config.compute_threads.max(1));
        Arc::new(Self {
            config,
            store,
            worker,
            signals,
            contexts,
            states: MapStates::default(),
            last_corrected: LastCorrected::default(),
            mending: Mending::new(),
            keyring,
            measures,
            decoders,
            is_stopping: AtomicBool::new(false),
            _background: background,
        })
    }

    /// The configuration it runs with.
    #[must_use]
    pub const fn config(&self) -> &Config {
        &self.config
    }

    /// How much there may be when something is added.
    pub(super) const fn capacity(&self) -> Capacity {
        Capacity { queued_jobs: self.config.max_queued_jobs, of_tenant: self.config.quotas }
    }

    /// Why nothing can be added.
    pub(super) fn refusal(&self, full: Full) -> AppError {
        let quotas = self.config.quotas;
        match full {
            Full::Queue => AppError::Busy { retry_after_s: RETRY_AFTER_S },
            Full::QueuedJobs => AppError::TooManyJobs { most: quotas.queued_jobs, retry_after_s: RETRY_AFTER_S },
            Full::Maps => AppError::OverQuota(format!("a tenant may have {} maps: delete some", quotas.maps)),
            Full::Bytes => AppError::OverQuota(format!("a tenant may store {} MiB: delete maps", quotas.bytes >> 20)),
        }
    }

    /// Says from now on that the service is not ready, so that nothing new is sent to it. Who follows a job is woken, so
    /// that streams can end ([`Self::is_stopping`]).
    pub fn announce_stop(&self) {
        self.is_stopping.store(true, Ordering::Relaxed);
        self.signals.changed();
    }

    /// Whether the service was asked to stop.
    #[must_use]
    pub fn is_stopping(&self) -> bool {
        self.is_stopping.load(Ordering::Relaxed)
    }

    /// Stops claiming, and lets running jobs end within the grace period or puts them back.
    pub async fn stop_jobs(&self) {
        self.announce_stop();
        self.worker.stop(self.config.shutdown_grace).await;
    }

    /// [`Self::stop_jobs`], then closes the store: the last call.
    pub async fn shutdown(&self) {
        self.stop_jobs().await;
        self.store.close().await;
    }

    /// Whether the store answers, is migrated and has space.
    pub async fn ready(&self) -> Result<(), AppError> {
        if self.is_stopping() {
            return Err(AppError::Unavailable);
        }
        Ok(self.store.check().await?)
    }

    /// Works on the queue in the calling task until no job is due, beside the configured job slots.
    pub async fn run_until_empty(&self) -> Result<(), AppError> {
        Ok(self.worker.run_until_empty().await?)
    }

    /// Wakes whenever some job changed; the receiver then reads [`Self::job`].
    #[must_use]
    pub fn job_changes(&self) -> watch::Receiver<u64> {
        self.signals.changes()
    }
}

/// Tells those who wait in this process that another one may have queued or changed a job.
async fn pass_on_changes(store: Arc<dyn Store>, signals: Arc<Signals>) {
    loop {
        store.job_changed_elsewhere().await;
        signals.queued();
    }
}

/// Takes up what earlier processes left: blobs without a row, claims of processes that are dead, analyses made by another
/// version of the algorithms.
async fn take_up(store: &dyn Store, max_attempts: u32) -> Result<(), AppError> {
    let swept = match store.sweep_blobs(ORPHAN_AGE).await {
        // A bucket that does not answer is waited for by those who need it.
        Err(error @ StoreError::Blob(_)) => {
            tracing::warn!(%error, "blobs without a row could not be removed; the next start tries again");
            0
        }
        swept => swept?,
    };
    let requeued = store.end_claims_of_dead_processes(max_attempts, now()).await?;
    if swept + usize::try_from(requeued).unwrap_or(usize::MAX) > 0 {
        tracing::info!(swept, requeued, "took up what an earlier process left");
    }
    for Outdated { tenant, map, options } in store.outdated().await? {
        tracing::info!(%map, "will be analysed again by this version of the algorithms");
        let Some(source) = store.map_source(&tenant, map).await? else { continue };
        let job = AnalysisProcess::job(map, &source, &options, true);
        store.request_analysis(&tenant, &options, &job, &Capacity::UNLIMITED, now()).await?;
    }
    Ok(())
}
