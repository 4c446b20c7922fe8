//! How a long computation is stopped and how it tells where it is.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use crate::stage_shares::StageShares;

/// The stages of [`crate::analyze`], in their order. The paper's decomposition has neither rooms, rows nor site plan.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Stage {
    /// Removal of lone hits, small holes and specks.
    Declutter,
    /// Beams from every free cell of a sample, or of the whole map, reduced to features.
    Features,
    /// Clustering of the features into place categories.
    Clustering,
    /// Features of the cells outside the sample, and the category of every cell.
    Categorization,
    /// Dominant orientations of the whole map.
    Orientation,
    /// Regions of one direction or texture, and their own orientations.
    Regions,
    /// Projections along the orientations, and the infinite lines of the paper's method.
    Radiography,
    /// Passages and gates of the ground, and the rooms between them (adaptive method).
    Rooms,
    /// Aisles, rows and their places, and which rooms are halls (adaptive method).
    Rows,
    /// Goods that stand in rooms, and the borders of rooms (adaptive method).
    SitePlan,
    /// Subdivision into faces and its dual graph.
    Arrangement,
    /// Categories, occupancy and evidence of faces and edges.
    Annotation,
}

impl Stage {
    /// Every stage, in order.
    pub const ALL: [Self; 12] = [
        Self::Declutter,
        Self::Features,
        Self::Clustering,
        Self::Categorization,
        Self::Orientation,
        Self::Regions,
        Self::Radiography,
        Self::Rooms,
        Self::Rows,
        Self::SitePlan,
        Self::Arrangement,
        Self::Annotation,
    ];

    /// The name used in reports and job states.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Declutter => "declutter",
            Self::Features => "features",
            Self::Clustering => "clustering",
            Self::Categorization => "categorization",
            Self::Orientation => "orientation",
            Self::Regions => "regions",
            Self::Radiography => "radiography",
            Self::Rooms => "rooms",
            Self::Rows => "rows",
            Self::SitePlan => "site-plan",
            Self::Arrangement => "arrangement",
            Self::Annotation => "annotation",
        }
    }
}

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

    /// Whether the flag is up.
    #[must_use]
    pub fn is_raised(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Told of the progress of a computation, from any of its threads.
pub trait Observer: Sync {
    /// The computation begins; its stages will take these shares of its time, by estimate.
    fn begin(&self, _shares: &StageShares) {}

    /// `stage` is done to `fraction` of its time (0 when it begins, 1 when it ends).
    fn progress(&self, stage: Stage, fraction: f64);
}

/// What a computation carries along: a stop flag to ask and an observer to tell.
#[derive(Clone, Copy)]
pub struct Watch<'a> {
    stop: Option<&'a StopFlag>,
    observer: Option<&'a dyn Observer>,
    /// Which part of its stage the work is, from and to.
    part: [f64; 2],
}

/// Highest fraction that is reported from within a stage: the end of a stage is reported by [`Watch::stage`].
const ALMOST_DONE: f64 = 0.999;

impl<'a> Watch<'a> {
    /// Watches both.
    #[must_use]
    pub fn new(stop: &'a StopFlag, observer: &'a dyn Observer) -> Self {
        Self { stop: Some(stop), observer: Some(observer), part: [0.0, 1.0] }
    }

    /// Never stops, tells nobody.
    #[must_use]
    pub const fn unwatched() -> Self {
        Self { stop: None, observer: None, part: [0.0, 1.0] }
    }

    /// Stops as this one does, but tells nobody.
    #[must_use]
    pub const fn silent(self) -> Self {
        Self { observer: None, ..self }
    }

    /// For work that is a part of a stage: its fractions from 0 to 1 become those from `from` to `to` of the whole.
    #[must_use]
    pub fn part(self, from: f64, to: f64) -> Self {
        let [start, end] = self.part;
        let within = |fraction: f64| start + (end - start) * fraction;
        Self { part: [within(from), within(to)], ..self }
    }

    /// Fails once the stop flag is raised. Ask at least every 50 ms of work.
    ///
    /// # Errors
    /// [`Stopped`] once the flag is up.
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

    /// Counts equal steps of a stage, or of the part of it that this watch is for.
    pub(crate) fn steps(self, stage: Stage, count: usize) -> Steps<'a> {
        Steps { watch: self, stage, count, done: AtomicUsize::new(0) }
    }

    /// Runs one stage between its two progress reports.
    ///
    /// # Errors
    /// [`Stopped`] when the flag was up before the stage began, or whatever the stage itself answers.
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
