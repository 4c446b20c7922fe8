//! What each stage of an analysis costs, and how far it is.
//!
//! The core knows no clock; it tells an [`Observer`] where it is, and this is one.

use std::sync::Mutex;
use std::time::{Duration, Instant};

use stillage_core::stage_shares::StageShares;
use stillage_core::watch::{Observer, Stage};

use crate::measures::cpu_time;
use crate::records::StageReport;

/// An observer with a clock: wall time and CPU time of the process, by stage.
///
/// CPU time is that of the whole process, so it includes what else ran at the time.
#[derive(Debug, Default)]
pub struct StageClock(Mutex<Times>);

#[derive(Debug, Default)]
struct Times {
    finished: Vec<StageReport>,
    running: Option<RunningStage>,
    shares: StageShares,
}

#[derive(Debug)]
struct RunningStage {
    stage: Stage,
    fraction: f64,
    wall: Instant,
    cpu: Duration,
}

impl StageClock {
    /// A clock before its first stage.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The stages that ended, in their order.
    #[must_use]
    pub fn reports(&self) -> Vec<StageReport> {
        self.times().finished.clone()
    }

    /// The stage that runs, if one does.
    #[must_use]
    pub fn stage(&self) -> Option<Stage> {
        self.times().running.as_ref().filter(|running| running.fraction < 1.0).map(|running| running.stage)
    }

    /// How much of the whole analysis is done, 0 to 100.
    #[must_use]
    pub fn percent(&self) -> u8 {
        let times = self.times();
        let is_finished = |stage: &&Stage| times.finished.iter().any(|report| report.name == stage.name());
        let finished: f64 = Stage::ALL.iter().filter(is_finished).map(|&stage| times.shares.of(stage)).sum();
        let running = times.running.as_ref().filter(|running| running.fraction < 1.0);
        let running = running.map_or(0.0, |running| times.shares.of(running.stage) * running.fraction);
        (100.0 * (finished + running)).clamp(0.0, 100.0) as u8
    }

    /// Times something that is no stage of the core.
    pub fn time<T>(&self, name: &str, run: impl FnOnce() -> T) -> T {
        let (wall, cpu) = (Instant::now(), cpu_time());
        let result = run();
        self.times().finished.push(StageReport {
            name: name.to_owned(),
            wall_s: wall.elapsed().as_secs_f64(),
            cpu_s: cpu_time().saturating_sub(cpu).as_secs_f64(),
        });
        result
    }

    fn times(&self) -> std::sync::MutexGuard<'_, Times> {
        // The times are whole after every statement, so a panic elsewhere does not spoil them.
        self.0.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
    }
}

impl Observer for StageClock {
    fn begin(&self, shares: &StageShares) {
        self.times().shares = *shares;
    }

    fn progress(&self, stage: Stage, fraction: f64) {
        let mut times = self.times();
        if times.running.as_ref().is_none_or(|running| running.stage != stage) {
            times.running = Some(RunningStage { stage, fraction: 0.0, wall: Instant::now(), cpu: cpu_time() });
        }
        let Some(running) = times.running.as_mut() else { return };
        running.fraction = running.fraction.max(fraction);
        if fraction < 1.0 {
            return;
        }
        let report = StageReport {
            name: stage.name().to_owned(),
            wall_s: running.wall.elapsed().as_secs_f64(),
            cpu_s: cpu_time().saturating_sub(running.cpu).as_secs_f64(),
        };
        // A stage may say more than once that it is done: its loop does, and its end. The last word counts.
        match times.finished.iter_mut().find(|finished| finished.name == report.name) {
            Some(earlier) => *earlier = report,
            None => times.finished.push(report),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stage_is_reported_when_it_ends() {
        let clock = StageClock::new();
        clock.progress(Stage::Features, 0.0);
        clock.progress(Stage::Features, 0.5);
        assert_eq!((clock.stage(), clock.percent(), clock.reports().len()), (Some(Stage::Features), 4, 0));
        clock.progress(Stage::Features, 1.0);
        assert_eq!((clock.stage(), clock.percent()), (None, 8));
        assert_eq!(clock.reports()[0].name, "features");
    }

    #[test]
    fn a_stage_that_ends_twice_is_reported_once() {
        let clock = StageClock::new();
        for fraction in [0.0, 1.0, 1.0] {
            clock.progress(Stage::Features, fraction);
        }
        assert_eq!((clock.percent(), clock.reports().len()), (8, 1));
    }
}
