//! Maps are deleted, and restored for a while after that.

use jiff::{SignedDuration, Timestamp};
use uuid::Uuid;

use super::maps::MAX_PAGE;
use super::{App, AppError, Caller, MapRecord};
use crate::jobs::{delete_hidden, kept_since};
use crate::store::{HiddenMap, StoreError};

/// A map that was deleted and can still be restored.
#[derive(Debug, Clone, PartialEq)]
pub struct DeletedMap {
    /// The map as it was.
    pub map: MapRecord,
    /// When it was deleted.
    pub deleted: Timestamp,
    /// Until when it can be restored.
    pub restorable_until: Timestamp,
}

impl App {
    /// Deletes a map. Its jobs go with it: one that runs stops within a second. It can be restored as long as deleted maps are
    /// kept; where the disk is short, none are. `if_match` is optional here.
    pub async fn delete_map(&self, caller: &Caller, id: Uuid, if_match: Option<u64>) -> Result<(), AppError> {
        let tenant = caller.tenant();
        let is_done = if self.config.keep_deleted.is_zero() {
            self.store.delete_map(tenant, id, if_match).await?
        } else {
            match self.store.hide_map(tenant, id, if_match, self.store.clock().await?).await {
                // On a full disk nothing more can be written, and deleting makes room.
                Err(StoreError::NoSpace) => self.store.delete_map(tenant, id, if_match).await?,
                hidden => hidden?,
            }
        };
        if !is_done {
            let current = self.map(caller, id).await?.version;
            return Err(AppError::PreconditionFailed { current });
        }
        self.contexts.remove(id);
        self.signals.changed();
        delete_hidden(&*self.store, self.config.keep_deleted).await?;
        Ok(())
    }

    /// Brings a deleted map back, with its analyses, labels and jobs. One that is there stays as it is.
    pub async fn restore_map(&self, caller: &Caller, id: Uuid) -> Result<MapRecord, AppError> {
        let now = self.store.clock().await?;
        let hidden_after = kept_since(self.config.keep_deleted, now);
        match self.store.restore_map(caller.tenant(), id, hidden_after, now).await? {
            Some(record) => {
                self.signals.queued();
                self.signals.changed();
                Ok(record)
            }
            None => self.map(caller, id).await,
        }
    }

    /// Deleted maps that can be restored, newest first.
    pub async fn deleted_maps(
        &self,
        caller: &Caller,
        limit: u32,
        after: Option<Uuid>,
    ) -> Result<Vec<DeletedMap>, AppError> {
        let hidden_after = kept_since(self.config.keep_deleted, self.store.clock().await?);
        let maps = self.store.hidden_maps(caller.tenant(), hidden_after, limit.min(MAX_PAGE), after).await?;
        let deleted = |HiddenMap { map, hidden }| DeletedMap {
            map,
            deleted: hidden,
            restorable_until: self.end_of_keeping(hidden),
        };
        Ok(maps.into_iter().map(deleted).collect())
    }

    /// Until when a deleted map can be restored; `None` for one that cannot.
    pub async fn restorable_until(&self, caller: &Caller, id: Uuid) -> Result<Option<Timestamp>, AppError> {
        let Some(deleted) = self.store.hidden_since(caller.tenant(), id).await? else { return Ok(None) };
        let until = self.end_of_keeping(deleted);
        Ok((until > self.store.clock().await?).then_some(until))
    }

    fn end_of_keeping(&self, deleted: Timestamp) -> Timestamp {
        let keep = SignedDuration::try_from(self.config.keep_deleted).unwrap_or(SignedDuration::MAX);
        deleted.checked_add(keep).unwrap_or(Timestamp::MAX)
    }
}
