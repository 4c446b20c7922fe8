//! Entries of the log of changes.

use jiff::Timestamp;
use uuid::Uuid;

use super::Tenant;

/// That somebody changed something, or tried to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AuditRecord {
    /// Its id, of version 7: the order of the ids is that of the times.
    pub id: Uuid,
    /// Whose thing it is.
    pub tenant: Tenant,
    /// When it was asked for.
    pub time: Timestamp,
    /// Who: the id of a key, the subject of a token, or `command line`.
    pub caller: String,
    /// What was asked for, by the `operationId` of the API.
    pub operation: String,
    /// Path of what it was about, or of what was made.
    pub resource: String,
    /// HTTP status of the answer; [`Self::NOT_ANSWERED`] where none arrived.
    pub status: u16,
    /// Id of the request; empty where there was none.
    pub request: String,
}

impl AuditRecord {
    /// The status where no answer reached the client: it did not wait for one, or the process died meanwhile. That of nginx.
    pub const NOT_ANSWERED: u16 = 499;
}
