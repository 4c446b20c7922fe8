//! `stillage analyze`: a map file in, a folder of layers and pictures out, without a server.

mod output;

use std::path::PathBuf;

use super::failure::Failure;
use super::findings::CorrectedAnalysisArgs;
use super::input;
use super::progress::ProgressDisplay;

/// Arguments of `stillage analyze`.
#[derive(Debug, clap::Args)]
pub(super) struct AnalyzeArgs {
    /// The map: a `map_server` YAML file with its image beside it, or a `nav_msgs/OccupancyGrid` message as JSON or as `topic echo` prints it.
    #[arg(value_name = "MAP")]
    map: PathBuf,
    /// Folder for the results; `<map name>.stillage` in the current folder when absent.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    analysis: CorrectedAnalysisArgs,
}

/// Runs the command.
pub(super) fn run(arguments: &AnalyzeArgs) -> Result<(), Failure> {
    let name = input::map_name(&arguments.map);
    let folder = arguments.out.clone().unwrap_or_else(|| PathBuf::from(format!("{name}.stillage")));
    output::check(&folder)?;
    let progress = ProgressDisplay::new();
    let findings = arguments.analysis.find(&arguments.map, &arguments.analysis.pool()?, &progress)?;
    progress.finish();
    output::write(&folder, &findings, &progress.clock().reports())?;
    println!("{}", folder.display());
    Ok(())
}
