//! What a piece of work costs.

use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use rustix::time::{ClockId, clock_gettime};
use stillage_core::Stage;
use stillage_core::watch::Observer;

/// CPU time of the process and wall time of a piece of work, and the most memory that the process held until its end.
#[derive(Debug, Clone, Copy)]
pub struct Cost {
    pub cpu_s: f64,
    pub wall_s: f64,
    /// Nothing where the system does not tell.
    pub peak_mib: f64,
}

impl Cost {
    /// Does a piece of work and says what it cost.
    pub fn of<T>(work: impl FnOnce() -> T) -> (T, Self) {
        let start = Start::now();
        let result = work();
        (result, start.cost())
    }
}

/// A point in time.
#[derive(Debug, Clone, Copy)]
struct Start {
    wall: Instant,
    cpu: Duration,
}

impl Start {
    fn now() -> Self {
        Self { wall: Instant::now(), cpu: cpu_time() }
    }

    fn cost(self) -> Cost {
        let cpu_s = cpu_time().saturating_sub(self.cpu).as_secs_f64();
        Cost { cpu_s, wall_s: self.wall.elapsed().as_secs_f64(), peak_mib: peak_memory_mib() }
    }
}

/// The costs of the stages of an analysis.
#[derive(Debug, Default)]
pub struct StageClock(Mutex<Vec<(Stage, Start, Option<Cost>)>>);

impl StageClock {
    /// The stages that ended, in their order.
    pub fn stages(&self) -> Vec<(Stage, Cost)> {
        let stages = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        stages.iter().filter_map(|&(stage, _, cost)| Some((stage, cost?))).collect()
    }
}

impl Observer for StageClock {
    fn progress(&self, stage: Stage, fraction: f64) {
        let mut stages = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if stages.last().is_none_or(|&(last, ..)| last != stage) {
            stages.push((stage, Start::now(), None));
        }
        if let Some((_, start, cost)) = stages.last_mut().filter(|_| fraction >= 1.0) {
            *cost = Some(start.cost());
        }
    }
}

fn cpu_time() -> Duration {
    Duration::try_from(clock_gettime(ClockId::ProcessCPUTime)).unwrap_or_default()
}

fn peak_memory_mib() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let kibibytes =
        status.lines().find_map(|line| line.strip_prefix("VmHWM:")?.trim().strip_suffix("kB")?.trim().parse().ok());
    kibibytes.unwrap_or(0.0) / 1024.0
}
