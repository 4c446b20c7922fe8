//! What a storage of blobs can do.

use std::fmt;
use std::time::Duration;

use async_trait::async_trait;

use super::blob::Blob;
use super::id::BlobId;
use crate::store::StoreError;

/// Where blobs are kept.
#[async_trait]
pub trait Blobs: fmt::Debug + Send + Sync {
    /// Writes a blob, unless it is there already. A damaged copy is replaced. The blob is on stable storage when this
    /// returns.
    ///
    /// # Errors
    /// When it cannot be written.
    async fn put(&self, blob: &Blob) -> Result<(), StoreError>;

    /// Reads a blob and verifies its hash.
    ///
    /// # Errors
    /// [`StoreError::Damaged`] when it is missing or not what was written.
    async fn get(&self, id: &BlobId) -> Result<Blob, StoreError>;

    /// The length of a blob in bytes, whole or not; `None` where there is none.
    ///
    /// # Errors
    /// When nobody knows.
    async fn length(&self, id: &BlobId) -> Result<Option<u64>, StoreError>;

    /// Removes a blob; a missing one is no error.
    ///
    /// # Errors
    /// When it cannot be removed.
    async fn remove(&self, id: &BlobId) -> Result<(), StoreError>;

    /// Addresses of the blobs that were written longer than `age` ago, sorted.
    ///
    /// # Errors
    /// When they cannot be listed.
    async fn older_than(&self, age: Duration) -> Result<Vec<BlobId>, StoreError>;

    /// Removes what interrupted writes left, when they began longer than `age` ago.
    ///
    /// # Errors
    /// When it cannot be listed or removed.
    async fn remove_unfinished(&self, age: Duration) -> Result<(), StoreError>;
}
