//! Where a command finds the rows and the blobs.

use std::path::PathBuf;

use clap::Args;

use crate::config::{BlobAddress, Config, DatabaseAddress};

/// Where the rows are.
#[derive(Debug, Clone, Args)]
pub(super) struct DatabaseArgs {
    /// Folder of the database and the uploads; made where it is missing. One process at a time.
    #[arg(long, env = "STILLAGE_DATA", default_value = "data", value_name = "FOLDER")]
    pub(super) data: PathBuf,
    /// Database in place of SQLite in the data folder: `postgres://USER:PASSWORD@HOST:PORT/DATABASE`, which any number of
    /// processes share, or `sqlite:FOLDER`.
    #[arg(long, env = "STILLAGE_DATABASE", value_name = "ADDRESS", hide_env_values = true)]
    pub(super) database: Option<DatabaseAddress>,
}

impl DatabaseArgs {
    /// The address of the database.
    pub(super) fn address(&self) -> DatabaseAddress {
        self.config().database
    }

    /// The defaults of the service on this database.
    pub(super) fn config(&self) -> Config {
        let folder = match &self.database {
            Some(DatabaseAddress::Sqlite(folder)) => folder,
            _ => &self.data,
        };
        let config = Config::new(folder);
        Config { database: self.database.clone().unwrap_or(config.database), ..config }
    }
}

/// Where the rows and the blobs are.
#[derive(Debug, Clone, Args)]
pub(super) struct StorageArgs {
    #[command(flatten)]
    pub(super) rows: DatabaseArgs,
    /// Uploads and results in place of files in the data folder: `s3://BUCKET/PREFIX` (keys, region and endpoint as `AWS_…`
    /// in the environment) or `file:///FOLDER`, on a disk that all processes share.
    #[arg(long, env = "STILLAGE_BLOBS", value_name = "ADDRESS")]
    pub(super) blobs: Option<BlobAddress>,
}

/// A database of several processes with the blobs of one.
#[derive(Debug, thiserror::Error)]
#[error(
    "{0} is shared by processes, and its blobs must be, too: pass --blobs s3://BUCKET/PREFIX, or --blobs file:///FOLDER on a \
     disk that all of them share"
)]
pub(super) struct BlobsNotShared(DatabaseAddress);

impl StorageArgs {
    /// The defaults of the service on this storage.
    ///
    /// # Errors
    /// [`BlobsNotShared`].
    pub(super) fn config(&self) -> Result<Config, BlobsNotShared> {
        let config = self.rows.config();
        if config.database.is_shared() && self.blobs.is_none() {
            return Err(BlobsNotShared(config.database));
        }
        Ok(Config { blobs: self.blobs.clone().unwrap_or(config.blobs), ..config })
    }
}
