//! Maps that were deleted and may be restored for a while.
//!
//! A hidden map and its jobs belong to [`Tenant::nobody`], so that they are not there for anybody. Jobs that wait go on
//! waiting, and those that run are put back: their workers lose the claim. All of it, the blobs too, counts on the disk until
//! the map is deleted.

use async_trait::async_trait;
use jiff::Timestamp;
use uuid::Uuid;

use super::StoreError;
use crate::records::{MapRecord, Tenant};

/// A map that was deleted, and when.
#[derive(Debug, Clone, PartialEq)]
pub struct HiddenMap {
    /// The map as it was.
    pub map: MapRecord,
    /// When it was deleted.
    pub hidden: Timestamp,
}

/// What is kept of deleted maps.
#[async_trait]
pub trait HiddenMaps {
    /// Hides a map, when it is at the version in `if_match`. `false` when there is no such map at that version. Uploads with
    /// its idempotency keys are new ones again.
    async fn hide_map(
        &self,
        tenant: &Tenant,
        id: Uuid,
        if_match: Option<u64>,
        now: Timestamp,
    ) -> Result<bool, StoreError>;

    /// When a map of this tenant was hidden, if it is.
    async fn hidden_since(&self, tenant: &Tenant, id: Uuid) -> Result<Option<Timestamp>, StoreError>;

    /// Maps of this tenant that were hidden after a time, newest first, after one when paging.
    async fn hidden_maps(
        &self,
        tenant: &Tenant,
        hidden_after: Timestamp,
        limit: u32,
        after: Option<Uuid>,
    ) -> Result<Vec<HiddenMap>, StoreError>;

    /// Brings a map back that was hidden after a time, with its jobs; `None` when there is none.
    async fn restore_map(
        &self,
        tenant: &Tenant,
        id: Uuid,
        hidden_after: Timestamp,
        now: Timestamp,
    ) -> Result<Option<MapRecord>, StoreError>;

    /// Deletes everything of the maps that were hidden at a time or before. Answers how many there were.
    async fn delete_hidden(&self, hidden_until: Timestamp) -> Result<usize, StoreError>;
}
