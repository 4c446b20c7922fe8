//! Where the analysis is: a bar on a terminal, a line per stage elsewhere. Both on stderr.

use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use stillage_core::Stage;

/// Steps of the bar per stage.
const STEPS: u64 = 100;

/// Shows the progress of one analysis.
pub(super) struct Progress {
    /// `None` where nobody would see it move.
    bar: Option<ProgressBar>,
}

impl Progress {
    pub(super) fn new() -> Self {
        let bar = std::io::stderr().is_terminal().then(|| {
            let style = ProgressStyle::with_template("{bar:40} {percent:>3} % {msg}");
            ProgressBar::new(STEPS * Stage::ALL.len() as u64)
                .with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
        });
        Self { bar }
    }

    /// A stage is done to a fraction.
    pub(super) fn show(&self, stage: Stage, fraction: f64) {
        let Some(bar) = &self.bar else {
            if fraction >= 1.0 {
                eprintln!("{} done", stage.name());
            }
            return;
        };
        bar.set_message(stage.name());
        bar.set_position(stage as u64 * STEPS + (fraction.clamp(0.0, 1.0) * STEPS as f64) as u64);
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
