//! Stopping a long computation, and reporting its progress.

mod stage;

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

pub use stage::{Stage, StageShares};

/// The computation was asked to stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the computation was stopped")]
pub struct Stopped;

/// A flag that any thread may raise; clones share it.
#[derive(Debug, Clone, Default)]
pub struct StopFlag(Arc<AtomicBool>);

impl StopFlag {
    /// Asks every computation that watches this flag to stop.
    pub fn raise(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether the flag is raised.
    #[must_use]
    pub fn is_raised(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Receives the progress of a computation, from any of its threads.
pub trait Observer: Sync {
    /// The computation begins; these are the estimated shares of its stages in its time.
    fn begin(&self, _shares: &StageShares) {}

    /// `stage` is done to `fraction` of its time (0 when it begins, 1 when it ends).
    fn progress(&self, stage: Stage, fraction: f64);
}

/// A stop flag that a computation checks, and an observer that it reports to.
#[derive(Clone, Copy)]
pub struct Watch<'a> {
    stop: Option<&'a StopFlag>,
    observer: Option<&'a dyn Observer>,
    /// The part of its stage that the work is: from and to, 0 to 1.
    part: [f64; 2],
}

/// Highest fraction that is reported from within a stage: the end of a stage is reported by [`Watch::stage`].
const ALMOST_DONE: f64 = 0.999;

impl<'a> Watch<'a> {
    /// A watch with a stop flag and an observer.
    #[must_use]
    pub fn new(stop: &'a StopFlag, observer: &'a dyn Observer) -> Self {
        Self { stop: Some(stop), observer: Some(observer), part: [0.0, 1.0] }
    }

    /// A watch that never stops and reports to nobody.
    #[must_use]
    pub const fn unwatched() -> Self {
        Self { stop: None, observer: None, part: [0.0, 1.0] }
    }

    /// The same stop flag without an observer.
    #[must_use]
    pub const fn silent(self) -> Self {
        Self { observer: None, ..self }
    }

    /// The watch for a part of this work: its fractions 0 to 1 become `from` to `to` of the whole.
    #[must_use]
    pub fn part(self, from: f64, to: f64) -> Self {
        let [start, end] = self.part;
        let within = |fraction: f64| start + (end - start) * fraction;
        Self { part: [within(from), within(to)], ..self }
    }

    /// Fails once the stop flag is raised. To be called at least every 50 ms of work.
    ///
    /// # Errors
    /// [`Stopped`] once the flag is raised.
    pub fn check(&self) -> Result<(), Stopped> {
        if self.stop.is_some_and(StopFlag::is_raised) { Err(Stopped) } else { Ok(()) }
    }

    /// Reports the shares of the stages, before the first one.
    pub(crate) fn begin(&self, shares: &StageShares) {
        if let Some(observer) = self.observer {
            observer.begin(shares);
        }
    }

    /// Reports progress within a stage.
    pub fn progress(&self, stage: Stage, fraction: f64) {
        let [start, end] = self.part;
        self.report(stage, (start + (end - start) * fraction).min(ALMOST_DONE));
    }

    fn report(&self, stage: Stage, fraction: f64) {
        if let Some(observer) = self.observer {
            observer.progress(stage, fraction);
        }
    }

    /// A counter of `count` equal steps of a stage, or of the part of it that this watch is for.
    pub(crate) fn steps(self, stage: Stage, count: usize) -> Steps<'a> {
        Steps { watch: self, stage, count, done: AtomicUsize::new(0) }
    }

    /// Runs one stage between its two progress reports.
    ///
    /// # Errors
    /// [`Stopped`] when the flag is raised before the stage begins or during it.
    pub fn stage<T>(&self, stage: Stage, run: impl FnOnce() -> Result<T, Stopped>) -> Result<T, Stopped> {
        self.check()?;
        self.report(stage, 0.0);
        let result = run()?;
        self.report(stage, 1.0);
        Ok(result)
    }
}

/// Equal steps of a stage, done in any order by any thread.
#[derive(Debug)]
pub(crate) struct Steps<'a> {
    watch: Watch<'a>,
    stage: Stage,
    count: usize,
    done: AtomicUsize,
}

impl Steps<'_> {
    /// Counts one more step and reports it.
    pub(crate) fn count_one(&self) {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        self.watch.progress(self.stage, done as f64 / self.count as f64);
    }
}

impl std::fmt::Debug for Watch<'_> {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("Watch").field("stop", &self.stop).finish_non_exhaustive()
    }
}
