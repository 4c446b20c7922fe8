//! API keys. Only the hash of a key is kept, so that nobody can read one from here.

use async_trait::async_trait;
use jiff::Timestamp;

use super::StoreError;
use crate::access::KeyHash;
use crate::records::{KeyRecord, Tenant};

/// What is kept of keys. What changes them goes into the log of changes of their tenant, too.
#[async_trait]
pub trait Keys: Send + Sync {
    /// Stores a new key.
    async fn create_key(&self, key: &KeyRecord, hash: &KeyHash) -> Result<(), StoreError>;

    /// The keys of a tenant, or of all, in the order of their tenants and times.
    async fn keys(&self, tenant: Option<&Tenant>) -> Result<Vec<KeyRecord>, StoreError>;

    /// A key by its public part, and the hash of the whole of it.
    async fn key(&self, id: &str) -> Result<Option<(KeyRecord, KeyHash)>, StoreError>;

    /// Ends a key for good; one that has ended so stays as it is. `None` when there is no such key.
    async fn revoke_key(&self, id: &str, now: Timestamp) -> Result<Option<KeyRecord>, StoreError>;
}
