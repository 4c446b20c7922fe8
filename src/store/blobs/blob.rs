//! Bytes with their address.

use bytes::Bytes;

use super::format::{self, FormatError, Stored};
use super::id::BlobId;
use crate::store::StoreError;

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
