//! Content-addressed bytes: the name of a blob is the blake3 hash of its bytes.
//!
//! So a blob never changes, writing it twice is writing it once, and reading it can tell whether the disk kept it.

mod format;
mod local;

use std::fmt;
use std::time::Duration;

use async_trait::async_trait;
use bytes::Bytes;

use super::StoreError;

use format::FormatError;
pub use format::Stored;
pub use local::LocalBlobs;

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

/// Address of a blob: 64 hexadecimal digits.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct BlobId(String);

impl BlobId {
    /// The digits.
    #[must_use]
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// The address of these bytes.
    #[must_use]
    pub fn of(bytes: &[u8]) -> Self {
        Self(blake3::hash(bytes).to_hex().to_string())
    }

    /// The address with these digits, which the store wrote earlier.
    pub(super) const fn from_digits(digits: String) -> Self {
        Self(digits)
    }
}

impl fmt::Display for BlobId {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.0)
    }
}

/// Bytes with their address.
#[derive(Debug, Clone)]
pub struct Blob {
    id: BlobId,
    bytes: Bytes,
}

impl Blob {
    /// Bytes as they are.
    #[must_use]
    pub fn new(bytes: impl Into<Bytes>) -> Self {
        let bytes = bytes.into();
        Self { id: BlobId::of(&bytes), bytes }
    }

    /// Encodes a value in the newest format of its type. Takes a while for a big one: not for the threads of the async
    /// runtime.
    #[must_use]
    pub fn encode<T: Stored>(value: &T) -> Self {
        Self::new(format::encode(value))
    }

    /// Decodes what [`Self::encode`] of this release or an earlier one wrote.
    ///
    /// # Errors
    /// [`StoreError::Damaged`] when it is something else, [`StoreError::Format`] when this release does not read its
    /// format.
    pub fn decode<T: Stored>(&self) -> Result<T, StoreError> {
        format::decode(&self.bytes).map_err(|error| match error {
            FormatError::Damaged(reason) => StoreError::Damaged { blob: self.id.clone(), reason },
            FormatError::Unreadable(reason) => StoreError::Format { blob: self.id.clone(), reason },
        })
    }

    /// Its address.
    #[must_use]
    pub const fn id(&self) -> &BlobId {
        &self.id
    }

    /// Its bytes.
    #[must_use]
    pub const fn bytes(&self) -> &Bytes {
        &self.bytes
    }
}
