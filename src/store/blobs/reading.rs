//! How a blob is found and read in any object store.

use object_store::path::Path;
use object_store::{ObjectStore, ObjectStoreExt};

use super::{Blob, BlobId};
use crate::blocking::off_the_runtime;
use crate::store::StoreError;

/// `ab/abcd...`, below a prefix where there is one.
pub fn location(prefix: &str, id: &BlobId) -> Path {
    let folder = id.as_str().get(..2).unwrap_or_default();
    prefix.split('/').filter(|part| !part.is_empty()).chain([folder, id.as_str()]).collect()
}

/// Reads a blob and verifies its hash.
///
/// # Errors
/// [`StoreError::Damaged`] when it is missing or not what was written.
pub async fn read_whole(store: &dyn ObjectStore, place: &Path, id: &BlobId) -> Result<Blob, StoreError> {
    let damaged = |reason: &str| StoreError::Damaged { blob: id.clone(), reason: reason.to_owned() };
    let bytes = match store.get(place).await {
        Ok(found) => found.bytes().await?,
        Err(object_store::Error::NotFound { .. }) => return Err(damaged("it is missing")),
        Err(error) => return Err(error.into()),
    };
    let blob = off_the_runtime(move || Blob::new(bytes)).await;
    if blob.id() == id { Ok(blob) } else { Err(damaged("its bytes do not have its hash")) }
}

/// How long what is at a place is, bytes; `None` where nothing is.
///
/// # Errors
/// When the store does not answer.
pub async fn length(store: &dyn ObjectStore, place: &Path) -> Result<Option<u64>, StoreError> {
    match store.head(place).await {
        Ok(found) => Ok(Some(found.size)),
        Err(object_store::Error::NotFound { .. }) => Ok(None),
        Err(error) => Err(error.into()),
    }
}
