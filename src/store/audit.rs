//! The log of changes: who changed what, and when.

use async_trait::async_trait;
use jiff::Timestamp;
use tokio::task_local;
use uuid::Uuid;

use super::StoreError;
use crate::records::{AuditRecord, Tenant};

task_local! {
    /// The entry of the change that the task carries out.
    static CHANGE: AuditRecord;
}

/// What is kept of changes.
#[async_trait]
pub trait AuditLog: Send + Sync {
    /// Adds an entry; where one of its id is there, that gets its resource and status.
    async fn record(&self, entry: &AuditRecord) -> Result<(), StoreError>;

    /// Entries of a tenant, newest first, after one when paging.
    async fn entries(&self, tenant: &Tenant, limit: u32, after: Option<Uuid>) -> Result<Vec<AuditRecord>, StoreError>;

    /// Removes the entries of all tenants from before a time. Answers how many there were.
    async fn forget_before(&self, time: Timestamp) -> Result<u64, StoreError>;
}

/// Carries out a change. Every transaction in which it writes adds the entry, too, unless that is there already: both are
/// committed, or neither is.
pub async fn with_entry<T>(entry: AuditRecord, change: impl Future<Output = T>) -> T {
    CHANGE.scope(entry, change).await
}

/// The entry of the change that the calling task carries out, if it carries out one.
pub(super) fn entry_of_change() -> Option<AuditRecord> {
    CHANGE.try_with(Clone::clone).ok()
}
