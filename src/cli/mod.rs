//! The command line: one file per command, and what several of them need.
//!
//! A command prints what it made on stdout and anything else on stderr. It ends with code 0, with 2 for a fault of
//! the input (one sentence says which, and how to mend it), or with 1 for a fault of the program or the system.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "the command line talks to people")]

mod access;
mod analyze;
mod backup;
mod compare;
mod demo;
mod evaluate;
mod export;
mod key;
mod migrate;
mod openapi;
mod route;
mod serve;

mod computation;
mod counting_bar;
mod failure;
mod findings;
mod input;
mod logging;
mod output;
mod progress;
mod quotas;
mod server;
mod storage;
mod tls;
mod tokens;
#[cfg(feature = "otel")]
mod traces;

use std::ffi::OsString;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

use failure::Failure;

/// Turns a robot's occupancy map of a warehouse or office into a semantic map.
#[derive(Debug, Parser)]
#[command(name = "stillage", version, arg_required_else_help = true)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Serves the REST API.
    Serve(Box<serve::ServeArgs>),
    /// Analyses one map file and writes GeoJSON layers, pictures and a report.
    Analyze(analyze::AnalyzeArgs),
    /// Analyses one map file and writes files for other programs: fleet managers, planners, inventory systems.
    Export(export::ExportArgs),
    /// Finds the way from one place of a map to another.
    Route(route::RouteArgs),
    /// Says which storage locations changed between two maps of a site.
    Compare(compare::CompareArgs),
    /// Analyses one map file and says how well the result fits its known truth.
    Evaluate(evaluate::EvaluateArgs),
    /// Serves on loopback with a temporary store, uploads an example map and shows where to look.
    Demo(demo::DemoArgs),
    /// Makes, lists and ends API keys.
    Key(key::KeyArgs),
    /// Prints the OpenAPI 3.1 document of the service.
    Openapi(openapi::OpenapiArgs),
    /// Brings the database up to date (`serve` does so by itself), or moves a deployment from one storage to another.
    Migrate(migrate::MigrateArgs),
    /// Copies the data folder of a service, which may go on working, into a new folder with checksums.
    Backup(backup::BackupArgs),
    /// Checks a backup and makes a data folder of it.
    Restore(backup::RestoreArgs),
}

/// Runs the command line.
#[must_use]
pub fn run() -> ExitCode {
    let result = match Cli::parse_from(std::env::args_os().map(unlike_a_flag)).command {
        Command::Serve(arguments) => serve::run(&arguments).map_err(Failure::setup),
        Command::Analyze(arguments) => analyze::run(&arguments),
        Command::Export(arguments) => export::run(&arguments),
        Command::Route(arguments) => route::run(&arguments),
        Command::Compare(arguments) => compare::run(&arguments),
        Command::Evaluate(arguments) => evaluate::run(&arguments),
        Command::Demo(arguments) => demo::run(&arguments),
        Command::Key(arguments) => key::run(&arguments).map_err(Failure::setup),
        Command::Openapi(arguments) => openapi::run(&arguments).map_err(Failure::setup),
        Command::Migrate(arguments) => migrate::run(&arguments).map_err(Failure::setup),
        Command::Backup(arguments) => backup::back_up(&arguments).map_err(Failure::setup),
        Command::Restore(arguments) => backup::restore(&arguments).map_err(Failure::setup),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(Failure::Input(message)) => {
            eprintln!("error: {message}");
            ExitCode::from(2)
        }
        Err(Failure::Internal(message)) => {
            eprintln!("internal error: {message}");
            ExitCode::from(1)
        }
    }
}

/// Puts a space before a position with a minus, such as `-3.5,2`, which would pass for a flag.
fn unlike_a_flag(argument: OsString) -> OsString {
    match argument.to_str() {
        Some(text) if text.starts_with('-') && text[1..].starts_with(|first: char| first.is_ascii_digit()) => {
            format!(" {text}").into()
        }
        _ => argument,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_position_with_a_minus_is_no_flag() {
        let read = |arguments: &[&str]| {
            let arguments =
                ["stillage", "route"].iter().chain(arguments).map(|argument| unlike_a_flag(argument.into()));
            Cli::try_parse_from(arguments).is_ok()
        };
        assert!(read(&["map.yaml", "-3.5,2", "-1,-1"]));
        assert!(read(&["--server", "http://host/v1/maps/1", "face:3", "location:01-002", "--set", "alternatives=2"]));
        assert!(!read(&["map.yaml"]) && !read(&["map.yaml", "-x,1", "2,2"]));
    }

    #[test]
    fn the_commands_are_consistent() {
        <Cli as clap::CommandFactory>::command().debug_assert();
    }
}
