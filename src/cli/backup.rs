//! `stillage backup` and `stillage restore`: the store of one process, copied while it works, and made of the copy.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use clap::Args;

use super::counting_bar::CountingBar;
use super::storage::{BlobsNotShared, StorageArgs};
use crate::store::{self, BackupContents, BackupError, CopyProgress};

/// Copies the data folder of a service, which may go on working, into a new folder with checksums.
///
/// The state of the rows is that at the end of the copy. For PostgreSQL use its own tools (docs/operations.md).
#[derive(Debug, Clone, Args)]
pub(super) struct BackupArgs {
    #[command(flatten)]
    storage: StorageArgs,
    /// Folder for the backup, empty or not there yet. It gets its name when the backup is whole.
    #[arg(long, value_name = "FOLDER")]
    to: PathBuf,
}

/// Checks a backup against its checksums and makes a data folder of it, which must be empty or not there yet.
#[derive(Debug, Clone, Args)]
pub(super) struct RestoreArgs {
    #[command(flatten)]
    storage: StorageArgs,
    /// The backup.
    #[arg(long, value_name = "FOLDER")]
    from: PathBuf,
    /// Only check the backup.
    #[arg(long)]
    check: bool,
}

/// Why it could not be done.
#[derive(Debug, thiserror::Error)]
pub(super) enum CopyingError {
    /// A database of several processes with the blobs of one.
    #[error(transparent)]
    Storage(#[from] BlobsNotShared),
    /// What stands against the copy.
    #[error(transparent)]
    Backup(#[from] BackupError),
    /// Threads, standard output.
    #[error("the system refused: {0}")]
    System(#[from] io::Error),
}

/// Makes a backup and tells what is in it.
pub(super) fn back_up(args: &BackupArgs) -> Result<(), CopyingError> {
    let config = args.storage.config()?;
    let contents = with_bar(async |tell| store::back_up(&config, &args.to, tell).await)?;
    say(&contents, "in", &args.to)?;
    for blob in &contents.damaged {
        writeln!(
            io::stderr(),
            "warning: the blob {blob} is missing or damaged in the store, and is not in the backup"
        )?;
    }
    Ok(())
}

/// Checks a backup, restores it where that is asked for, and tells what is in it.
pub(super) fn restore(args: &RestoreArgs) -> Result<(), CopyingError> {
    if args.check {
        let contents = with_bar(async |tell| store::check_backup(&args.from, tell).await)?;
        return say(&contents, "whole in", &args.from);
    }
    let config = args.storage.config()?;
    let contents = with_bar(async |tell| store::restore(&args.from, &config, tell).await)?;
    say(&contents, "restored to", config.database.folder().unwrap_or(&args.storage.rows.data))
}

fn with_bar(
    copy: impl AsyncFnOnce(&dyn Fn(CopyProgress)) -> Result<BackupContents, BackupError>,
) -> Result<BackupContents, CopyingError> {
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build()?;
    let bar = CountingBar::new("files");
    let contents = runtime.block_on(copy(&|so_far| bar.show(so_far.done, so_far.of)));
    bar.clear();
    Ok(contents?)
}

fn say(contents: &BackupContents, what: &str, folder: &Path) -> Result<(), CopyingError> {
    let BackupContents { maps, blobs, bytes, schema, made, .. } = contents;
    let mib = bytes.div_ceil(1 << 20);
    let folder = folder.display();
    Ok(writeln!(io::stdout(), "{maps} maps, {blobs} blobs, {mib} MiB, schema {schema}, as of {made}: {what} {folder}")?)
}
