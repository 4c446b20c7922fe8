//! Blobs and the rows that name them: written before, removed when no row names them any more.

use std::time::Duration;

use super::database::{Database, Transaction};
use super::statement::{RunsOn, query};
use super::store::SqlStore;
use crate::store::{Blob, BlobId, StoreError};

impl SqlStore {
    /// Writes a blob and begins the transaction that names it: until that ends, nobody removes the blob.
    pub(super) async fn write_with(&self, blob: Option<&Blob>) -> Result<Transaction, StoreError> {
        let Some(blob) = blob else { return self.database.write().await };
        match &self.database {
            Database::Sqlite(engine) => {
                let gate = engine.blob_gate.clone().read_owned().await;
                self.blobs.put(blob).await?;
                let mut transaction = self.database.write().await?;
                transaction.keep(gate);
                Ok(transaction)
            }
            // The lock and the row are in one transaction: whoever loses the connection loses both.
            #[cfg(feature = "postgres")]
            Database::Postgres(_) => {
                // A store that is slow, or away, takes no connection from those who do not need it.
                self.blobs.put(blob).await?;
                let mut transaction = self.database.write().await?;
                transaction.keep_blob(blob.id()).await?;
                // It may have been removed before it was kept.
                if self.blobs.length(blob.id()).await?.is_none() {
                    self.blobs.put(blob).await?;
                }
                Ok(transaction)
            }
        }
    }

    /// Removes a blob that no row names.
    pub(super) async fn remove_unreferenced(&self, id: &BlobId) -> Result<bool, StoreError> {
        match &self.database {
            Database::Sqlite(engine) => {
                let _gate = engine.blob_gate.write().await;
                self.remove_if_free(id, &self.database).await
            }
            #[cfg(feature = "postgres")]
            Database::Postgres(_) => {
                let mut transaction = self.database.write().await?;
                transaction.alone_on_blob(id).await?;
                self.remove_if_free(id, &mut transaction).await
            }
        }
    }

    /// Removes blobs without a row that are older than `age`, and what interrupted writes left.
    pub(super) async fn remove_orphans(&self, age: Duration) -> Result<usize, StoreError> {
        match &self.database {
            Database::Sqlite(engine) => {
                // Nothing is being written under the gate, and no other process writes into the locked folder.
                let _gate = engine.blob_gate.write().await;
                self.blobs.remove_unfinished(Duration::ZERO).await?;
            }
            #[cfg(feature = "postgres")]
            Database::Postgres(_) => self.blobs.remove_unfinished(age).await?,
        }
        let mut removed = 0;
        for id in self.blobs.older_than(age).await? {
            removed += usize::from(self.remove_unreferenced(&id).await?);
        }
        Ok(removed)
    }

    /// Fills in the lengths of blobs that an earlier release stored without. One that is missing stays without.
    pub(super) async fn measure_unmeasured(&self) -> Result<u64, StoreError> {
        let rows =
            query("SELECT source AS blob FROM maps WHERE bytes = 0 UNION SELECT blob FROM analyses WHERE bytes = 0");
        let mut measured = 0;
        for row in rows.fetch_all(&self.database).await? {
            let blob = row.blob("blob")?;
            let Some(length) = self.blobs.length(&blob).await? else { continue };
            let mut transaction = self.database.write().await?;
            for sql in [
                "UPDATE maps SET bytes = $2 WHERE source = $1 AND bytes = 0",
                "UPDATE analyses SET bytes = $2 WHERE blob = $1 AND bytes = 0",
            ] {
                query(sql).bind(blob.as_str()).bind(length as i64).execute(&mut transaction).await?;
            }
            transaction.commit().await?;
            measured += 1;
        }
        Ok(measured)
    }

    /// The caller has seen to it that no row begins to name the blob.
    async fn remove_if_free<'a>(&self, id: &BlobId, place: impl Into<RunsOn<'a>>) -> Result<bool, StoreError> {
        let row = query(
            "SELECT EXISTS (SELECT 1 FROM maps WHERE source = $1) OR EXISTS (SELECT 1 FROM analyses WHERE blob = $1) \
             AS referenced",
        )
        .bind(id.as_str())
        .fetch_one(place)
        .await?;
        if row.flag("referenced")? {
            return Ok(false);
        }
        self.blobs.remove(id).await?;
        Ok(true)
    }
}
