//! The open store as a whole.

use std::path::PathBuf;
use std::time::Duration;

use async_trait::async_trait;
use jiff::Timestamp;

use super::database::Database;
use super::statement::query;
use crate::config::{BlobAddress, Config};
#[cfg(feature = "s3")]
use crate::store::blobs::BucketBlobs;
use crate::store::blobs::LocalBlobs;
use crate::store::free_space::free_bytes;
use crate::store::{AuditLog, Blobs, DiskUse, Keys, Store, StoreError, now};

/// Rows in a database, blobs beside them.
#[derive(Debug)]
pub struct SqlStore {
    pub(in crate::store) database: Database,
    pub(super) blobs: Box<dyn Blobs>,
    /// The folder whose disk must have room; `None` where nothing is written to disks of this machine.
    space_in: Option<PathBuf>,
    min_free_bytes: u64,
}

impl SqlStore {
    /// Opens the configured database and blobs, and brings the database up to date.
    ///
    /// # Errors
    /// What stands against it, for whoever configured it.
    pub async fn open(config: &Config) -> Result<Self, StoreError> {
        let database = Database::open(&config.database).await?;
        let blobs = open_blobs(&config.blobs)?;
        let space_in = match (&database, &config.blobs) {
            (Database::Sqlite(engine), _) => Some(engine.folder.path().to_owned()),
            #[cfg(feature = "postgres")]
            (Database::Postgres(_), BlobAddress::Folder(folder)) => Some(folder.clone()),
            #[cfg(all(feature = "postgres", feature = "s3"))]
            (Database::Postgres(_), BlobAddress::Bucket(_)) => None,
        };
        Ok(Self { database, blobs, space_in, min_free_bytes: config.min_free_bytes })
    }
}

/// Opens the blobs at an address.
///
/// # Errors
/// When they cannot be reached, or the address makes no sense.
pub fn open_blobs(address: &BlobAddress) -> Result<Box<dyn Blobs>, StoreError> {
    Ok(match address {
        BlobAddress::Folder(folder) => Box::new(LocalBlobs::open(folder)?),
        #[cfg(feature = "s3")]
        BlobAddress::Bucket(address) => Box::new(BucketBlobs::open(address)?),
    })
}

#[async_trait]
impl Store for SqlStore {
    fn blobs(&self) -> &dyn Blobs {
        &*self.blobs
    }

    fn keys(&self) -> &dyn Keys {
        &self.database
    }

    fn audit(&self) -> &dyn AuditLog {
        &self.database
    }

    fn is_shared(&self) -> bool {
        self.database.is_shared()
    }

    fn writes(&self) -> Option<u64> {
        match &self.database {
            Database::Sqlite(engine) => engine.writes(),
            // Other processes write, too.
            #[cfg(feature = "postgres")]
            Database::Postgres(_) => None,
        }
    }

    fn check_space(&self) -> Result<(), StoreError> {
        match &self.space_in {
            Some(folder) if free_bytes(folder)? < self.min_free_bytes => Err(StoreError::NoSpace),
            _ => Ok(()),
        }
    }

    fn disk_use(&self) -> Result<DiskUse, StoreError> {
        let log_bytes = match &self.database {
            Database::Sqlite(engine) => Some(engine.folder.log_bytes()),
            #[cfg(feature = "postgres")]
            Database::Postgres(_) => None,
        };
        Ok(DiskUse { free_bytes: self.space_in.as_deref().map(free_bytes).transpose()?, log_bytes })
    }

    async fn check(&self) -> Result<(), StoreError> {
        query("SELECT count(*) FROM maps WHERE id = ''").fetch_one(&self.database).await?;
        self.check_space()
    }

    async fn schema_version(&self) -> Result<i64, StoreError> {
        let row = query("SELECT max(version) AS version FROM _sqlx_migrations").fetch_one(&self.database).await?;
        row.whole("version")
    }

    async fn clock(&self) -> Result<Timestamp, StoreError> {
        if !self.database.is_shared() {
            return Ok(now());
        }
        query("SELECT CAST(extract(epoch FROM clock_timestamp()) * 1000000 AS bigint) AS now")
            .fetch_one(&self.database)
            .await?
            .time("now")
    }

    async fn job_changed_elsewhere(&self) {
        match &self.database {
            Database::Sqlite(_) => std::future::pending().await,
            #[cfg(feature = "postgres")]
            Database::Postgres(engine) => engine.job_changed().await,
        }
    }

    async fn sweep_blobs(&self, age: Duration) -> Result<usize, StoreError> {
        self.remove_orphans(age).await
    }

    async fn measure_unmeasured_blobs(&self) -> Result<u64, StoreError> {
        self.measure_unmeasured().await
    }

    async fn close(&self) {
        match &self.database {
            Database::Sqlite(engine) => engine.close().await,
            #[cfg(feature = "postgres")]
            Database::Postgres(engine) => engine.close().await,
        }
    }
}

#[cfg(test)]
impl SqlStore {
    /// Changes rows behind the store's back.
    pub async fn run(&self, sql: &'static str) {
        let mut transaction = self.database.begin().await.expect("it begins");
        query(sql).execute(&mut transaction).await.expect("it is SQL");
        transaction.commit().await.expect("it ends");
    }
}
