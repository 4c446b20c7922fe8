//! The log of changes: who changed what, and when. It is kept where requests need keys: without them everybody is nobody.

use uuid::Uuid;

use super::{App, AppError, Caller};
use crate::records::AuditRecord;
use crate::store::now;

impl App {
    /// The entry of a change that somebody asks for and that is not answered yet: by its `operationId`, the path of what it is
    /// about, and the id of its request. `None` where no log is kept.
    #[must_use]
    pub fn entry_of(
        &self,
        caller: &Caller,
        operation: String,
        resource: String,
        request: String,
    ) -> Option<AuditRecord> {
        self.needs_keys().then(|| AuditRecord {
            id: Uuid::now_v7(),
            tenant: caller.tenant().clone(),
            time: now(),
            caller: caller.name().to_owned(),
            operation,
            resource,
            status: AuditRecord::NOT_ANSWERED,
            request,
        })
    }

    /// Records how a change was answered. Where that cannot be written, it is in the log of the process: what was changed is
    /// changed, and in the log of changes without its answer.
    pub async fn record_answer(&self, entry: &AuditRecord) {
        if let Err(error) = self.store.audit().record(entry).await {
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
