//! Why a call to the store failed.

use std::io;
use std::path::{Path, PathBuf};

use super::BlobId;

/// Why a call to the store failed.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    /// Another process has the lock of the folder.
    #[error("the data folder {} is in use by another process{}: stop it, or choose another folder with --data",
        .folder.display(), .holder.map(|pid| format!(" (pid {pid})")).unwrap_or_default())]
    FolderInUse {
        /// The folder.
        folder: PathBuf,
        /// Id of the process that has it.
        holder: Option<u32>,
    },
    /// A file or folder cannot be made, read or locked.
    #[error("the data folder cannot be used: {}: {source}", .path.display())]
    Folder {
        /// The file or folder.
        path: PathBuf,
        /// The error of the system.
        source: io::Error,
    },
    /// A restore has begun and not ended.
    #[error(
        "the data folder {} holds a part of a backup, because its restore was interrupted: run the same restore again",
        .0.display()
    )]
    RestoreUnfinished(PathBuf),
    /// The database knows migrations that this program does not.
    #[error(
        "the database {database} was written by a newer stillage (schema {found}, this program knows up to {known}): \
        run the newer program, or restore the backup made before the upgrade"
    )]
    NewerDatabase {
        /// The database file, or the address of the server.
        database: String,
        /// A migration that was applied to it.
        found: i64,
        /// The last migration of this program.
        known: i64,
    },
    /// A service of an earlier release is using the database.
    #[error(
        "the database {database} is in use by an older stillage (schema {found}, this program has {known}): use the program \
        of that release, or stop the service first"
    )]
    OlderService {
        /// The database file.
        database: String,
        /// Its last migration.
        found: i64,
        /// The last migration of this program.
        known: i64,
    },
    /// An address that a database cannot have.
    #[error("the address of the database makes no sense: {0}")]
    Address(String),
    /// The server of the database does not let the program in.
    #[error("the database {0} cannot be reached: {1}")]
    Unreachable(String, #[source] sqlx::Error),
    /// The file of the authorities that sign the certificates of the object store.
    #[error("the authorities in {} (AWS_CA_BUNDLE) cannot be used: {reason}", .path.display())]
    Authorities {
        /// The file.
        path: PathBuf,
        /// Why.
        reason: String,
    },
    /// A migration failed.
    #[error("the database could not be brought up to date: {0}")]
    Migration(#[source] sqlx::migrate::MigrateError),
    /// Another process holds the database, or all connections are taken.
    #[error("the database is busy")]
    Busy,
    /// The disk is full, or below the configured floor.
    #[error("the disk is full")]
    NoSpace,
    /// The claim was lost: the job was cancelled, deleted, or handed to another worker.
    #[error("the job is no longer held by this claim")]
    ClaimLost,
    /// A blob is not what was written.
    #[error("blob {blob} is damaged: {reason}")]
    Damaged {
        /// Its address.
        blob: BlobId,
        /// What is wrong with it.
        reason: String,
    },
    /// A blob is in a format that this release does not read.
    #[error("blob {blob} cannot be read: {reason}")]
    Format {
        /// Its address.
        blob: BlobId,
        /// Why, and what to do.
        reason: String,
    },
    /// A column holds what the program never writes.
    #[error("column {column} of the database holds {value:?}")]
    BadValue {
        /// The column.
        column: &'static str,
        /// What it holds.
        value: String,
    },
    /// The storage of the blobs refused.
    #[error("blob storage: {0}")]
    Blob(#[source] object_store::Error),
    /// The database refused.
    #[error("database: {0}")]
    Database(#[source] sqlx::Error),
}

impl StoreError {
    /// Whether the same call may succeed later without anyone mending anything by hand.
    #[must_use]
    pub const fn is_transient(&self) -> bool {
        matches!(self, Self::Busy | Self::NoSpace | Self::Blob(_) | Self::Database(_) | Self::Folder { .. })
    }

    pub(super) fn folder(path: &Path, source: io::Error) -> Self {
        if is_full(&source) { Self::NoSpace } else { Self::Folder { path: path.to_owned(), source } }
    }
}

fn is_full(error: &io::Error) -> bool {
    matches!(error.kind(), io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded)
}

impl From<object_store::Error> for StoreError {
    fn from(error: object_store::Error) -> Self {
        let mut source: Option<&(dyn std::error::Error + 'static)> = Some(&error);
        while let Some(cause) = source {
            if cause.downcast_ref::<io::Error>().is_some_and(is_full) {
                return Self::NoSpace;
            }
            source = cause.source();
        }
        Self::Blob(error)
    }
}
