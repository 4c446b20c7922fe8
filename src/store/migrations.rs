//! Bringing a database up to date.

use std::cmp::Ordering;
use std::ops::Deref;

use sqlx::migrate::{Migrate, MigrateError, Migration, MigrationType, Migrator};
use sqlx::sqlite::SqlitePool;
use sqlx::{Acquire, SqlSafeStr};

use super::StoreError;

/// A migration, which is one transaction.
pub fn migration(version: i64, name: &'static str, sql: &'static str) -> Migration {
    Migration::new(version, name.into(), MigrationType::Simple, sql.into_sql_str(), false)
}

/// Applies the migrations that a database does not have yet; `name` is what people know it by.
///
/// # Errors
/// [`StoreError::NewerDatabase`] when it has others, and whatever the database answers.
pub async fn run_migrations<'a, A>(migrations: &Migrator, database: A, name: &str) -> Result<(), StoreError>
where
    A: Acquire<'a>,
    <A::Connection as Deref>::Target: Migrate,
{
    match migrations.run(database).await {
        Ok(()) => Ok(()),
        Err(MigrateError::VersionMissing(found)) => {
            Err(StoreError::NewerDatabase { database: name.to_owned(), found, known: newest(migrations) })
        }
        Err(error) => Err(StoreError::Migration(error)),
    }
}

/// Checks that a database has the migrations of this program, without applying any.
///
/// # Errors
/// [`StoreError::NewerDatabase`] or [`StoreError::OlderService`], and whatever the database answers.
pub async fn check_migrated(migrations: &Migrator, database: &SqlitePool, name: &str) -> Result<(), StoreError> {
    let found: i64 = sqlx::query_scalar("SELECT max(version) FROM _sqlx_migrations").fetch_one(database).await?;
    let (database, known) = (name.to_owned(), newest(migrations));
    match found.cmp(&known) {
        Ordering::Equal => Ok(()),
        Ordering::Greater => Err(StoreError::NewerDatabase { database, found, known }),
        Ordering::Less => Err(StoreError::OlderService { database, found, known }),
    }
}

fn newest(migrations: &Migrator) -> i64 {
    migrations.iter().map(|migration| migration.version).max().unwrap_or(0)
}
