//! `stillage compare`: what changed between two maps of a site, from map files or a running service.

use std::path::{Path, PathBuf};

use super::failure::Failure;
use super::findings::AnalysisArgs;
use super::output;
use super::progress::ProgressDisplay;
use super::server;
use crate::app::{AppError, MapComparison, MapContext};
use crate::views::comparison::MapComparisonView;
use crate::views::id::Id;

/// Arguments of `stillage compare`.
#[derive(Debug, clap::Args)]
pub(super) struct CompareArgs {
    /// The map before: a file, or with --server its id.
    #[arg(value_name = "BEFORE")]
    before: String,
    /// The map now, likewise.
    #[arg(value_name = "NOW")]
    now: String,
    /// Address of a running service that has both maps: `http://localhost:8080`.
    #[arg(long, value_name = "URL")]
    server: Option<String>,
    /// The file for the JSON document; standard output when absent.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    #[command(flatten)]
    analysis: AnalysisArgs,
}

/// Runs the command.
pub(super) fn run(arguments: &CompareArgs) -> Result<(), Failure> {
    let CompareArgs { before, now, .. } = arguments;
    let bytes = match &arguments.server {
        Some(server) => {
            let map = format!("{}/v1/maps/{before}", server.trim_end_matches('/'));
            server::get(&map, &format!("compare/{now}"), &[])?
        }
        None => from_files(Path::new(before), Path::new(now), &arguments.analysis)?,
    };
    output::put(arguments.out.as_deref(), &bytes)
}

fn from_files(before: &Path, now: &Path, analysis: &AnalysisArgs) -> Result<Vec<u8>, Failure> {
    let progress = ProgressDisplay::new();
    let pool = analysis.pool()?;
    let read = |map: &Path| -> Result<MapContext, Failure> {
        progress.say(&map.display().to_string());
        Ok(analysis.find(map, &pool, &progress)?.context)
    };
    let (first, second) = (read(before)?, read(now)?);
    let made = pool.install(|| MapComparison::of(&first, &second));
    progress.finish();
    let made = made.map_err(|error| match error {
        AppError::NotSameSite(detail) => Failure::Input(detail),
        other => Failure::internal(other),
    })?;
    let view = MapComparisonView::new(Id(first.record.id), Id(second.record.id), &made);
    let mut document = serde_json::to_vec_pretty(&view).map_err(Failure::internal)?;
    document.push(b'\n');
    Ok(document)
}
