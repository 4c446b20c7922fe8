//! The engine of several processes: a PostgreSQL server that all of them share.
//!
//! It is the one that coordinates them; there is no leader. Claims skip the rows that others hold, leases run by the server's
//! clock, and the fence is the row of a job. What is committed is on stable storage (`synchronous_commit`), whatever the
//! server's own setting.

mod changes;
#[cfg(test)]
pub(crate) mod tests;

use std::sync::LazyLock;
use std::time::Duration;

use sqlx::migrate::Migrator;
use sqlx::postgres::{PgConnectOptions, PgPool, PgPoolOptions};
use sqlx::{ConnectOptions as _, Transaction};

use super::StoreError;
use super::migrations::{migration, run_migrations};

use changes::JobChanges;

/// How long a request waits for a connection, or for the server to come back.
const ACQUIRE_TIMEOUT: Duration = Duration::from_secs(5);

/// Connections of one process: as many questions at the same time. PostgreSQL allows 100 in all by default.
const CONNECTIONS: u32 = 16;

/// How long a statement may wait for a row or a lock that another transaction holds.
const LOCK_TIMEOUT: &str = "10s";

/// After this time the server ends a transaction whose process says nothing: one that stands still, or is cut off, may hold the row
/// of its job, which nobody else could take. Longer than a look at the blobs takes.
const IDLE_TIMEOUT: &str = "20s";

/// How long the server may take for an answer; a little longer than for a lock. Who is cut off would otherwise wait until the
/// system gives the connection up, after a quarter of an hour.
const ANSWER_TIMEOUT: Duration = Duration::from_secs(12);

/// The migrations, oldest first. The first one makes what SQLite had at version 9; from then on both have the same numbers.
static MIGRATIONS: LazyLock<Migrator> = LazyLock::new(|| {
    Migrator::with_migrations(vec![
        migration(9, "start", include_str!("../../../migrations/postgres/0009_start.sql")),
        migration(10, "jobs that were cut off", include_str!("../../../migrations/postgres/0010_cut_off_jobs.sql")),
        migration(11, "keys", include_str!("../../../migrations/postgres/0011_keys.sql")),
    ])
});

/// The open database.
#[derive(Debug)]
pub struct Postgres {
    pub(super) pool: PgPool,
    changes: JobChanges,
}

impl Postgres {
    /// Connects to a server (`postgres://user:password@host:port/database`) and brings the database up to date. Of several
    /// processes that start at once, one does it and the others wait.
    ///
    /// # Errors
    /// [`StoreError::Address`] when the address makes no sense, [`StoreError::NewerDatabase`] when a newer program wrote the
    /// database, and whatever the server answers.
    pub async fn open(address: &str) -> Result<Self, StoreError> {
        let bad_address = |error: sqlx::Error| {
            StoreError::Address(error.to_string().trim_start_matches("error with configuration: ").to_owned())
        };
        let options: PgConnectOptions = address.parse().map_err(bad_address)?;
        let name = format!("{} on {}", options.get_database().unwrap_or("its database"), options.get_host());
        let options = options
            .application_name("stillage")
            .options([
                ("synchronous_commit", "on"),
                ("lock_timeout", LOCK_TIMEOUT),
                ("idle_in_transaction_session_timeout", IDLE_TIMEOUT),
            ])
            .log_slow_statements(tracing::log::LevelFilter::Off, Duration::MAX);
        let pool = PgPoolOptions::new().max_connections(CONNECTIONS).acquire_timeout(ACQUIRE_TIMEOUT);
        let pool = pool.connect_with(options).await.map_err(|error| StoreError::Unreachable(name.clone(), error))?;
        run_migrations(&MIGRATIONS, &pool, &name).await?;
        let changes = JobChanges::of(pool.clone());
        Ok(Self { pool, changes })
    }

    /// Begins a read of one committed state.
    pub(super) async fn snapshot(&self) -> Result<Transaction<'static, sqlx::Postgres>, StoreError> {
        in_time(self.pool.begin_with("BEGIN ISOLATION LEVEL REPEATABLE READ READ ONLY")).await
    }

    /// Begins a write.
    pub(super) async fn write(&self) -> Result<Transaction<'static, sqlx::Postgres>, StoreError> {
        in_time(self.pool.begin()).await
    }

    /// Returns when a job may have been queued or changed, at least once a second.
    pub(super) async fn job_changed(&self) {
        self.changes.next().await;
    }

    /// Closes the connections; pending writes end first.
    pub(super) async fn close(&self) {
        self.changes.close().await;
        self.pool.close().await;
    }
}

/// Waits for an answer of the server, but not for long.
pub(super) async fn in_time<T>(answer: impl Future<Output = Result<T, sqlx::Error>>) -> Result<T, StoreError> {
    match tokio::time::timeout(ANSWER_TIMEOUT, answer).await {
        Ok(answer) => Ok(answer?),
        Err(_) => Err(StoreError::Busy),
    }
}
