//! The command line. (to be written)

pub mod openapi;

/// Runs the command line.
#[must_use]
pub fn run() -> std::process::ExitCode {
    todo!()
}
