//! `stillage route`: the way from one place to another, from a map file or a running service.

use std::path::{Path, PathBuf};

use super::failure::Failure;
use super::findings::CorrectedAnalysisArgs;
use super::input;
use super::output;
use super::progress::ProgressDisplay;
use super::server;
use crate::http::fleet::route::{self, RouteQuery};
use crate::http::links::encode;

/// Arguments of `stillage route`.
#[derive(Debug, clap::Args)]
pub(super) struct RouteArgs {
    /// The map file (without --server), then where the route begins and where it ends: `x,y` in metres of the map,
    /// `face:ID`, `place:ID`, `location:CODE` or, from a service, `name:NAME`.
    #[arg(value_name = "[MAP] FROM TO", num_args = 2..=3, required = true)]
    ends: Vec<String>,
    /// Address of a map of a running service in place of a file: `http://localhost:8080/v1/maps/ID`.
    #[arg(long, value_name = "URL")]
    server: Option<String>,
    /// A parameter of the request, as often as there are some: `--set footprintRadiusM=0.6`.
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = input::name_and_value)]
    set: Vec<(String, String)>,
    /// The file for the GeoJSON; standard output when absent.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    #[command(flatten)]
    analysis: CorrectedAnalysisArgs,
}

/// Runs the command.
pub(super) fn run(arguments: &RouteArgs) -> Result<(), Failure> {
    let bytes = match (arguments.ends.as_slice(), &arguments.server) {
        ([from, to], Some(map)) => server::get(map, "routes", &query(arguments, from, to))?,
        ([map, from, to], None) => from_file(Path::new(map), &arguments.analysis, &query(arguments, from, to))?,
        (_, Some(_)) => {
            return Err(Failure::Input("name two ends: --server stands in place of the map file".to_owned()));
        }
        (_, None) => return Err(Failure::Input("name the map file and two ends, or --server and two ends".to_owned())),
    };
    output::put(arguments.out.as_deref(), &bytes)
}

/// The parameters of the request. Coordinates are metres of the map unless another `crs` is set.
fn query(arguments: &RouteArgs, from: &str, to: &str) -> Vec<(String, String)> {
    let mut query = vec![("from".to_owned(), from.trim().to_owned()), ("to".to_owned(), to.trim().to_owned())];
    if arguments.set.iter().all(|(name, _)| name != "crs") {
        query.push(("crs".to_owned(), "EPSG:3857".to_owned()));
    }
    query.extend(arguments.set.iter().cloned());
    query
}

fn from_file(map: &Path, analysis: &CorrectedAnalysisArgs, query: &[(String, String)]) -> Result<Vec<u8>, Failure> {
    let query: Vec<String> = query.iter().map(|(name, value)| format!("{}={}", encode(name), encode(value))).collect();
    // A typing error should not cost an analysis.
    let query = RouteQuery::read(&query.join("&")).map_err(|problem| Failure::Input(problem.message()))?;
    let progress = ProgressDisplay::new();
    let pool = analysis.pool()?;
    let context = analysis.find(map, &pool, &progress)?.context;
    let answer = pool.install(|| route::answer(&context, &query));
    progress.finish();
    answer.map_err(|problem| Failure::Input(problem.message()))
}
