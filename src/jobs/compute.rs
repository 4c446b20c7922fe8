//! The computation of a job, on threads of its own.

use std::any::Any;
use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

use stillage_core::analysis::Diagnostic;
use stillage_core::{AnalysisSpec, StopFlag, Stopped, Watch};
use tokio::sync::oneshot;

use crate::fail_point;
use crate::ingest::{self, IngestError, Limits, MapSource};
use crate::stage_clock::StageClock;
use crate::store::Blob;

/// A result, encoded.
#[derive(Debug, Clone)]
pub struct Computed {
    /// The [`stillage_core::Analysis`].
    pub analysis: Blob,
    /// Its remarks.
    pub diagnostics: Vec<Diagnostic>,
}

/// Why there is no result.
#[derive(Debug, thiserror::Error)]
pub enum ComputeError {
    /// Asked to stop.
    #[error(transparent)]
    Stopped(#[from] Stopped),
    /// The map cannot be read with these options.
    #[error("the map cannot be read: {0}")]
    Map(#[from] IngestError),
    /// A defect of the program.
    #[error("the analysis hit a defect of the program ({0}); other jobs are not affected")]
    Panicked(String),
}

/// What a job does with an upload.
pub trait Compute: fmt::Debug + Send + Sync + 'static {
    /// Runs the job. Parallel work goes to the rayon pool of the calling thread.
    fn compute(&self, source: &MapSource, spec: &AnalysisSpec, watch: &Watch<'_>) -> Result<Computed, ComputeError>;
}

/// Reads the map and analyses it.
#[derive(Debug, Clone, Copy)]
pub struct Analyzer {
    /// Limits of the ingest.
    pub limits: Limits,
}

impl Compute for Analyzer {
    fn compute(&self, source: &MapSource, spec: &AnalysisSpec, watch: &Watch<'_>) -> Result<Computed, ComputeError> {
        let map = ingest::decode(source, &spec.options().grid, &self.limits)?;
        fail_point::pass("during-compute");
        let analysis = stillage_core::analyze(&map.grid, spec, watch)?;
        drop(map);
        Ok(Computed { analysis: Blob::encode(&analysis), diagnostics: analysis.diagnostics })
    }
}

/// The threads of one job slot.
///
/// Each slot has its own, because a thread of a shared pool that waits for its part of one job may pick up another job
/// whole, and the first one would stand still meanwhile.
#[derive(Debug)]
pub(super) struct ComputePool(rayon::ThreadPool);

impl ComputePool {
    pub(super) fn new(threads: usize) -> Self {
        let build = |threads| {
            let name = |thread| format!("compute-{thread}");
            rayon::ThreadPoolBuilder::new().num_threads(threads).thread_name(name).build()
        };
        Self(build(threads.max(1)).expect("the operating system gives a few threads at the start"))
    }

    /// Starts a computation; its result comes through the channel, a panic as an error.
    pub(super) fn start(&self, task: Task) -> oneshot::Receiver<Result<Computed, ComputeError>> {
        let (sender, receiver) = oneshot::channel();
        self.0.spawn(move || {
            // What a panic leaves behind is dropped with the task; the clock is only read.
            let result = catch_unwind(AssertUnwindSafe(|| task.run()));
            // The receiver is gone only when nobody wants the result any more.
            let _ = sender.send(result.unwrap_or_else(|panic| Err(ComputeError::Panicked(panic_message(&*panic)))));
        });
        receiver
    }
}

/// A computation and what it is given.
#[derive(Debug)]
pub(super) struct Task {
    pub compute: Arc<dyn Compute>,
    pub source: Blob,
    pub spec: AnalysisSpec,
    pub stop: StopFlag,
    pub clock: Arc<StageClock>,
}

impl Task {
    fn run(self) -> Result<Computed, ComputeError> {
        let source: MapSource = self.source.decode().map_err(|error| IngestError {
            refusal: ingest::Refusal::Invalid,
            pointer: String::new(),
            message: error.to_string(),
        })?;
        self.compute.compute(&source, &self.spec, &Watch::new(&self.stop, &*self.clock))
    }
}

fn panic_message(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_else(|| "no message".to_owned())
}
