//! The log of changes.

use jiff::Timestamp;
use serde::Serialize;
use utoipa::ToSchema;

use super::id::Id;
use super::link::Link;
use crate::records::AuditRecord;

/// That somebody changed something, or tried to.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = AuditEntry)]
#[serde(rename_all = "camelCase")]
pub struct AuditEntryView {
    id: Id,
    /// When it was asked for.
    #[schema(value_type = String, format = DateTime)]
    time: Timestamp,
    /// Who: the id of a key, or `command line`.
    #[schema(example = "5f0c2a9be1d47730")]
    caller: String,
    /// What was asked for, by the `operationId` of the API.
    #[schema(example = "updateMap")]
    operation: String,
    /// Path of what it was about, or of what was made.
    #[schema(example = "/v1/maps/019ab3c2-0000-7000-8000-000000000000")]
    resource: String,
    /// HTTP status of the answer; 499 where none arrived: the client did not wait for it, or the service died
    /// meanwhile.
    #[schema(example = 200)]
    status: u16,
    /// Id of the request (`X-Request-Id`).
    request: String,
}

impl From<AuditRecord> for AuditEntryView {
    fn from(record: AuditRecord) -> Self {
        let AuditRecord { id, tenant: _, time, caller, operation, resource, status, request } = record;
        Self { id: Id(id), time, caller, operation, resource, status, request }
    }
}

/// A page of the log of changes.
#[derive(Debug, Serialize, ToSchema)]
pub struct AuditLogPage {
    /// The newest entry first.
    pub entries: Vec<AuditEntryView>,
    /// Itself, and the next page.
    pub links: Vec<Link>,
}
