//! Rows of maps that were deleted and may be restored.

use async_trait::async_trait;
use jiff::Timestamp;
use uuid::Uuid;

use super::database::Transaction;
use super::rows::map_record;
use super::statement::query;
use super::store::SqlStore;
use crate::records::{MapRecord, Tenant};
use crate::store::{HiddenMap, HiddenMaps, Maps, StoreError};

#[async_trait]
impl HiddenMaps for SqlStore {
    async fn hide_map(
        &self,
        tenant: &Tenant,
        id: Uuid,
        if_match: Option<u64>,
        now: Timestamp,
    ) -> Result<bool, StoreError> {
        let mut transaction = self.database.write().await?;
        transaction.alone_on_site_of(id).await?;
        let hidden = query(
            "UPDATE maps SET hidden = $4, hidden_from = tenant, tenant = '' \
             WHERE tenant = $1 AND id = $2 AND version = coalesce($3, version)",
        )
        .bind(tenant.as_str())
        .bind(id.to_string())
        .bind(if_match.map(u64::cast_signed))
        .bind(now.as_microsecond())
        .execute(&mut transaction)
        .await?;
        if hidden == 0 {
            return Ok(false);
        }
        put_jobs_back(&mut transaction, id, now).await?;
        transaction.commit().await?;
        Ok(true)
    }

    async fn hidden_since(&self, tenant: &Tenant, id: Uuid) -> Result<Option<Timestamp>, StoreError> {
        let row = query("SELECT hidden FROM maps WHERE hidden_from = $1 AND id = $2")
            .bind(tenant.as_str())
            .bind(id.to_string())
            .fetch_optional(&self.database)
            .await?;
        row.map(|row| row.time("hidden")).transpose()
    }

    async fn hidden_maps(
        &self,
        tenant: &Tenant,
        hidden_after: Timestamp,
        limit: u32,
        after: Option<Uuid>,
    ) -> Result<Vec<HiddenMap>, StoreError> {
        let rows = query(
            "SELECT * FROM maps WHERE hidden_from = $1 AND hidden > $2 AND ($3 IS NULL OR id < $3) \
             ORDER BY id DESC LIMIT $4",
        )
        .bind(tenant.as_str())
        .bind(hidden_after.as_microsecond())
        .bind(after.map(|id| id.to_string()))
        .bind(limit)
        .fetch_all(&self.database)
        .await?;
        rows.iter().map(|row| Ok(HiddenMap { map: map_record(row)?, hidden: row.time("hidden")? })).collect()
    }

    async fn restore_map(
        &self,
        tenant: &Tenant,
        id: Uuid,
        hidden_after: Timestamp,
        now: Timestamp,
    ) -> Result<Option<MapRecord>, StoreError> {
        let mut transaction = self.database.write().await?;
        transaction.alone_on_site_of(id).await?;
        let row = query(
            "UPDATE maps SET tenant = hidden_from, hidden = NULL, hidden_from = NULL \
             WHERE hidden_from = $1 AND id = $2 AND hidden > $3 RETURNING *",
        )
        .bind(tenant.as_str())
        .bind(id.to_string())
        .bind(hidden_after.as_microsecond())
        .fetch_optional(&mut transaction)
        .await?;
        let Some(row) = row else { return Ok(None) };
        query(
            "UPDATE jobs SET tenant = $2, updated = CASE WHEN updated < $3 THEN $3 ELSE updated + 1 END WHERE map = $1",
        )
        .bind(id.to_string())
        .bind(tenant.as_str())
        .bind(now.as_microsecond())
        .execute(&mut transaction)
        .await?;
        transaction.commit().await?;
        Ok(Some(map_record(&row)?))
    }

    async fn delete_hidden(&self, hidden_until: Timestamp) -> Result<usize, StoreError> {
        let rows = query("SELECT id FROM maps WHERE hidden <= $1")
            .bind(hidden_until.as_microsecond())
            .fetch_all(&self.database)
            .await?;
        let mut deleted = 0;
        for row in rows {
            // One that was restored in between belongs to somebody again.
            deleted += usize::from(self.delete_map(&Tenant::nobody(), row.uuid("id")?, None).await?);
        }
        Ok(deleted)
    }
}

/// Takes the jobs of a map out of the hands of workers and of everybody. One that was to be cancelled is.
async fn put_jobs_back(transaction: &mut Transaction, map: Uuid, now: Timestamp) -> Result<(), StoreError> {
    query("DELETE FROM idempotency_keys WHERE job IN (SELECT id FROM jobs WHERE map = $1)")
        .bind(map.to_string())
        .execute(&mut *transaction)
        .await?;
    query(
        "UPDATE jobs SET state = CASE WHEN cancel_requested THEN 'dismissed' ELSE 'accepted' END, \
             finished = CASE WHEN cancel_requested THEN $2 END, message = 'put back because the map was deleted', \
             attempt = attempt - 1, progress = 0, stage = NULL, stages = '[]', lease_until = NULL, run_at = 0 \
         WHERE map = $1 AND state = 'running'",
    )
    .bind(map.to_string())
    .bind(now.as_microsecond())
    .execute(&mut *transaction)
    .await?;
    query("UPDATE jobs SET tenant = '', updated = CASE WHEN updated < $2 THEN $2 ELSE updated + 1 END WHERE map = $1")
        .bind(map.to_string())
        .bind(now.as_microsecond())
        .execute(&mut *transaction)
        .await?;
    Ok(())
}
