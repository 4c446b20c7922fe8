//! `stillage openapi`: prints the OpenAPI document, or writes it to a file.

use std::io::{self, Write as _};
use std::path::PathBuf;

/// Prints the OpenAPI 3.1 document of the service.
#[derive(Debug, clap::Args)]
pub(super) struct OpenapiArgs {
    /// Write it to this file (in the repository: openapi/openapi.json) instead of the standard output.
    #[arg(long, value_name = "FILE")]
    pub(super) write: Option<PathBuf>,
}

/// Prints or writes the document.
///
/// # Errors
/// When the file or the output cannot be written.
pub(super) fn run(args: &OpenapiArgs) -> io::Result<()> {
    let document = crate::http::openapi_json();
    match &args.write {
        Some(path) => std::fs::write(path, document),
        None => io::stdout().write_all(document.as_bytes()),
    }
}
