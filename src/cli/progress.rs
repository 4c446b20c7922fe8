//! Where an analysis is: a bar on a terminal, a line per stage elsewhere. Both on stderr.

use std::io::IsTerminal;
use std::sync::atomic::{AtomicUsize, Ordering};

use indicatif::{ProgressBar, ProgressStyle};
use stillage_core::Stage;
use stillage_core::stage_shares::StageShares;
use stillage_core::watch::Observer;

use crate::stage_clock::StageClock;

/// Shows and times the progress of one analysis.
pub(super) struct ProgressDisplay {
    clock: StageClock,
    /// `None` where nobody would see it move.
    bar: Option<ProgressBar>,
    /// Stages whose line was printed.
    printed: AtomicUsize,
}

impl ProgressDisplay {
    pub(super) fn new() -> Self {
        let bar = std::io::stderr().is_terminal().then(|| {
            let style = ProgressStyle::with_template("{bar:40} {percent:>3} % {msg}");
            ProgressBar::new(100).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
        });
        Self { clock: StageClock::new(), bar, printed: AtomicUsize::new(0) }
    }

    /// What the stages cost so far.
    pub(super) const fn clock(&self) -> &StageClock {
        &self.clock
    }

    /// A remark between.
    pub(super) fn say(&self, text: &str) {
        match &self.bar {
            Some(bar) => bar.suspend(|| eprintln!("{text}")),
            None => eprintln!("{text}"),
        }
    }

    pub(super) fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

impl Observer for ProgressDisplay {
    fn begin(&self, shares: &StageShares) {
        self.clock.begin(shares);
    }

    fn progress(&self, stage: Stage, fraction: f64) {
        self.clock.progress(stage, fraction);
        if let Some(bar) = &self.bar {
            bar.set_message(stage.name());
            bar.set_position(u64::from(self.clock.percent()));
            return;
        }
        // A stage may say twice that it is done.
        let done = stage as usize + 1;
        if fraction >= 1.0 && self.printed.fetch_max(done, Ordering::Relaxed) < done {
            eprintln!("{} done", stage.name());
        }
    }
}
