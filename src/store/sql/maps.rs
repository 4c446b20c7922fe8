//! Rows of maps and idempotency keys.

use async_trait::async_trait;
use jiff::Timestamp;
use uuid::Uuid;

use super::capacity::Addition;
use super::database::Transaction;
use super::jobs::insert_job;
use super::rows::{job_record, json, map_record};
use super::statement::query;
use super::store::SqlStore;
use crate::coordinates::Survey;
use crate::fail_point;
use crate::records::{MapPatch, MapRecord, Tenant};
use crate::store::{Blob, BlobId, Capacity, Full, IdempotencyKey, Maps, NewJob, NewMapRow, StoreError, Upload};

/// How long an idempotency key is remembered, microseconds: a day, as Stripe keeps them at least
/// (<https://docs.stripe.com/api/idempotent_requests>).
const KEY_LIFE_US: i64 = 24 * 3600 * 1_000_000;

#[async_trait]
impl Maps for SqlStore {
    async fn full(&self, tenant: &Tenant, capacity: &Capacity) -> Result<Option<Full>, StoreError> {
        let new = Addition { maps: 1, bytes: 1 };
        self.database.snapshot().await?.full(tenant, capacity, new).await
    }

    async fn create_map(
        &self,
        tenant: &Tenant,
        map: &NewMapRow,
        source: &Blob,
        job: &NewJob,
        key: Option<&IdempotencyKey>,
        capacity: &Capacity,
        now: Timestamp,
    ) -> Result<Upload, StoreError> {
        let mut transaction = self.write_with(Some(source)).await?;
        fail_point::pass("after-upload-blob");
        if let Some(key) = key {
            transaction.alone_on(&format!("key {} {}", tenant.as_str(), key.key)).await?;
            forget_old_keys(&mut transaction, now).await?;
            if let Some(seen) = find_key(&mut transaction, tenant, key).await? {
                return Ok(seen);
            }
        }
        transaction.alone_on_tenant(tenant, capacity).await?;
        let new = Addition { maps: 1, bytes: source.bytes().len() as u64 };
        if let Some(full) = transaction.full(tenant, capacity, new).await? {
            return Ok(Upload::Full(full));
        }
        transaction.alone_on_site(map.site).await?;
        insert_map(&mut transaction, tenant, map, source, now).await?;
        let job = insert_job(&mut transaction, tenant, job, now).await?;
        if let Some(key) = key {
            query("INSERT INTO idempotency_keys (tenant, key, content, job, created) VALUES ($1, $2, $3, $4, $5)")
                .bind(tenant.as_str())
                .bind(&key.key)
                .bind(&key.content)
                .bind(job.id.to_string())
                .bind(now.as_microsecond())
                .execute(&mut transaction)
                .await?;
        }
        fail_point::pass("before-upload-commit");
        transaction.commit().await?;
        fail_point::pass("after-upload-commit");
        Ok(Upload::New(job))
    }

    async fn seen_upload(
        &self,
        tenant: &Tenant,
        key: &IdempotencyKey,
        now: Timestamp,
    ) -> Result<Option<Upload>, StoreError> {
        let mut transaction = self.database.snapshot().await?;
        let young = query("SELECT 1 FROM idempotency_keys WHERE tenant = $1 AND key = $2 AND created > $3")
            .bind(tenant.as_str())
            .bind(&key.key)
            .bind(now.as_microsecond() - KEY_LIFE_US)
            .fetch_optional(&mut transaction)
            .await?;
        if young.is_some() { find_key(&mut transaction, tenant, key).await } else { Ok(None) }
    }

    async fn maps(&self, tenant: &Tenant, limit: u32, after: Option<Uuid>) -> Result<Vec<MapRecord>, StoreError> {
        let rows = query("SELECT * FROM maps WHERE tenant = $1 AND ($2 IS NULL OR id < $2) ORDER BY id DESC LIMIT $3")
            .bind(tenant.as_str())
            .bind(after.map(|id| id.to_string()))
            .bind(limit)
            .fetch_all(&self.database)
            .await?;
        rows.iter().map(map_record).collect()
    }

    async fn map(&self, tenant: &Tenant, id: Uuid) -> Result<Option<MapRecord>, StoreError> {
        let row = query("SELECT * FROM maps WHERE tenant = $1 AND id = $2").bind(tenant.as_str()).bind(id.to_string());
        row.fetch_optional(&self.database).await?.as_ref().map(map_record).transpose()
    }

    async fn map_source(&self, tenant: &Tenant, id: Uuid) -> Result<Option<BlobId>, StoreError> {
        let row =
            query("SELECT source FROM maps WHERE tenant = $1 AND id = $2").bind(tenant.as_str()).bind(id.to_string());
        row.fetch_optional(&self.database).await?.map(|row| row.blob("source")).transpose()
    }

    async fn update_map(
        &self,
        tenant: &Tenant,
        id: Uuid,
        patch: &MapPatch,
        if_match: Option<u64>,
        now: Timestamp,
    ) -> Result<Option<Result<MapRecord, MapRecord>>, StoreError> {
        let mut transaction = self.database.write().await?;
        transaction.alone_on_site_of(id).await?;
        let row = query("SELECT * FROM maps WHERE tenant = $1 AND id = $2").bind(tenant.as_str()).bind(id.to_string());
        let Some(row) = row.fetch_optional(&mut transaction).await? else { return Ok(None) };
        let current = map_record(&row)?;
        if if_match.is_some_and(|version| version != current.version) {
            return Ok(Some(Err(current)));
        }
        let name = patch.name.as_ref().unwrap_or(&current.name);
        let surveyed = |georeference| Survey { georeference, pairs: current.point_pairs.clone() };
        let georeference = patch.georeference.clone().unwrap_or_else(|| current.georeference.map(surveyed));
        let row = query(
            "UPDATE maps SET name = $2, georeference = $3, updated = $4, version = version + 1 WHERE id = $1 RETURNING *",
        )
        .bind(id.to_string())
        .bind(name)
        .bind(georeference.as_ref().map(json))
        .bind(now.as_microsecond())
        .fetch_one(&mut transaction)
        .await?;
        transaction.commit().await?;
        Ok(Some(Ok(map_record(&row)?)))
    }

    /// On a full disk the space set aside is given up, so that deleting can make room.
    async fn delete_map(&self, tenant: &Tenant, id: Uuid, if_match: Option<u64>) -> Result<bool, StoreError> {
        let blobs = match self.delete_map_rows(tenant, id, if_match).await {
            Err(StoreError::NoSpace) if self.database.release_reserve() => {
                self.delete_map_rows(tenant, id, if_match).await?
            }
            other => other?,
        };
        let Some(blobs) = blobs else { return Ok(false) };
        fail_point::pass("after-delete-commit");
        for blob in blobs {
            // The rows are gone and that is the answer; a blob that stays is swept later.
            if let Err(error) = self.remove_unreferenced(&blob).await {
                tracing::warn!(%error, %blob, "a blob of a deleted map could not be removed");
            }
        }
        self.database.restore_reserve();
        Ok(true)
    }
}

impl SqlStore {
    async fn delete_map_rows(
        &self,
        tenant: &Tenant,
        id: Uuid,
        if_match: Option<u64>,
    ) -> Result<Option<Vec<BlobId>>, StoreError> {
        let mut transaction = self.database.write().await?;
        transaction.alone_on_site_of(id).await?;
        let rows = query(
            "SELECT source AS blob FROM maps WHERE tenant = $1 AND id = $2 \
                 UNION SELECT blob FROM analyses WHERE map = $2",
        )
        .bind(tenant.as_str())
        .bind(id.to_string())
        .fetch_all(&mut transaction)
        .await?;
        let blobs = rows.iter().map(|row| row.blob("blob")).collect::<Result<Vec<_>, _>>()?;
        let deleted = query("DELETE FROM maps WHERE tenant = $1 AND id = $2 AND version = coalesce($3, version)")
            .bind(tenant.as_str())
            .bind(id.to_string())
            .bind(if_match.map(u64::cast_signed))
            .execute(&mut transaction)
            .await?;
        if deleted == 0 {
            return Ok(None);
        }
        // A site ends with its last map.
        query("DELETE FROM registries WHERE NOT EXISTS (SELECT 1 FROM maps WHERE maps.site = registries.site)")
            .execute(&mut transaction)
            .await?;
        transaction.commit().await?;
        Ok(Some(blobs))
    }
}

async fn insert_map(
    transaction: &mut Transaction,
    tenant: &Tenant,
    map: &NewMapRow,
    source: &Blob,
    now: Timestamp,
) -> Result<(), StoreError> {
    query(
        "INSERT INTO maps (id, name, created, updated, width, height, resolution, georeference, warnings, source, version, \
             tenant, site, alignment, bytes) \
         VALUES ($1, $2, $3, $3, $4, $5, $6, $7, $8, $9, 1, $10, $11, $12, $13)",
    )
    .bind(map.id.to_string())
    .bind(&map.name)
    .bind(now.as_microsecond())
    .bind(map.width)
    .bind(map.height)
    .bind(map.resolution)
    .bind(map.georeference.as_ref().map(json))
    .bind(json(&map.warnings))
    .bind(source.id().as_str())
    .bind(tenant.as_str())
    .bind(map.site.to_string())
    .bind(map.alignment.as_ref().map(json))
    .bind(source.bytes().len() as i64)
    .execute(&mut *transaction)
    .await?;
    Ok(())
}

async fn forget_old_keys(transaction: &mut Transaction, now: Timestamp) -> Result<(), StoreError> {
    query("DELETE FROM idempotency_keys WHERE created <= $1")
        .bind(now.as_microsecond() - KEY_LIFE_US)
        .execute(&mut *transaction)
        .await?;
    Ok(())
}

async fn find_key(
    transaction: &mut Transaction,
    tenant: &Tenant,
    key: &IdempotencyKey,
) -> Result<Option<Upload>, StoreError> {
    let row = query(
        "SELECT jobs.*, idempotency_keys.content AS content \
         FROM idempotency_keys JOIN jobs ON jobs.id = idempotency_keys.job \
         WHERE idempotency_keys.tenant = $1 AND idempotency_keys.key = $2",
    )
    .bind(tenant.as_str())
    .bind(&key.key)
    .fetch_optional(&mut *transaction)
    .await?;
    let Some(row) = row else { return Ok(None) };
    let same = row.text("content")? == key.content;
    Ok(Some(if same { Upload::Seen(job_record(&row)?) } else { Upload::KeyReused }))
}
