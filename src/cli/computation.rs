//! A map file, analysed: what `findings` and `evaluate` begin with.

use std::num::NonZeroUsize;
use std::path::Path;

use stillage_core::analysis::Diagnostic;
use stillage_core::watch::{StopFlag, Watch};
use stillage_core::{Analysis, AnalysisSpec, OccupancyGrid};

use super::failure::Failure;
use super::input;
use super::progress::ProgressDisplay;
use crate::ingest::{self, DecodedMap, Limits, MapSource};

/// A map with its analysis.
pub(super) struct Computed {
    pub(super) grid: OccupancyGrid,
    pub(super) analysis: Analysis,
    /// Remarks of the ingest.
    pub(super) warnings: Vec<Diagnostic>,
}

/// Threads to compute with; all cores where nothing is said.
pub(super) fn pool(threads: Option<NonZeroUsize>) -> Result<rayon::ThreadPool, Failure> {
    let mut pool = rayon::ThreadPoolBuilder::new();
    if let Some(threads) = threads {
        pool = pool.num_threads(threads.get());
    }
    pool.build().map_err(|error| Failure::Internal(format!("no threads to compute with: {error}")))
}

/// Decodes and analyses a map.
pub(super) fn analyze(
    path: &Path,
    source: MapSource,
    spec: &AnalysisSpec,
    pool: &rayon::ThreadPool,
    progress: &ProgressDisplay,
) -> Result<Computed, Failure> {
    let decoded = progress.clock().time("ingest", || ingest::decode(&source, &spec.options().grid, &Limits::default()));
    let DecodedMap { grid, warnings } = decoded.map_err(|error| input::refused(path, &error))?;
    drop(source);
    for warning in &warnings {
        progress.say(&format!("warning: {}", warning.message));
    }
    let stop = StopFlag::default();
    let analysis = pool
        .install(|| stillage_core::analyze(&grid, spec, &Watch::new(&stop, progress)))
        .map_err(|error| Failure::Internal(error.to_string()))?;
    Ok(Computed { grid, analysis, warnings })
}
