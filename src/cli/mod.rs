//! The command line: one file per command.
//!
//! A command prints what it made on stdout and anything else on stderr. It ends with code 0, with 2 for a fault of
//! the input (one sentence says which, and how to mend it), or with 1 for a fault of the program or the system.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "the command line talks to people")]

mod analyze;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// Turns a robot's occupancy map of a warehouse or office into a semantic map.
#[derive(Debug, Parser)]
#[command(name = "stillage", version, arg_required_else_help = true)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Analyses one map file and writes GeoJSON layers, pictures and a report.
    Analyze(analyze::Arguments),
}

/// Why a command failed.
#[derive(Debug)]
enum Failure {
    /// The input is wrong: one sentence with cause and remedy.
    Input(String),
    /// The program or the system is at fault.
    Internal(String),
}

/// Runs the command line.
#[must_use]
pub fn run() -> ExitCode {
    let result = match Cli::parse().command {
        Command::Analyze(arguments) => analyze::run(&arguments),
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_commands_are_consistent() {
        <Cli as clap::CommandFactory>::command().debug_assert();
    }
}
