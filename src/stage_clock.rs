//! What each stage of an analysis costs: wall clock, CPU time of the process, peak memory.
//!
//! The core knows no clock; it tells an [`Observer`] where it is. The clock listens, and passes on what it hears.

use std::sync::{Mutex, PoisonError};
use std::time::Instant;

use rustix::time::{ClockId, clock_gettime};
use stillage_core::watch::{Observer, Stage};

use crate::app::StageReport;

/// Times the stages of one analysis, and tells a listener of its progress.
#[derive(Debug)]
pub struct StageClock<L> {
    state: Mutex<State>,
    listener: L,
}

#[derive(Debug, Default)]
struct State {
    running: Option<(Stage, Start)>,
    reports: Vec<StageReport>,
}

/// When something began.
#[derive(Debug, Clone, Copy)]
struct Start {
    wall: Instant,
    cpu_s: f64,
}

impl Start {
    fn now() -> Self {
        Self { wall: Instant::now(), cpu_s: cpu_seconds() }
    }

    fn report(self, name: &str) -> StageReport {
        let wall_s = self.wall.elapsed().as_secs_f64();
        StageReport { name: name.to_owned(), wall_s, cpu_s: cpu_seconds() - self.cpu_s }
    }
}

impl<L: Fn(Stage, f64) + Sync> StageClock<L> {
    /// A clock that passes every report of progress on.
    pub fn new(listener: L) -> Self {
        Self { state: Mutex::default(), listener }
    }

    /// Times something that is no stage of the core.
    pub fn time<T>(&self, name: &str, run: impl FnOnce() -> T) -> T {
        let start = Start::now();
        let result = run();
        self.with_state(|state| state.reports.push(start.report(name)));
        result
    }

    /// What has ended so far, in the order in which it ended.
    #[must_use]
    pub fn reports(&self) -> Vec<StageReport> {
        self.with_state(|state| state.reports.clone())
    }

    /// The state is whole between any two statements: a poisoned lock does no harm.
    fn with_state<T>(&self, run: impl FnOnce(&mut State) -> T) -> T {
        run(&mut self.state.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

impl<L: Fn(Stage, f64) + Sync> Observer for StageClock<L> {
    fn progress(&self, stage: Stage, fraction: f64) {
        self.with_state(|state| {
            let start = match state.running {
                Some((running, start)) if running == stage => start,
                _ => state.running.insert((stage, Start::now())).1,
            };
            if fraction >= 1.0 {
                // A stage may say twice that it is done: the last word counts.
                state.reports.retain(|report| report.name != stage.name());
                state.reports.push(start.report(stage.name()));
            }
        });
        (self.listener)(stage, fraction);
    }
}

/// CPU time of the process so far, all threads, seconds.
fn cpu_seconds() -> f64 {
    let time = clock_gettime(ClockId::ProcessCPUTime);
    time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9
}

/// Most memory the process ever held, MiB; `None` where the system does not tell (`/proc/self/status` does on Linux).
#[must_use]
pub fn peak_rss_mib() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kibibytes: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kibibytes / 1024.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stages_are_listed_in_their_order_each_once() {
        let heard = Mutex::new(Vec::new());
        let clock = StageClock::new(|stage: Stage, fraction| heard.lock().unwrap().push((stage, fraction)));
        clock.time("ingest", || ());
        for stage in [Stage::Features, Stage::Categorization] {
            for fraction in [0.0, 0.5, 1.0, 1.0] {
                clock.progress(stage, fraction);
            }
        }
        let names: Vec<String> = clock.reports().into_iter().map(|report| report.name).collect();
        assert_eq!(names, ["ingest", "features", "categorization"]);
        assert!(clock.reports().iter().all(|report| report.wall_s >= 0.0 && report.cpu_s >= 0.0));
        assert_eq!(heard.lock().unwrap().len(), 8);
    }

    #[test]
    fn a_process_has_a_peak() {
        if cfg!(target_os = "linux") {
            assert!(peak_rss_mib().unwrap() > 1.0);
        }
    }
}
