//! `stillage openapi`: prints an OpenAPI document, or writes all of them to a folder.

use std::io::{self, Write as _};
use std::path::PathBuf;

/// Prints the OpenAPI 3.1 document of the service.
#[derive(Debug, clap::Args)]
pub(super) struct OpenapiArgs {
    /// Print the document in OpenAPI 3.0, which GIS and generators of clients read.
    #[arg(long, conflicts_with = "write")]
    pub(super) v3_0: bool,
    /// Write openapi.json, openapi-3.0.json and map-3.0.json to this folder (in the repository: openapi) instead.
    #[arg(long, value_name = "FOLDER")]
    pub(super) write: Option<PathBuf>,
}

/// Prints or writes the documents.
///
/// # Errors
/// When a file or the output cannot be written.
pub(super) fn run(args: &OpenapiArgs) -> io::Result<()> {
    let texts = crate::http::openapi_texts();
    let Some(folder) = &args.write else {
        let text = if args.v3_0 { texts.version_3_0 } else { texts.version_3_1 };
        return io::stdout().write_all(text.as_bytes());
    };
    for (name, text) in
        [("openapi.json", texts.version_3_1), ("openapi-3.0.json", texts.version_3_0), ("map-3.0.json", texts.of_map)]
    {
        std::fs::write(folder.join(name), text)?;
    }
    Ok(())
}
