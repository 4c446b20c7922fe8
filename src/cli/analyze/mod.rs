//! `stillage analyze`: a map file in, a folder of layers and pictures out, without a server.

mod findings;
mod output;

use std::num::NonZeroUsize;
use std::path::PathBuf;

use stillage_core::analysis::Diagnostic;
use stillage_core::layout::{self, LayoutSpec};
use stillage_core::semantics::{self, Assignment, RuleSet};
use stillage_core::{Analysis, OccupancyGrid, SiteCells};

use super::computation::{self, Computed};
use super::failure::Failure;
use super::input;
use super::progress::ProgressDisplay;

use findings::Findings;

/// Arguments of `stillage analyze`.
#[derive(Debug, clap::Args)]
pub(super) struct AnalyzeArgs {
    /// The map: a `map_server` YAML file with its image beside it, or a `nav_msgs/OccupancyGrid` message as JSON.
    #[arg(value_name = "MAP")]
    map: PathBuf,
    /// Folder for the results; `<map name>.stillage` in the current folder when absent.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
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

/// Runs the command.
pub(super) fn run(arguments: &AnalyzeArgs) -> Result<(), Failure> {
    // Everything small is read first: a typing error should not cost an analysis.
    let spec = input::options(arguments.options.as_deref())?;
    let rule_set = input::rule_set(&arguments.rule_set)?;
    let assignment = arguments.assignment.as_deref().map(input::assignment).transpose()?;
    let source = input::map(&arguments.map)?;
    let name = input::map_name(&arguments.map);
    let folder = arguments.out.clone().unwrap_or_else(|| PathBuf::from(format!("{name}.stillage")));
    output::check(&folder)?;

    let progress = ProgressDisplay::new();
    let pool = computation::pool(arguments.threads)?;
    let Computed { grid, analysis, warnings } = computation::analyze(&arguments.map, source, &spec, &pool, &progress)?;
    let findings =
        progress.clock().time("semantics", || read_semantics(name, grid, analysis, warnings, &rule_set, assignment))?;
    progress.finish();
    output::write(&folder, &findings, &progress.clock().reports())?;
    println!("{}", folder.display());
    Ok(())
}

/// Applies the human level, or the suggestion in its place.
fn read_semantics(
    name: String,
    grid: OccupancyGrid,
    analysis: Analysis,
    mut diagnostics: Vec<Diagnostic>,
    rule_set: &RuleSet,
    assignment: Option<Assignment>,
) -> Result<Findings, Failure> {
    let suggestions = semantics::suggest(&analysis, rule_set);
    let assignment = assignment.unwrap_or_else(|| Assignment::suggested(&suggestions, rule_set));
    let semantic = semantics::apply(&analysis, rule_set, &assignment).map_err(|problems| input::misfit(&problems))?;
    let cells = SiteCells::of(&grid, &analysis);
    let layout = layout::layout(&cells.map(&grid, &analysis, &semantic), &LayoutSpec::of(&analysis.options));
    diagnostics.extend(analysis.diagnostics.iter().cloned());
    Ok(Findings { name, grid, analysis, suggestions, assignment, semantic, layout, diagnostics })
}
