//! One committed state of a database, in a file of its own.

use std::collections::BTreeSet;
use std::path::Path;
use std::time::Duration;

use sqlx::sqlite::{SqliteConnectOptions, SqliteConnection};
use sqlx::{Connection as _, Row as _};

use super::folder::DATABASE_FILE;
use crate::store::{BlobId, StoreError};

/// How long the state is waited for while another process holds the database, as it does for a moment when it starts.
const PATIENCE: Duration = Duration::from_secs(30);

/// A copy of the rows, and what they name.
#[derive(Debug)]
pub struct DatabaseCopy {
    /// Schema version.
    pub schema: i64,
    /// How many maps there are.
    pub maps: u64,
    /// The blobs that the rows name.
    pub blobs: BTreeSet<BlobId>,
}

impl DatabaseCopy {
    /// Whether there is a database in a data folder.
    #[must_use]
    pub fn is_possible(data: &Path) -> bool {
        data.join(DATABASE_FILE).is_file()
    }

    /// Copies the newest committed state of the database of a data folder, which another process may have open, into a new
    /// file; an earlier one is replaced.
    ///
    /// # Errors
    /// What the database or the disk answers.
    pub async fn take(data: &Path, file: &Path, newest_schema: i64) -> Result<Self, StoreError> {
        if file.exists() {
            std::fs::remove_file(file).map_err(|error| StoreError::folder(file, error))?;
        }
        let options =
            SqliteConnectOptions::new().filename(data.join(DATABASE_FILE)).read_only(true).busy_timeout(PATIENCE);
        let mut source = SqliteConnection::connect_with(&options).await?;
        // One read transaction, which holds up nobody who writes: https://sqlite.org/lang_vacuum.html#vacuum_with_an_into_clause
        sqlx::query("VACUUM INTO ?").bind(file.to_string_lossy().into_owned()).execute(&mut source).await?;
        source.close().await?;
        Self::read(file, newest_schema).await
    }

    /// Reads a copy of a schema up to the newest that is known, and checks that it is whole.
    ///
    /// # Errors
    /// [`StoreError::NewerDatabase`], and what the database answers.
    pub async fn read(file: &Path, newest_schema: i64) -> Result<Self, StoreError> {
        let options = SqliteConnectOptions::new().filename(file).read_only(true).immutable(true);
        let mut copy = SqliteConnection::connect_with(&options).await?;
        let integrity: String = sqlx::query_scalar("PRAGMA integrity_check(1)").fetch_one(&mut copy).await?;
        if integrity != "ok" {
            return Err(StoreError::BadValue { column: "integrity_check", value: integrity });
        }
        let schema = sqlx::query_scalar("SELECT max(version) FROM _sqlx_migrations").fetch_one(&mut copy).await?;
        if schema > newest_schema {
            let database = file.display().to_string();
            return Err(StoreError::NewerDatabase { database, found: schema, known: newest_schema });
        }
        let maps: i64 = sqlx::query_scalar("SELECT count(*) FROM maps").fetch_one(&mut copy).await?;
        let rows = sqlx::query("SELECT source FROM maps UNION SELECT blob FROM analyses").fetch_all(&mut copy).await?;
        copy.close().await?;
        let blobs =
            rows.iter().map(|row| Ok(BlobId::from_digits(row.try_get(0)?))).collect::<Result<_, sqlx::Error>>()?;
        Ok(Self { schema, maps: maps.unsigned_abs(), blobs })
    }
}
