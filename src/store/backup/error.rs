//! Why there is no backup, or no store made of it.

use std::io;
use std::path::{Path, PathBuf};

use crate::store::StoreError;

/// Why there is no backup, or no store made of it.
#[derive(Debug, thiserror::Error)]
pub enum BackupError {
    /// There is nothing to copy.
    #[error("{} holds no store: name the data folder of the service with --data", .0.display())]
    NoStore(PathBuf),
    /// Rows in a database that its own tools copy.
    #[error(
        "the rows are in PostgreSQL, which pg_dump copies, and then the blobs by the tools of their store: docs/operations.md \
         tells the order"
    )]
    Shared,
    /// Something is in the way.
    #[error("{} is there already and holds something: name a folder that is empty or not there yet", .0.display())]
    Taken(PathBuf),
    /// The folder has no file that a whole backup has.
    #[error("{} is not a whole backup: it has no {file}", .folder.display())]
    Incomplete {
        /// The folder.
        folder: PathBuf,
        /// The file.
        file: &'static str,
    },
    /// A file is not what was written.
    #[error("the backup is damaged: {}: {reason}. Nothing was restored; use another backup", .file.display())]
    Damaged {
        /// The file.
        file: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// A newer program wrote it.
    #[error("the backup {} was made by a newer stillage (format {found}, this program reads {known}): restore it with that one", .folder.display())]
    Newer {
        /// The backup.
        folder: PathBuf,
        /// Its format.
        found: u32,
        /// The format of this program.
        known: u32,
    },
    /// Maps came and went so fast that no state of the rows had all its blobs.
    #[error("maps were deleted faster than they could be copied: try again")]
    TooBusy,
    /// A file or folder cannot be read or written.
    #[error("{}: {source}", .path.display())]
    File {
        /// The file or folder.
        path: PathBuf,
        /// The error of the system.
        source: io::Error,
    },
    /// The store says no.
    #[error(transparent)]
    Store(#[from] StoreError),
}

impl BackupError {
    /// For an error of the system about a file or folder.
    pub(super) fn file(path: &Path) -> impl FnOnce(io::Error) -> Self {
        move |source| Self::File { path: path.to_owned(), source }
    }
}
