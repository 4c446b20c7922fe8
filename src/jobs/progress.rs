//! One progress bar over all stages of an analysis.

use std::sync::{Mutex, MutexGuard, PoisonError};

use stillage_core::watch::{Observer, Stage};

use crate::stage_clock::StageClock;
use crate::store::queue::Progress;

/// Share of each stage in the time of a whole analysis, percent. The features (beams from every free cell) are most of
/// the work.
const SHARES: [(Stage, f64); 7] = [
    (Stage::Features, 50.0),
    (Stage::Categorization, 15.0),
    (Stage::Orientation, 5.0),
    (Stage::Regions, 15.0),
    (Stage::Radiography, 5.0),
    (Stage::Arrangement, 5.0),
    (Stage::Annotation, 5.0),
];

/// Where an analysis is and what its stages cost; told by its threads, asked by the heartbeat.
#[derive(Debug)]
pub(super) struct ProgressBar {
    clock: StageClock<fn(Stage, f64)>,
    position: Mutex<Position>,
}

#[derive(Debug, Default)]
struct Position {
    stage: Option<Stage>,
    percent: f64,
}

impl ProgressBar {
    pub(super) fn new() -> Self {
        Self { clock: StageClock::new(|_, _| ()), position: Mutex::default() }
    }

    /// What the row of the job says.
    pub(super) fn read(&self) -> Progress {
        let position = self.position();
        Progress {
            percent: position.percent as u8,
            stage: position.stage.map(|stage| stage.name().to_owned()),
            stages: self.clock.reports(),
        }
    }

    fn position(&self) -> MutexGuard<'_, Position> {
        // The position is whole after every statement, so a panic elsewhere does not spoil it.
        self.position.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Observer for ProgressBar {
    /// The bar never goes back.
    fn progress(&self, stage: Stage, fraction: f64) {
        self.clock.progress(stage, fraction);
        let before: f64 = SHARES.iter().take_while(|(other, _)| *other != stage).map(|(_, share)| share).sum();
        let share = SHARES.iter().find(|(other, _)| *other == stage).map_or(0.0, |(_, share)| *share);
        let mut position = self.position();
        position.stage = Some(stage);
        position.percent = position.percent.max(before + share * fraction.clamp(0.0, 1.0));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bar_runs_through_all_stages_and_never_back() {
        let bar = ProgressBar::new();
        assert_eq!(bar.read(), Progress::default());
        let after = |stage, fraction| {
            bar.progress(stage, fraction);
            (bar.read().percent, bar.read().stages.len())
        };
        assert_eq!(after(Stage::Features, 0.5), (25, 0));
        assert_eq!(after(Stage::Features, 0.2), (25, 0));
        assert_eq!(after(Stage::Features, 1.0), (50, 1));
        assert_eq!(after(Stage::Annotation, 1.0), (100, 2));
        assert_eq!(bar.read().stage.as_deref(), Some("annotation"));
    }

    #[test]
    fn the_shares_make_a_whole_in_the_order_of_the_stages() {
        assert_eq!(SHARES.map(|(stage, _)| stage), Stage::ALL);
        assert!((SHARES.iter().map(|(_, share)| share).sum::<f64>() - 100.0).abs() < 1e-9);
    }
}
