//! A map file, analysed and labelled: what `analyze` and `export` begin with.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use stillage_core::analysis::Diagnostic;
use stillage_core::layout::{self, Layout, LayoutSpec};
use stillage_core::semantics::{self, Assignment, RuleSet, SemanticMap, Suggestion};
use stillage_core::{Analysis, OccupancyGrid, SiteCells, SiteMap};

use super::computation::{self, Computed};
use super::failure::Failure;
use super::input;
use super::progress::ProgressDisplay;
use crate::app::{FileMap, MapContext};

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

/// Everything that is found in a map file.
pub(super) struct Findings {
    pub(super) name: String,
    pub(super) grid: OccupancyGrid,
    pub(super) analysis: Analysis,
    pub(super) cells: SiteCells,
    pub(super) suggestions: Vec<Suggestion>,
    pub(super) assignment: Assignment,
    pub(super) semantic: SemanticMap,
    pub(super) layout: Layout,
    /// Remarks of the ingest and the analysis.
    pub(super) diagnostics: Vec<Diagnostic>,
}

impl Findings {
    /// The map as the service reads it.
    pub(super) fn into_context(self) -> Result<MapContext, Failure> {
        let Self { name, grid, analysis, cells, assignment, semantic, .. } = self;
        let rule_set = semantic.rule_set;
        let file = FileMap { name, grid, analysis, cells, rule_set, assignment };
        MapContext::of_file(file).map_err(Failure::internal)
    }

    /// The map as layout, graph and routing read it.
    pub(super) fn site(&self) -> SiteMap<'_> {
        self.cells.map(&self.grid, &self.analysis, &self.semantic)
    }
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
        // Everything small is read first: a typing error should not cost an analysis.
        let spec = input::options(self.options.as_deref())?;
        let rule_set = input::rule_set(&self.rule_set)?;
        let assignment = self.assignment.as_deref().map(input::assignment).transpose()?;
        let source = input::map(map)?;
        let computed = computation::analyze(map, source, &spec, pool, progress)?;
        progress.clock().time("semantics", || read(input::map_name(map), computed, &rule_set, assignment))
    }
}

/// Applies the human level, or the suggestion in its place.
fn read(
    name: String,
    computed: Computed,
    rule_set: &RuleSet,
    assignment: Option<Assignment>,
) -> Result<Findings, Failure> {
    let Computed { grid, analysis, warnings: mut diagnostics } = computed;
    let suggestions = semantics::suggest(&analysis, rule_set);
    let assignment = assignment.unwrap_or_else(|| Assignment::suggested(&suggestions, rule_set));
    let semantic = semantics::apply(&analysis, rule_set, &assignment).map_err(|problems| input::misfit(&problems))?;
    let cells = SiteCells::of(&grid, &analysis);
    let layout = layout::layout(&cells.map(&grid, &analysis, &semantic), &LayoutSpec::of(&analysis.options));
    diagnostics.extend(analysis.diagnostics.iter().cloned());
    Ok(Findings { name, grid, analysis, cells, suggestions, assignment, semantic, layout, diagnostics })
}
