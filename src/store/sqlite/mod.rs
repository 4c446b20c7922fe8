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
//! - Blobs are removed under a lock in memory ([`Sqlite::blob_gate`]), because no other process has the folder. An engine
//!   that several processes share needs a lock in its database there.

mod analyses;
mod folder;
mod hidden_maps;
mod jobs;
mod maps;
mod queue;
mod registries;
mod rows;
mod rule_sets;
mod semantics;
#[cfg(test)]
pub(crate) mod tests;

use std::sync::LazyLock;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use async_trait::async_trait;
use sqlx::error::DatabaseError;
use sqlx::migrate::{MigrateError, Migration, MigrationType, Migrator};
use sqlx::sqlite::{
    SqliteConnectOptions, SqliteError, SqliteJournalMode, SqlitePool, SqlitePoolOptions, SqliteSynchronous,
};
use sqlx::{Connection, Row, SqlSafeStr, Transaction};
use tokio::sync::RwLock;

use super::{BlobId, Blobs, LocalBlobs, Store, StoreError};
use crate::config::Config;

use folder::DataFolder;

/// How long a statement waits for a database that another process holds.
const BUSY_TIMEOUT: Duration = Duration::from_secs(5);

/// How long a request waits for a connection, the writer's queue included: a little longer than one busy writer.
const ACQUIRE_TIMEOUT: Duration = Duration::from_secs(6);

/// The write-ahead log is cut back to this size after a checkpoint, bytes.
const LOG_SIZE_LIMIT: &str = "67108864";

/// The migrations, oldest first. A released one is never edited: the database remembers its hash.
static MIGRATIONS: LazyLock<Migrator> = LazyLock::new(|| {
    let migration = |version, name: &'static str, sql: &'static str| {
        Migration::new(version, name.into(), MigrationType::Simple, sql.into_sql_str(), false)
    };
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
    ])
});

/// The open store.
#[derive(Debug)]
pub struct Sqlite {
    folder: DataFolder,
    blobs: LocalBlobs,
    writer: SqlitePool,
    readers: SqlitePool,
    /// Transactions begun on the writer's connection.
    writes: AtomicU64,
    min_free_bytes: u64,
    /// Held for reading from the writing of a blob until its row is committed, for writing while blobs are removed.
    blob_gate: RwLock<()>,
}

impl Sqlite {
    /// Opens the data folder exclusively and brings its database up to date.
    ///
    /// # Errors
    /// [`StoreError::FolderInUse`] when another process has it, [`StoreError::NewerDatabase`] when a newer program
    /// wrote it, and whatever the disk answers.
    pub async fn open(config: &Config) -> Result<Self, StoreError> {
        let folder = DataFolder::open(&config.data)?;
        let blobs = LocalBlobs::open(&folder.blobs())?;
        let writer = connect_writer(&folder).await?;
        migrate(&writer, &folder).await?;
        let readers = connect_readers(&folder).await?;
        let store = Self {
            folder,
            blobs,
            writer,
            readers,
            writes: AtomicU64::new(0),
            min_free_bytes: config.min_free_bytes,
            blob_gate: RwLock::new(()),
        };
        if let Err(error) = store.folder.restore_reserve() {
            tracing::warn!(%error, "no space could be set aside for a full disk");
        }
        Ok(store)
    }

    /// Begins a write. The transaction is rolled back when it is dropped.
    async fn write(&self) -> Result<Transaction<'static, sqlx::Sqlite>, StoreError> {
        let transaction = self.writer.begin_with("BEGIN IMMEDIATE").await?;
        self.writes.fetch_add(1, Ordering::SeqCst);
        Ok(transaction)
    }

    /// Begins a read of one committed state.
    async fn read(&self) -> Result<Transaction<'static, sqlx::Sqlite>, StoreError> {
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

#[async_trait]
impl Store for Sqlite {
    fn blobs(&self) -> &dyn Blobs {
        &self.blobs
    }

    fn writes(&self) -> Option<u64> {
        let writes = self.writes.load(Ordering::SeqCst);
        // The one connection that writes comes back once its transaction has ended, also where whoever began it is gone.
        // No other process writes into the locked folder.
        (self.writer.num_idle() == 1).then_some(writes)
    }

    fn check_space(&self) -> Result<(), StoreError> {
        if self.folder.free_bytes()? < self.min_free_bytes { Err(StoreError::NoSpace) } else { Ok(()) }
    }

    async fn check(&self) -> Result<(), StoreError> {
        sqlx::query("SELECT count(*) FROM maps WHERE id = ''").fetch_one(&self.readers).await?;
        self.check_space()
    }

    async fn schema_version(&self) -> Result<i64, StoreError> {
        let row = sqlx::query("SELECT max(version) AS version FROM _sqlx_migrations").fetch_one(&self.readers).await?;
        Ok(row.try_get("version")?)
    }

    async fn sweep_blobs(&self, age: Duration) -> Result<usize, StoreError> {
        let _gate = self.blob_gate.write().await;
        // Nothing is being written under the gate, and no other process writes into the locked folder.
        self.blobs.remove_unfinished(Duration::ZERO).await?;
        let mut removed = 0;
        for id in self.blobs.older_than(age).await? {
            removed += usize::from(self.remove_unreferenced(&id).await?);
        }
        Ok(removed)
    }

    async fn close(&self) {
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

impl From<sqlx::Error> for StoreError {
    fn from(error: sqlx::Error) -> Self {
        // Primary result codes are the low byte: <https://sqlite.org/rescode.html>
        const BUSY: i64 = 5;
        const LOCKED: i64 = 6;
        const FULL: i64 = 13;
        let sqlite = error.as_database_error().and_then(|error| error.try_downcast_ref::<SqliteError>());
        let code = sqlite.and_then(|error| error.code()?.parse::<i64>().ok());
        match (&error, code.map(|code| code & 0xff)) {
            (_, Some(BUSY | LOCKED)) | (sqlx::Error::PoolTimedOut | sqlx::Error::PoolClosed, _) => Self::Busy,
            (_, Some(FULL)) => Self::NoSpace,
            _ => Self::Database(error),
        }
    }
}
