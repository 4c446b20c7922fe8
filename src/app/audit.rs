//! The log of changes: who changed what, and when. It is kept where requests need keys: without them everybody is nobody.

use uuid::Uuid;

use super::{App, AppError, Caller};
use crate::records::AuditRecord;
use crate::store::now;

/// A change as it was answered.
#[derive(Debug, Clone)]
pub struct AnsweredChange {
    /// The `operationId`.
    pub operation: String,
    /// Path of what it was about, or of what was made.
    pub resource: String,
    /// HTTP status; 499 where the client did not wait for one.
    pub status: u16,
    /// Id of the request.
    pub request: String,
}

impl App {
    /// Records that a caller changed something, or tried to. Where it cannot be written, it is in the log of the process: what
    /// was changed is changed.
    pub async fn record_change(&self, caller: &Caller, change: AnsweredChange) {
        if !self.needs_keys() {
            return;
        }
        let AnsweredChange { operation, resource, status, request } = change;
        let (tenant, caller) = (caller.tenant().clone(), caller.name().to_owned());
        let entry =
            AuditRecord { id: Uuid::now_v7(), tenant, time: now(), caller, operation, resource, status, request };
        if let Err(error) = self.store.audit().record(&entry).await {
            tracing::error!(%error, ?entry, "an entry of the log of changes could not be written");
        }
    }

    /// The log of changes of a tenant, newest first.
    pub async fn changes_recorded(
        &self,
        caller: &Caller,
        limit: u32,
        after: Option<Uuid>,
    ) -> Result<Vec<AuditRecord>, AppError> {
        Ok(self.store.audit().entries(caller.tenant(), limit, after).await?)
    }
}
