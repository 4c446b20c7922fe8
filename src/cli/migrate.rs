//! `stillage migrate`: brings a database up to date without serving it, or moves a deployment.

use std::io::{self, Write};

use clap::Args;

use super::storage::{BlobsNotShared, DatabaseArgs, StorageArgs};
use crate::config::{BlobAddress, DatabaseAddress};
use crate::store::{self, Moved, StoreError};

/// Brings the database up to date (`serve` does so by itself) and checks that it opens.
///
/// With `--from` and `--to` it moves all maps, results and decisions from one storage to another. No process may use either
/// meanwhile. What was interrupted goes on with the same command. Nothing is deleted.
#[derive(Debug, Clone, Args)]
pub(super) struct MigrateArgs {
    #[command(flatten)]
    storage: StorageArgs,
    /// Database to move from: `sqlite:FOLDER` or `postgres://USER:PASSWORD@HOST:PORT/DATABASE`.
    #[arg(long, value_name = "ADDRESS", requires = "to")]
    from: Option<DatabaseAddress>,
    /// Database to move to.
    #[arg(long, value_name = "ADDRESS", requires = "from")]
    to: Option<DatabaseAddress>,
    /// Blobs to move from, where they are not in the folder of SQLite: `s3://BUCKET/PREFIX` or `file:///FOLDER`.
    #[arg(long, value_name = "ADDRESS", requires = "from")]
    from_blobs: Option<BlobAddress>,
    /// Blobs to move to, where they are not to be in the folder of SQLite.
    #[arg(long, value_name = "ADDRESS", requires = "from")]
    to_blobs: Option<BlobAddress>,
}

/// Why it could not be done.
#[derive(Debug, thiserror::Error)]
pub(super) enum MigrateError {
    /// A database of several processes with the blobs of one.
    #[error(transparent)]
    Storage(#[from] BlobsNotShared),
    /// The store says no.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// Rows are missing where they should have gone.
    #[error("the table {0} has {1} rows at the source and {2} at the destination")]
    Missing(&'static str, u64, u64),
    /// Threads, standard output.
    #[error("the system refused: {0}")]
    System(#[from] io::Error),
}

/// Migrates and prints the schema version, or moves and prints what was moved.
pub(super) fn run(args: &MigrateArgs) -> Result<(), MigrateError> {
    tokio::runtime::Builder::new_current_thread().enable_all().build()?.block_on(async {
        match (&args.from, &args.to) {
            (Some(from), Some(to)) => move_deployment(args, from, to).await,
            _ => bring_up_to_date(&args.storage).await,
        }
    })
}

async fn bring_up_to_date(storage: &StorageArgs) -> Result<(), MigrateError> {
    let config = storage.config()?;
    let store = store::open(&config).await?;
    let version = store.schema_version().await?;
    store.close().await;
    let name = match &config.database {
        DatabaseAddress::Sqlite(folder) => folder.display().to_string(),
        #[cfg(feature = "postgres")]
        shared @ DatabaseAddress::Postgres(_) => shared.to_string(),
    };
    Ok(writeln!(io::stdout(), "{name} is at schema version {version}")?)
}

async fn move_deployment(args: &MigrateArgs, from: &DatabaseAddress, to: &DatabaseAddress) -> Result<(), MigrateError> {
    let side = |database: &DatabaseAddress, blobs: &Option<BlobAddress>| {
        let rows = DatabaseArgs { database: Some(database.clone()), ..args.storage.rows.clone() };
        StorageArgs { rows, blobs: blobs.clone() }.config()
    };
    let (source, destination) = (side(from, &args.from_blobs)?, side(to, &args.to_blobs)?);
    let tell = |so_far: &Moved| {
        // Whoever started it may not listen any more.
        let _ = write!(
            io::stderr(),
            "\r{} maps moved, {} were there, {} blobs",
            so_far.maps,
            so_far.maps_there,
            so_far.blobs
        );
    };
    let moved = store::move_all(&source, &destination, tell).await?;
    let mut out = io::stdout();
    writeln!(io::stderr())?;
    writeln!(
        out,
        "{from} -> {to}: {} maps moved, {} were there already, {} blobs",
        moved.maps, moved.maps_there, moved.blobs
    )?;
    for blob in &moved.damaged {
        writeln!(out, "blob {blob} is missing or damaged at the source, and was not moved")?;
    }
    for (table, (before, after)) in &moved.rows {
        writeln!(out, "{table:20} {before:>8} rows at the source, {after:>8} at the destination")?;
    }
    match moved.rows.iter().find(|(_, (before, after))| after < before) {
        Some((table, (before, after))) => Err(MigrateError::Missing(table, *before, *after)),
        None => Ok(()),
    }
}
