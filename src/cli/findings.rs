//! A map file, analysed, corrected and labelled: what `analyze`, `export` and `route` begin with.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use stillage_core::SiteCells;
use stillage_core::analysis::Diagnostic;
use stillage_core::corrections::{Correction, Outcome};
use stillage_core::semantics::{self, Assignment, RuleSet};

use super::computation::{self, Computed};
use super::failure::Failure;
use super::input;
use super::progress::ProgressDisplay;
use crate::app::{FileMap, MapContext};
use crate::http::problem::Problem;

/// How a map file is analysed and labelled.
#[derive(Debug, clap::Args)]
pub(super) struct AnalysisArgs {
    /// Labels and their rules: `site`, `warehouse`, `office`, or a JSON file.
    #[arg(long, value_name = "ID|FILE", default_value = RuleSet::DEFAULT_ID)]
    rule_set: String,
    /// JSON file with options of the analysis: a preset, and what differs from it or from the defaults.
    #[arg(long, value_name = "FILE")]
    options: Option<PathBuf>,
    /// JSON file with one label per category (`{"assignment": {"0": "co"}}`); the suggested labels when absent.
    #[arg(long, value_name = "FILE")]
    assignment: Option<PathBuf>,
    /// Threads to compute with; all cores when absent.
    #[arg(long, value_name = "N")]
    threads: Option<NonZeroUsize>,
}

/// How a map file is analysed, corrected and labelled.
#[derive(Debug, clap::Args)]
pub(super) struct CorrectedAnalysisArgs {
    #[command(flatten)]
    analysis: AnalysisArgs,
    /// JSON file with corrections, as a service answers them (`GET .../corrections`), or GeoJSON in metres of the map. Those that
    /// do not fit are told and change nothing.
    #[arg(long, value_name = "FILE")]
    corrections: Option<PathBuf>,
}

/// Everything that is found in a map file.
pub(super) struct Findings {
    /// The map as a service reads it.
    pub(super) context: MapContext,
    /// Remarks of the ingest and the analysis.
    pub(super) diagnostics: Vec<Diagnostic>,
}

impl AnalysisArgs {
    /// Threads to compute with.
    pub(super) fn pool(&self) -> Result<rayon::ThreadPool, Failure> {
        computation::pool(self.threads)
    }

    /// Analyses a map file and labels what is found.
    pub(super) fn find(
        &self,
        map: &Path,
        pool: &rayon::ThreadPool,
        progress: &ProgressDisplay,
    ) -> Result<Findings, Failure> {
        self.find_corrected(map, None, pool, progress)
    }

    fn find_corrected(
        &self,
        map: &Path,
        corrections: Option<&Path>,
        pool: &rayon::ThreadPool,
        progress: &ProgressDisplay,
    ) -> Result<Findings, Failure> {
        // Everything small is read first: a typing error should not cost an analysis.
        let spec = input::options(self.options.as_deref())?;
        let rule_set = input::rule_set(&self.rule_set)?;
        let assignment = self.assignment.as_deref().map(input::assignment).transpose()?;
        let corrections = corrections.map(|file| input::corrections(file, &rule_set)).transpose()?;
        let source = input::map(map)?;
        let computed = computation::analyze(map, source, &spec, pool, progress)?;
        let human = Human { rule_set, assignment, corrections: corrections.unwrap_or_default() };
        progress.clock().time("semantics", || pool.install(|| read(input::map_name(map), computed, human)))
    }
}

impl CorrectedAnalysisArgs {
    /// Threads to compute with.
    pub(super) fn pool(&self) -> Result<rayon::ThreadPool, Failure> {
        self.analysis.pool()
    }

    /// Analyses a map file, corrects and labels what is found, and tells the corrections that do not fit.
    pub(super) fn find(
        &self,
        map: &Path,
        pool: &rayon::ThreadPool,
        progress: &ProgressDisplay,
    ) -> Result<Findings, Failure> {
        let found = self.analysis.find_corrected(map, self.corrections.as_deref(), pool, progress)?;
        for (number, outcome) in (1..).zip(&found.context.corrections.outcomes) {
            if let Outcome::Unfit(problem) = outcome {
                progress.say(&format!("warning: correction {number} does not fit and changes nothing: {problem}"));
            }
        }
        Ok(found)
    }
}

/// What people say about a map.
struct Human {
    rule_set: RuleSet,
    assignment: Option<Assignment>,
    corrections: Vec<Correction>,
}

/// Applies the human level, or the suggestion in its place.
fn read(name: String, computed: Computed, human: Human) -> Result<Findings, Failure> {
    let Computed { grid, analysis, warnings: mut diagnostics } = computed;
    let Human { rule_set, assignment, corrections } = human;
    let suggested = || Assignment::suggested(&semantics::suggest(&analysis, &rule_set), &rule_set);
    let assignment = assignment.unwrap_or_else(suggested);
    let cells = SiteCells::of(&grid, &analysis);
    diagnostics.extend(analysis.diagnostics.iter().cloned());
    let context = MapContext::of_file(FileMap { name, grid, analysis, cells, rule_set, assignment, corrections });
    let context = context.map_err(|error| {
        Failure::Input(format!("the assignment does not fit this map: {}", Problem::from(error).message()))
    })?;
    Ok(Findings { context, diagnostics })
}
