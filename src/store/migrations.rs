//! Bringing a database up to date.

use std::ops::Deref;

use sqlx::migrate::{Migrate, MigrateError, Migration, MigrationType, Migrator};
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
            let known = migrations.iter().map(|migration| migration.version).max().unwrap_or(0);
            Err(StoreError::NewerDatabase { database: name.to_owned(), found, known })
        }
        Err(error) => Err(StoreError::Migration(error)),
    }
}
