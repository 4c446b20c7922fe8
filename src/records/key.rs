//! API keys as they are stored.

use jiff::Timestamp;

use super::Tenant;
use crate::access::Scopes;

/// A key, without its secret.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct KeyRecord {
    /// Its public part.
    pub id: String,
    /// For whom it acts.
    pub tenant: Tenant,
    /// What people call it.
    pub name: String,
    /// What it is good for.
    pub scopes: Scopes,
    /// When it was made.
    pub created: Timestamp,
    /// When it ends by itself.
    pub expires: Option<Timestamp>,
    /// When somebody ended it.
    pub revoked: Option<Timestamp>,
}

impl KeyRecord {
    /// Whether it opens something at a time.
    #[must_use]
    pub fn is_valid_at(&self, time: Timestamp) -> bool {
        self.revoked.is_none() && self.expires.is_none_or(|end| time < end)
    }
}
