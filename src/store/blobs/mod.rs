//! Content-addressed bytes: the name of a blob is the blake3 hash of its bytes.
//!
//! So a blob never changes, writing it twice is writing it once, and reading it can tell whether the disk kept it.

mod blob;
#[cfg(feature = "s3")]
mod bucket;
mod format;
mod id;
mod local;
mod reading;
mod storage;
#[cfg(feature = "s3")]
mod transport;

pub use blob::Blob;
#[cfg(feature = "s3")]
pub use bucket::BucketBlobs;
pub use format::Stored;
pub use id::BlobId;
pub use local::LocalBlobs;
pub use storage::Blobs;
