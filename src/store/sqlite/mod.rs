//! The embedded engine: SQLite and a folder of files, owned by one process.
//!
//! ```text
//! lock                 held exclusively while the process lives
//! reserve              space given up when the disk is full, so that deleting still works
//! stillage.sqlite3     rows (write-ahead log, every commit synced)
//! blobs/ab/abcd...     uploads and analyses, named by their blake3 hash
//! ```
//!
//! - SQLite runs with `synchronous=FULL`; blobs are synced before a row names them.
//! - Writes go through one connection and begin with `BEGIN IMMEDIATE`: a deferred transaction that reads and then
//!   writes fails at once under concurrency, whatever the busy timeout. Reads have connections of their own and see a
//!   committed snapshot.
//! - Blobs are removed under a lock in memory ([`Sqlite::blob_gate`]), because no other process has the folder.

mod database_copy;
mod folder;
#[cfg(test)]
pub(crate) mod tests;

use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, LazyLock};
use std::time::Duration;

use sqlx::migrate::Migrator;
use sqlx::sqlite::{SqliteConnectOptions, SqliteJournalMode, SqlitePool, SqlitePoolOptions, SqliteSynchronous};
use sqlx::{Connection, Transaction};
use tokio::sync::RwLock;

use super::StoreError;
use super::migrations::{check_migrated, migration, run_migrations};

pub use database_copy::DatabaseCopy;
pub use folder::DataFolder;

/// How long a statement waits for a database that another process holds.
const BUSY_TIMEOUT: Duration = Duration::from_secs(5);

/// How long a request waits for a connection, the writer's queue included: a little longer than one busy writer.
const ACQUIRE_TIMEOUT: Duration = Duration::from_secs(6);

/// The write-ahead log is cut back to this size after a checkpoint, bytes.
const LOG_SIZE_LIMIT: &str = "67108864";

/// The migrations, oldest first. A released one is never edited: the database remembers its hash.
static MIGRATIONS: LazyLock<Migrator> = LazyLock::new(|| {
    Migrator::with_migrations(vec![
        migration(1, "start", include_str!("../../../migrations/sqlite/0001_start.sql")),
        migration(
            2,
            "tenants and processes",
            include_str!("../../../migrations/sqlite/0002_tenants_and_processes.sql"),
        ),
        migration(3, "sites", include_str!("../../../migrations/sqlite/0003_sites.sql")),
        migration(4, "layouts", include_str!("../../../migrations/sqlite/0004_layouts.sql")),
        migration(5, "origins", include_str!("../../../migrations/sqlite/0005_origins.sql")),
        migration(6, "proposals", include_str!("../../../migrations/sqlite/0006_proposals.sql")),
        migration(7, "carried labels", include_str!("../../../migrations/sqlite/0007_carried_labels.sql")),
        migration(8, "hidden maps", include_str!("../../../migrations/sqlite/0008_hidden_maps.sql")),
        migration(9, "corrections", include_str!("../../../migrations/sqlite/0009_corrections.sql")),
        migration(10, "jobs that were cut off", include_str!("../../../migrations/sqlite/0010_cut_off_jobs.sql")),
        migration(11, "keys", include_str!("../../../migrations/sqlite/0011_keys.sql")),
    ])
});

/// The newest schema version that this program knows.
pub fn newest_schema() -> i64 {
    MIGRATIONS.iter().map(|migration| migration.version).max().unwrap_or(0)
}

/// The open database.
#[derive(Debug)]
pub struct Sqlite {
    pub(super) folder: DataFolder,
    writer: SqlitePool,
    pub(super) readers: SqlitePool,
    /// Transactions begun on the writer's connection.
    writes: AtomicU64,
    /// Held for reading from the writing of a blob until its row is committed, for writing while blobs are removed.
    pub(super) blob_gate: Arc<RwLock<()>>,
}

impl Sqlite {
    /// Opens the data folder exclusively and brings its database up to date.
    ///
    /// # Errors
    /// [`StoreError::FolderInUse`] when another process has it, [`StoreError::NewerDatabase`] when a newer program
    /// wrote it, and whatever the disk answers.
    pub async fn open(folder: &Path) -> Result<Self, StoreError> {
        let folder = DataFolder::open(folder)?;
        let writer = connect_writer(&folder).await?;
        run_migrations(&MIGRATIONS, &writer, &folder.database().display().to_string()).await?;
        let readers = connect_readers(&folder).await?;
        if let Err(error) = folder.restore_reserve() {
            tracing::warn!(%error, "no space could be set aside for a full disk");
        }
        Ok(Self { folder, writer, readers, writes: AtomicU64::new(0), blob_gate: Arc::default() })
    }

    /// Opens the database of a folder that another process may have, whose release must be this one's.
    ///
    /// # Errors
    /// [`StoreError::NewerDatabase`], [`StoreError::OlderService`], and whatever the disk answers.
    pub async fn open_beside(path: &Path) -> Result<Self, StoreError> {
        match Self::open(path).await {
            Err(StoreError::FolderInUse { .. }) => {}
            other => return other,
        }
        let folder = DataFolder::of_another_process(path)?;
        let writer = connect_writer(&folder).await?;
        check_migrated(&MIGRATIONS, &writer, &folder.database().display().to_string()).await?;
        let readers = connect_readers(&folder).await?;
        Ok(Self { folder, writer, readers, writes: AtomicU64::new(0), blob_gate: Arc::default() })
    }

    /// Begins a write. The transaction is rolled back when it is dropped.
    pub(super) async fn write(&self) -> Result<Transaction<'static, sqlx::Sqlite>, StoreError> {
        // Who waited in the queue has not all of the time once more for the database.
        let begun = tokio::time::timeout(ACQUIRE_TIMEOUT, self.writer.begin_with("BEGIN IMMEDIATE")).await;
        let transaction = begun.unwrap_or(Err(sqlx::Error::PoolTimedOut))?;
        self.writes.fetch_add(1, Ordering::SeqCst);
        Ok(transaction)
    }

    /// How many writes there were, where none is under way.
    pub(super) fn writes(&self) -> Option<u64> {
        let writes = self.writes.load(Ordering::SeqCst);
        // The one connection that writes comes back once its transaction has ended, also where whoever began it is gone.
        // No other process writes into the locked folder.
        (self.writer.num_idle() == 1).then_some(writes)
    }

    /// Closes the connections; pending writes end first.
    pub(super) async fn close(&self) {
        self.readers.close().await;
        self.writer.close().await;
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
