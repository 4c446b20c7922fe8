//! The log of changes: who changed what, and when.

use async_trait::async_trait;
use jiff::Timestamp;
use uuid::Uuid;

use super::StoreError;
use crate::records::{AuditRecord, Tenant};

/// What is kept of changes.
#[async_trait]
pub trait AuditLog: Send + Sync {
    /// Adds an entry.
    async fn record(&self, entry: &AuditRecord) -> Result<(), StoreError>;

    /// Entries of a tenant, newest first, after one when paging.
    async fn entries(&self, tenant: &Tenant, limit: u32, after: Option<Uuid>) -> Result<Vec<AuditRecord>, StoreError>;

    /// Removes the entries of all tenants from before a time. Answers how many there were.
    async fn forget_before(&self, time: Timestamp) -> Result<u64, StoreError>;
}
