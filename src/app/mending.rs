//! Analyses whose blob is damaged or missing are made again, beside the requests: an analysis follows from its upload and its
//! options to the byte.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use stillage_core::{StopFlag, Watch};
use tokio::sync::Semaphore;
use uuid::Uuid;

use super::{AnalysisRecord, AppError};
use crate::config::Config;
use crate::ingest::MapSource;
use crate::jobs::processes::{AnalysisProcess, Process as _, Work};
use crate::stage_clock::StageClock;
use crate::store::queue::JobResult;
use crate::store::{Blob, BlobId, Store};

/// The analyses that are being made again.
#[derive(Debug)]
pub(super) struct Mending {
    /// One at a time: the job slots have the cores.
    turn: Semaphore,
    states: Mutex<HashMap<Uuid, MendingState>>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum MendingState {
    UnderWay,
    /// It came out otherwise, or not at all.
    Failed,
}

impl Mending {
    /// Nothing is damaged.
    pub(super) fn new() -> Arc<Self> {
        Arc::new(Self { turn: Semaphore::new(1), states: Mutex::default() })
    }

    fn states(&self) -> MutexGuard<'_, HashMap<Uuid, MendingState>> {
        // Every statement on it leaves it whole.
        self.states.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Begins to make a damaged analysis again, unless that is under way or was in vain; what to tell until then.
    pub(super) fn begin(
        self: &Arc<Self>,
        (store, config): (&Arc<dyn Store>, &Config),
        source: &Blob,
        (record, id): (&AnalysisRecord, &BlobId),
        reason: &str,
    ) -> AppError {
        let damaged = format!("the stored analysis {} of map {} is damaged ({reason})", record.id, record.map);
        match self.states().entry(record.id) {
            Entry::Occupied(state) if *state.get() == MendingState::Failed => {
                return AppError::Damaged(format!(
                    "{damaged} and could not be made again as it was: analyse the map with another seed, and activate that"
                ));
            }
            Entry::Occupied(_) => {}
            Entry::Vacant(state) => {
                state.insert(MendingState::UnderWay);
                tracing::warn!(map = %record.map, analysis = %record.id, reason, "a damaged analysis is made again");
                let (mending, store, config) = (Arc::clone(self), Arc::clone(store), config.clone());
                let (source, record, id) = (source.clone(), record.clone(), id.clone());
                tokio::spawn(async move { mending.make_again(&*store, config, source, &record, &id).await });
            }
        }
        AppError::BeingMended(format!("{damaged} and is being made again: try again in a while"))
    }

    async fn make_again(&self, store: &dyn Store, config: Config, source: Blob, record: &AnalysisRecord, id: &BlobId) {
        let Ok(_turn) = self.turn.acquire().await else { return };
        let inputs = AnalysisProcess::job(record.map, source.id(), &record.options, false).inputs;
        let compute = move || {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(config.compute_threads.max(1)).build().ok()?;
            let source: MapSource = source.decode().ok()?;
            let (process, stop) = (AnalysisProcess { limits: config.limits }, StopFlag::default());
            let work = Work { source: &source, inputs: &inputs };
            match pool.install(|| process.compute(&work, &Watch::new(&stop, &StageClock::new()))) {
                Ok(JobResult::Analysis(_, blob)) => Some(blob),
                _ => None,
            }
        };
        // A panic is a failure, too.
        let made = tokio::task::spawn_blocking(compute).await.ok().flatten().filter(|blob| blob.id() == id);
        let is_mended = match &made {
            Some(blob) => store.blobs().put(blob).await.is_ok(),
            None => false,
        };
        tracing::info!(map = %record.map, analysis = %record.id, is_mended, "the damaged analysis was made again");
        if is_mended {
            self.states().remove(&record.id);
        } else {
            self.states().insert(record.id, MendingState::Failed);
        }
    }
}
