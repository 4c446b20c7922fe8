//! Rows of API keys.

use async_trait::async_trait;
use jiff::Timestamp;
use uuid::Uuid;

use super::columns::SqlRow;
use super::database::{Database, Transaction};
use super::statement::query;
use crate::access::{KeyHash, Scopes};
use crate::records::{AuditRecord, KeyRecord, Tenant};
use crate::store::{Keys, StoreError};

/// Who changes keys, in the log of changes.
const COMMAND_LINE: &str = "command line";

#[async_trait]
impl Keys for Database {
    async fn create_key(&self, key: &KeyRecord, hash: &KeyHash) -> Result<(), StoreError> {
        let mut transaction = self.write().await?;
        query(
            "INSERT INTO api_keys (id, tenant, name, scopes, hash, created, expires) VALUES ($1, $2, $3, $4, $5, $6, $7)",
        )
        .bind(&key.id)
        .bind(key.tenant.as_str())
        .bind(&key.name)
        .bind(key.scopes.to_string())
        .bind(hash.to_string())
        .bind(key.created.as_microsecond())
        .bind(key.expires.map(Timestamp::as_microsecond))
        .execute(&mut transaction)
        .await?;
        record(&mut transaction, key, ("createKey", 201), key.created).await?;
        transaction.commit().await
    }

    async fn keys(&self, tenant: Option<&Tenant>) -> Result<Vec<KeyRecord>, StoreError> {
        let rows = query("SELECT * FROM api_keys WHERE coalesce($1, tenant) = tenant ORDER BY tenant, created, id")
            .bind(tenant.map(|tenant| tenant.as_str().to_owned()))
            .fetch_all(self)
            .await?;
        rows.iter().map(key_record).collect()
    }

    async fn key(&self, id: &str) -> Result<Option<(KeyRecord, KeyHash)>, StoreError> {
        let row = query("SELECT * FROM api_keys WHERE id = $1").bind(id).fetch_optional(self).await?;
        row.map(|row| Ok((key_record(&row)?, key_hash(&row)?))).transpose()
    }

    async fn revoke_key(&self, id: &str, now: Timestamp) -> Result<Option<KeyRecord>, StoreError> {
        let mut transaction = self.write().await?;
        let revoked = query("UPDATE api_keys SET revoked = $2 WHERE id = $1 AND revoked IS NULL RETURNING *")
            .bind(id)
            .bind(now.as_microsecond())
            .fetch_optional(&mut transaction)
            .await?;
        let Some(row) = revoked else {
            let row = query("SELECT * FROM api_keys WHERE id = $1").bind(id).fetch_optional(&mut transaction).await?;
            return row.as_ref().map(key_record).transpose();
        };
        let key = key_record(&row)?;
        record(&mut transaction, &key, ("revokeKey", 200), now).await?;
        transaction.commit().await?;
        Ok(Some(key))
    }
}

async fn record(
    transaction: &mut Transaction,
    key: &KeyRecord,
    (operation, status): (&str, u16),
    time: Timestamp,
) -> Result<(), StoreError> {
    let entry = AuditRecord {
        id: Uuid::now_v7(),
        tenant: key.tenant.clone(),
        time,
        caller: COMMAND_LINE.to_owned(),
        operation: operation.to_owned(),
        resource: format!("key {}", key.id),
        status,
        request: String::new(),
    };
    transaction.add_entry(&entry).await
}

fn key_record(row: &SqlRow) -> Result<KeyRecord, StoreError> {
    Ok(KeyRecord {
        id: row.text("id")?,
        tenant: row.tenant()?,
        name: row.text("name")?,
        scopes: Scopes::of_words(&row.text("scopes")?),
        created: row.time("created")?,
        expires: row.time_if("expires")?,
        revoked: row.time_if("revoked")?,
    })
}

fn key_hash(row: &SqlRow) -> Result<KeyHash, StoreError> {
    let value = row.text("hash")?;
    KeyHash::from_digits(&value).ok_or(StoreError::BadValue { column: "hash", value })
}
