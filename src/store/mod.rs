//! SQLite and blobs: all SQL and all files of the service.
//!
//! One data folder, owned by one process:
//!
//! ```text
//! lock                 held exclusively while the process lives
//! reserve              space given up when the disk is full, so that deleting still works
//! stillage.sqlite3     rows (write-ahead log, every commit synced)
//! blobs/ab/abcd...     uploads and analyses, named by their blake3 hash
//! ```
//!
//! What holds, whatever dies and when:
//! - What was answered is on disk: SQLite runs with `synchronous=FULL`, blobs are synced before a row names them.
//! - A row never names a blob that is not there. Blobs are written first; they are removed under [`Store::blob_gate`],
//!   when no row names them any more. A blob whose row never came is swept at a start a day later.
//! - Writes go through one connection and begin with `BEGIN IMMEDIATE`: a deferred transaction that reads and then
//!   writes fails at once under concurrency, whatever the busy timeout. Reads have connections of their own and see a
//!   committed snapshot.
//! - The queue hands a job to one worker at a time, and only the newest claim can finish it (see [`queue`]).

mod analyses;
mod blobs;
mod error;
mod folder;
mod maps;
pub mod queue;
mod rows;
mod rule_sets;
mod semantics;
#[cfg(test)]
pub(crate) mod tests;

use std::time::Duration;

use sqlx::migrate::{MigrateError, Migrator};
use sqlx::sqlite::{Sqlite, SqliteConnectOptions, SqliteJournalMode, SqlitePool, SqlitePoolOptions, SqliteSynchronous};
use sqlx::{Connection, Row, Transaction};
use tokio::sync::RwLock;

use crate::config::Config;

pub use analyses::{AnalysisAddress, NewAnalysis, Request, Snapshot};
pub use blobs::{Blob, BlobId, Blobs, off_the_runtime};
pub use error::StoreError;
pub use folder::DataFolder;
pub use maps::{IdempotencyKey, NewMapRow, Upload};
pub use rows::now;
pub use semantics::NewSemanticsRow;

/// How long a statement waits for a database that another process holds.
const BUSY_TIMEOUT: Duration = Duration::from_secs(5);

/// How long a request waits for a connection, the writer's queue included: a little longer than one busy writer.
const ACQUIRE_TIMEOUT: Duration = Duration::from_secs(6);

/// The write-ahead log is cut back to this size after a checkpoint, bytes.
const LOG_SIZE_LIMIT: &str = "67108864";

static MIGRATIONS: Migrator = sqlx::migrate!("migrations/sqlite");

/// The open store.
#[derive(Debug)]
pub struct Store {
    folder: DataFolder,
    blobs: Blobs,
    writer: SqlitePool,
    readers: SqlitePool,
    min_free_bytes: u64,
    /// Held for reading from the writing of a blob until its row is committed, for writing while blobs are removed.
    blob_gate: RwLock<()>,
}

impl Store {
    /// Opens the data folder exclusively and brings its database up to date.
    ///
    /// # Errors
    /// [`StoreError::FolderInUse`] when another process has it, [`StoreError::NewerDatabase`] when a newer program
    /// wrote it, and whatever the disk answers.
    pub async fn open(config: &Config) -> Result<Self, StoreError> {
        let folder = DataFolder::open(&config.data)?;
        let blobs = Blobs::open(&folder.blobs())?;
        let writer = connect_writer(&folder).await?;
        migrate(&writer, &folder).await?;
        let readers = connect_readers(&folder).await?;
        let store =
            Self { folder, blobs, writer, readers, min_free_bytes: config.min_free_bytes, blob_gate: RwLock::new(()) };
        if let Err(error) = store.folder.restore_reserve() {
            tracing::warn!(%error, "no space could be set aside for a full disk");
        }
        Ok(store)
    }

    /// The blobs.
    #[must_use]
    pub const fn blobs(&self) -> &Blobs {
        &self.blobs
    }

    /// Whether there is room for uploads and results.
    ///
    /// # Errors
    /// [`StoreError::NoSpace`] below the configured floor.
    pub fn check_space(&self) -> Result<(), StoreError> {
        if self.folder.free_bytes()? < self.min_free_bytes { Err(StoreError::NoSpace) } else { Ok(()) }
    }

    /// Whether the database answers and there is room.
    ///
    /// # Errors
    /// What is wrong.
    pub async fn check(&self) -> Result<(), StoreError> {
        sqlx::query("SELECT count(*) FROM maps WHERE id = ''").fetch_one(&self.readers).await?;
        self.check_space()
    }

    /// The schema version of the database.
    pub async fn schema_version(&self) -> Result<i64, StoreError> {
        let row = sqlx::query("SELECT max(version) AS version FROM _sqlx_migrations").fetch_one(&self.readers).await?;
        Ok(row.try_get("version")?)
    }

    /// Removes blobs without a row that are older than `age`, and what is left of interrupted writes. To be called
    /// before anything else writes. Answers how many were removed.
    ///
    /// # Errors
    /// When the database or the disk does not answer.
    pub async fn sweep_blobs(&self, age: Duration) -> Result<usize, StoreError> {
        let _gate = self.blob_gate.write().await;
        self.blobs.remove_unfinished().await?;
        let mut removed = 0;
        for id in self.blobs.older_than(age).await? {
            removed += usize::from(self.remove_unreferenced(&id).await?);
        }
        Ok(removed)
    }

    /// Closes the connections; pending writes end first.
    pub async fn close(&self) {
        self.readers.close().await;
        self.writer.close().await;
    }

    /// Begins a write. The transaction is rolled back when it is dropped.
    async fn write(&self) -> Result<Transaction<'static, Sqlite>, StoreError> {
        Ok(self.writer.begin_with("BEGIN IMMEDIATE").await?)
    }

    /// Begins a read of one committed state.
    async fn read(&self) -> Result<Transaction<'static, Sqlite>, StoreError> {
        Ok(self.readers.begin().await?)
    }

    /// Removes a blob that no row names. The caller holds the gate for writing.
    async fn remove_unreferenced(&self, id: &BlobId) -> Result<bool, StoreError> {
        let row = sqlx::query(
            "SELECT EXISTS (SELECT 1 FROM maps WHERE source = $1) OR EXISTS (SELECT 1 FROM analyses WHERE blob = $1) \
             AS referenced",
        )
        .bind(id.as_str())
        .fetch_one(&self.readers)
        .await?;
        if row.try_get("referenced")? {
            return Ok(false);
        }
        self.blobs.remove(id).await?;
        Ok(true)
    }
}

fn connect_options(folder: &DataFolder) -> SqliteConnectOptions {
    SqliteConnectOptions::new()
        .filename(folder.database())
        .create_if_missing(true)
        .journal_mode(SqliteJournalMode::Wal)
        .synchronous(SqliteSynchronous::Full)
        .foreign_keys(true)
        .busy_timeout(BUSY_TIMEOUT)
        .pragma("journal_size_limit", LOG_SIZE_LIMIT)
}

fn pool_options(connections: u32) -> SqlitePoolOptions {
    SqlitePoolOptions::new()
        .max_connections(connections)
        .acquire_timeout(ACQUIRE_TIMEOUT)
        .idle_timeout(None)
        .max_lifetime(None)
        // An error such as a full disk ends a transaction behind the driver's back; the driver would then refuse to
        // begin another one on that connection, so the connection is replaced.
        .before_acquire(|connection, _| Box::pin(async move { Ok(!connection.is_in_transaction()) }))
}

async fn connect_writer(folder: &DataFolder) -> Result<SqlitePool, StoreError> {
    Ok(pool_options(1).connect_with(connect_options(folder)).await?)
}

async fn connect_readers(folder: &DataFolder) -> Result<SqlitePool, StoreError> {
    let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let connections = u32::try_from(cores).unwrap_or(u32::MAX).clamp(2, 16);
    Ok(pool_options(connections).connect_with(connect_options(folder).pragma("query_only", "ON")).await?)
}

async fn migrate(writer: &SqlitePool, folder: &DataFolder) -> Result<(), StoreError> {
    match MIGRATIONS.run(writer).await {
        Ok(()) => Ok(()),
        Err(MigrateError::VersionMissing(found)) => {
            let known = MIGRATIONS.iter().map(|migration| migration.version).max().unwrap_or(0);
            Err(StoreError::NewerDatabase { database: folder.database(), found, known })
        }
        Err(error) => Err(StoreError::Migration(error)),
    }
}
