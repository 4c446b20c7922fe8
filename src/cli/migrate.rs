//! `stillage migrate`: brings a data folder up to date without serving it.

use std::io::{self, Write};
use std::path::PathBuf;

use clap::Args;

use crate::config::Config;
use crate::store::{self, StoreError};

/// Brings the database of a data folder up to date (`serve` does so by itself) and checks that it opens.
#[derive(Debug, Clone, Args)]
pub(super) struct MigrateArgs {
    /// Folder of the database and the uploads; made where it is missing.
    #[arg(long, env = "STILLAGE_DATA", default_value = "data", value_name = "FOLDER")]
    pub(super) data: PathBuf,
}

/// Why it could not be done.
#[derive(Debug, thiserror::Error)]
pub(super) enum MigrateError {
    /// The store says no.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// Threads, standard output.
    #[error("the system refused: {0}")]
    System(#[from] io::Error),
}

/// Migrates and prints the schema version.
pub(super) fn run(args: &MigrateArgs) -> Result<(), MigrateError> {
    let version = tokio::runtime::Builder::new_current_thread().enable_all().build()?.block_on(async {
        let store = store::open(&Config::new(&args.data)).await?;
        let version = store.schema_version().await?;
        store.close().await;
        Ok::<_, StoreError>(version)
    })?;
    Ok(writeln!(io::stdout(), "{} is at schema version {version}", args.data.display())?)
}
