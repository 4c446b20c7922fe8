//! Rows of the log of changes.

use async_trait::async_trait;
use jiff::Timestamp;
use uuid::Uuid;

use super::columns::SqlRow;
use super::database::{Database, Transaction};
use super::statement::query;
use crate::records::{AuditRecord, Tenant};
use crate::store::audit::entry_of_change;
use crate::store::{AuditLog, StoreError};

#[async_trait]
impl AuditLog for Database {
    async fn record(&self, entry: &AuditRecord) -> Result<(), StoreError> {
        let mut transaction = self.begin().await?;
        transaction.add_entry(entry).await?;
        query("UPDATE audit_log SET resource = $2, status = $3 WHERE id = $1")
            .bind(entry.id.to_string())
            .bind(&entry.resource)
            .bind(i64::from(entry.status))
            .execute(&mut transaction)
            .await?;
        transaction.commit().await
    }

    async fn entries(&self, tenant: &Tenant, limit: u32, after: Option<Uuid>) -> Result<Vec<AuditRecord>, StoreError> {
        let rows =
            query("SELECT * FROM audit_log WHERE tenant = $1 AND ($2 IS NULL OR id < $2) ORDER BY id DESC LIMIT $3")
                .bind(tenant.as_str())
                .bind(after.map(|id| id.to_string()))
                .bind(limit)
                .fetch_all(self)
                .await?;
        rows.iter().map(audit_record).collect()
    }

    async fn forget_before(&self, time: Timestamp) -> Result<u64, StoreError> {
        let mut transaction = self.write().await?;
        let forgotten = query("DELETE FROM audit_log WHERE time < $1")
            .bind(time.as_microsecond())
            .execute(&mut transaction)
            .await?;
        transaction.commit().await?;
        Ok(forgotten)
    }
}

impl Database {
    /// Begins a write, with the entry of the change that it belongs to.
    pub async fn write(&self) -> Result<Transaction, StoreError> {
        let mut transaction = self.begin().await?;
        if let Some(entry) = entry_of_change() {
            transaction.add_entry(&entry).await?;
        }
        Ok(transaction)
    }
}

impl Transaction {
    /// Adds an entry, unless it is there.
    pub(super) async fn add_entry(&mut self, entry: &AuditRecord) -> Result<(), StoreError> {
        query(
            "INSERT INTO audit_log (id, tenant, time, caller, operation, resource, status, request) \
             VALUES ($1, $2, $3, $4, $5, $6, $7, $8) ON CONFLICT (id) DO NOTHING",
        )
        .bind(entry.id.to_string())
        .bind(entry.tenant.as_str())
        .bind(entry.time.as_microsecond())
        .bind(&entry.caller)
        .bind(&entry.operation)
        .bind(&entry.resource)
        .bind(i64::from(entry.status))
        .bind(&entry.request)
        .execute(self)
        .await?;
        Ok(())
    }
}

fn audit_record(row: &SqlRow) -> Result<AuditRecord, StoreError> {
    Ok(AuditRecord {
        id: row.uuid("id")?,
        tenant: row.tenant()?,
        time: row.time("time")?,
        caller: row.text("caller")?,
        operation: row.text("operation")?,
        resource: row.text("resource")?,
        status: row.whole("status")?,
        request: row.text("request")?,
    })
}
