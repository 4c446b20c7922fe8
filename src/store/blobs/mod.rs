//! Content-addressed bytes: the name of a blob is the blake3 hash of its bytes.
//!
//! So a blob never changes, writing it twice is writing it once, and reading it can tell whether the disk kept it.

mod blob;
mod format;
mod id;
mod local;
mod storage;

pub use blob::Blob;
pub use format::Stored;
pub use id::BlobId;
pub use local::LocalBlobs;
pub use storage::Blobs;
