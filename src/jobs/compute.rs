//! The computation of a job, on threads of its own.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

use serde_json::Value;
use stillage_core::{StopFlag, Watch};
use tokio::sync::oneshot;

use super::processes::{ComputeError, Process, Work};
use crate::core_split::JobCores;
use crate::ingest::{IngestError, MapSource, Refusal};
use crate::stage_clock::StageClock;
use crate::store::Blob;
use crate::store::queue::JobResult;

/// By how much the system prefers the threads that answer requests. A read waits for no time slice of a job then.
#[cfg(target_os = "linux")]
const NICENESS: i32 = 10;

/// The threads of one job slot.
///
/// Each slot has its own, because a thread of a shared pool that waits for its part of one job may pick up another job
/// whole, and the first one would stand still meanwhile.
#[derive(Debug)]
pub(super) struct ComputePool(rayon::ThreadPool);

impl ComputePool {
    /// So many threads, on cores of their own where jobs have such.
    pub(super) fn new(threads: usize, cores: Option<&JobCores>) -> Self {
        let cores = cores.cloned();
        let begin = move |_| {
            cores.iter().for_each(JobCores::bind);
            let_others_go_first();
        };
        let name = |thread| format!("compute-{thread}");
        let builder = rayon::ThreadPoolBuilder::new().num_threads(threads.max(1)).thread_name(name);
        Self(builder.start_handler(begin).build().expect("the operating system gives a few threads at the start"))
    }

    /// Starts a computation; its result comes through the channel, a panic as an error.
    pub(super) fn start(&self, task: Task) -> oneshot::Receiver<Result<JobResult, ComputeError>> {
        let (sender, receiver) = oneshot::channel();
        self.0.spawn(move || {
            // What a panic leaves behind is dropped with the task; the clock is only read.
            let process = task.process.description().id.to_owned();
            let result = catch_unwind(AssertUnwindSafe(|| task.run()));
            let panicked =
                |panic: Box<dyn Any + Send>| ComputeError::Panicked { process, panic: panic_message(&*panic) };
            // The receiver is gone only when the result is not wanted any more.
            let _ = sender.send(result.unwrap_or_else(|panic| Err(panicked(panic))));
        });
        receiver
    }
}

/// Linux keeps a niceness for each thread, and 0 means the one that asks; elsewhere it is that of the whole process.
fn let_others_go_first() {
    #[cfg(target_os = "linux")]
    if let Err(error) = rustix::process::setpriority_process(None, NICENESS) {
        tracing::debug!(%error, "jobs compete with requests");
    }
}

/// A computation and what it is given.
#[derive(Debug)]
pub(super) struct Task {
    pub process: Arc<dyn Process>,
    pub inputs: Value,
    pub source: Blob,
    pub stop: StopFlag,
    pub clock: Arc<StageClock>,
}

impl Task {
    fn run(self) -> Result<JobResult, ComputeError> {
        let source: MapSource = self.source.decode().map_err(|error| IngestError {
            refusal: Refusal::Invalid,
            pointer: String::new(),
            message: error.to_string(),
        })?;
        let work = Work { source: &source, inputs: &self.inputs };
        self.process.compute(&work, &Watch::new(&self.stop, &*self.clock))
    }
}

fn panic_message(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_else(|| "no message".to_owned())
}
