//! `stillage export`: a map file in, files for other programs out, without a server.

use std::path::{Path, PathBuf};

use jiff::Timestamp;
use stillage_core::analysis::ALGORITHM_VERSION;
use stillage_core::graph::{NavigationGraph, navigation_graph};
use stillage_core::layout::LayoutSpec;
use stillage_core::routing::Router;

use super::failure::Failure;
use super::findings::CorrectedAnalysisArgs;
use super::input;
use super::output;
use super::progress::ProgressDisplay;
use super::server;
use crate::app::MapContext;
use crate::exports::{Export, ExportError, ExportOptions, ExportSource, NamedFile, list, option, write};

/// In place of a format: every one.
const ALL: &str = "all";
/// In place of a format: what formats there are.
const LIST: &str = "list";

/// Arguments of `stillage export`.
#[derive(Debug, clap::Args)]
pub(super) struct ExportArgs {
    /// The map: a `map_server` YAML file with its image beside it, or a `nav_msgs/OccupancyGrid` message as JSON.
    #[arg(value_name = "MAP")]
    map: Option<PathBuf>,
    /// Address of a map of a running service in place of a file: `http://localhost:8080/v1/maps/ID`.
    #[arg(long, value_name = "URL", conflicts_with = "map")]
    server: Option<String>,
    /// Format of the file, such as `lif` or `nav2-route`; `list` prints them all with their options, `all` writes them all.
    #[arg(long, value_name = "FORMAT")]
    format: String,
    /// The file, or `-` for standard output; with `all`, the folder. In the current folder, under its usual name, when
    /// absent.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// An option of the format, as often as there are some: `--set profile=odoo`.
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = input::name_and_value)]
    set: Vec<(String, String)>,
    #[command(flatten)]
    analysis: CorrectedAnalysisArgs,
}

/// Runs the command.
pub(super) fn run(arguments: &ExportArgs) -> Result<(), Failure> {
    if arguments.format == LIST {
        print!("{}", formats());
        return Ok(());
    }
    let wanted = wanted(&arguments.format, &arguments.set)?;
    let files = match (&arguments.map, &arguments.server) {
        (_, Some(server)) => from_server(server, &wanted, &arguments.set)?,
        (Some(map), None) => from_file(map, &arguments.analysis, &wanted)?,
        (None, None) => return Err(Failure::Input("name the map file to export, or --server".to_owned())),
    };
    put(arguments, files)
}

/// An export with its options.
type Wanted = (&'static Export, ExportOptions);

/// The exports of a format, with the options given.
fn wanted(format: &str, given: &[(String, String)]) -> Result<Vec<Wanted>, Failure> {
    let read = |export: &'static Export, given: &[(String, String)]| {
        let pairs = given.iter().map(|(name, value)| (name.as_str(), value.as_str()));
        let options = ExportOptions::read(export, pairs);
        let options =
            options.map_err(|problem| Failure::Input(format!("--set {}: {}", problem.name, problem.detail)))?;
        Ok((export, options))
    };
    if format != ALL {
        let known = || list().iter().map(|export| export.format).collect::<Vec<_>>().join(", ");
        let export = Export::of_format(format)
            .ok_or_else(|| Failure::Input(format!("there is no format {format}: name {}, {LIST} or {ALL}", known())))?;
        return Ok(vec![read(export, given)?]);
    }
    if let Some((name, _)) = given.iter().find(|(name, _)| option(name).is_none()) {
        return Err(Failure::Input(format!("--set {name}: is no option of any format: see --format {LIST}")));
    }
    let own = |export: &Export| -> Vec<(String, String)> {
        given.iter().filter(|(name, _)| export.options.contains(&name.as_str())).cloned().collect()
    };
    list().iter().map(|export| read(export, &own(export))).collect()
}

/// Fetches exports of a map of a running service.
fn from_server(server: &str, wanted: &[Wanted], given: &[(String, String)]) -> Result<Vec<NamedFile>, Failure> {
    let fetch = |(export, _): &Wanted| {
        let own = |(name, _): &&(String, String)| export.options.contains(&name.as_str());
        let query: Vec<(String, String)> = given.iter().filter(own).cloned().collect();
        let bytes = server::get(server, &format!("exports/{}", export.name), &query)?;
        Ok(NamedFile { name: export.name.to_owned(), bytes })
    };
    wanted.iter().map(fetch).collect()
}

/// Analyses a map file and writes exports of it.
fn from_file(map: &Path, analysis: &CorrectedAnalysisArgs, wanted: &[Wanted]) -> Result<Vec<NamedFile>, Failure> {
    let progress = ProgressDisplay::new();
    let pool = analysis.pool()?;
    let context = analysis.find(map, &pool, &progress)?.context;
    let changed = std::fs::metadata(map).and_then(|file| file.modified()).map_err(Failure::internal)?;
    let created = Timestamp::try_from(changed).map_err(Failure::internal)?;
    let files = pool.install(|| -> Result<Vec<NamedFile>, Failure> {
        let mut files = Vec::new();
        // Exports for the same vehicle share its graph.
        let mut made: Option<(f64, NavigationGraph)> = None;
        for (export, options) in wanted {
            let usual = || LayoutSpec::of(&context.analysis.options).vehicle_radius;
            let radius = options.footprint_radius.unwrap_or_else(usual);
            if export.reads_graph() && made.as_ref().is_none_or(|(of, _)| *of != radius) {
                made = Some((radius, graph(&context, radius)));
            }
            let empty = NavigationGraph::default();
            let graph = made.as_ref().map_or(&empty, |(_, graph)| graph);
            match export_of(&context, created, graph, export, options) {
                Ok(bytes) => files.push(NamedFile { name: export.name.to_owned(), bytes }),
                Err(reason) if wanted.len() > 1 => progress.say(&format!("{} is left out: {reason}", export.name)),
                Err(reason) => return Err(Failure::Input(format!("{} cannot be written: {reason}", export.name))),
            }
        }
        Ok(files)
    });
    progress.finish();
    files
}

fn graph(context: &MapContext, radius: f64) -> NavigationGraph {
    let site = context.site();
    navigation_graph(&site, &context.layout, &Router::new(&site, radius))
}

fn export_of(
    context: &MapContext,
    created: Timestamp,
    graph: &NavigationGraph,
    export: &Export,
    options: &ExportOptions,
) -> Result<Vec<u8>, ExportError> {
    let name = &context.record.name;
    let source = ExportSource {
        name,
        map_id: name,
        version: &version(context),
        created,
        grid: &context.grid,
        analysis: &context.analysis,
        semantic: &context.semantic,
        cells: &context.cells.faces,
        layout: &context.layout,
        names: &context.names,
        graph,
        georeference: None,
    };
    write(export, &source, options)
}

/// A text that changes with the cells, the options, the corrections, the labels and the algorithms: no store counts versions
/// here.
fn version(context: &MapContext) -> String {
    let MapContext { grid, analysis, semantic, semantics, corrections, .. } = context;
    let cells: Vec<u8> = grid.cells().iter().map(|&cell| cell as u8).collect();
    let rest = (grid.frame(), &analysis.options, &corrections.list, semantic.rule_set.draft());
    let rest = serde_json::to_vec(&(rest, &semantics.assignment, ALGORITHM_VERSION));
    let mut hasher = blake3::Hasher::new();
    hasher.update(&cells).update(&rest.expect("options and labels are JSON"));
    hasher.finalize().to_hex()[..12].to_owned()
}

/// Puts the files where they belong and prints where that is.
fn put(arguments: &ExportArgs, files: Vec<NamedFile>) -> Result<(), Failure> {
    let is_folder = arguments.format == ALL;
    files.into_iter().try_for_each(|NamedFile { name, bytes }| match &arguments.out {
        Some(folder) if is_folder => output::write(&folder.join(name), &bytes),
        Some(file) => output::put(Some(file), &bytes),
        None => output::write(Path::new(&name), &bytes),
    })
}

/// Every format with what it is for and its options.
fn formats() -> String {
    let lines = list().iter().flat_map(|export| {
        let head = format!("{:<24}{:<30}{}\n", export.format, export.name, export.purpose);
        let options = export.options.iter().filter_map(|name| option(name));
        let options = options.map(|option| format!("    {}={}: {}\n", option.name, option.example, option.description));
        std::iter::once(head).chain(options)
    });
    lines.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(format: &str, set: &[(&str, &str)]) -> String {
        let set: Vec<_> = set.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned())).collect();
        match wanted(format, &set) {
            Err(Failure::Input(message)) => message,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn formats_go_by_their_name_or_that_of_their_file() {
        for format in ["csv", "locations.csv"] {
            let wanted = wanted(format, &[("profile".to_owned(), "odoo".to_owned())]).unwrap();
            assert_eq!(wanted[0].0.name, "locations.csv");
        }
        assert_eq!(wanted(ALL, &[]).unwrap().len(), list().len());
        assert!(formats().contains("nav2-route"));
    }

    #[test]
    fn a_wrong_format_or_option_says_what_there_is() {
        assert!(refused("lift", &[]).contains("name lif, lif-2.0"));
        assert!(refused("csv", &[("profil", "odoo")]).contains("which has profile"));
        assert!(refused(ALL, &[("profil", "odoo")]).contains("no option of any format"));
    }
}
