//! Uploads and analyses from the store.
//!
//! Where an upload is damaged or missing, it cannot be made again; whoever has its files sends them once more, and the store
//! writes the same blob anew. An analysis is made again ([`super::mending`]).

use uuid::Uuid;

use super::{AnalysisRecord, App, AppError};
use crate::store::{Blob, BlobId, StoreError};

impl App {
    /// The upload of a map.
    pub(super) async fn stored_upload(&self, map: Uuid, id: &BlobId) -> Result<Blob, AppError> {
        self.store.blobs().get(id).await.map_err(|error| match error {
            StoreError::Damaged { reason, .. } => AppError::Damaged(format!(
                "the stored upload of map {map} is damaged ({reason}): upload the same files once more, which mends it"
            )),
            other => other.into(),
        })
    }

    /// An analysis of the map that was uploaded as `source`.
    pub(super) async fn stored_analysis(
        &self,
        source: &Blob,
        record: &AnalysisRecord,
        id: &BlobId,
    ) -> Result<Blob, AppError> {
        match self.store.blobs().get(id).await {
            Err(StoreError::Damaged { reason, .. }) => {
                Err(self.mending.begin((&self.store, &self.config), source, (record, id), &reason))
            }
            found => Ok(found?),
        }
    }
}
