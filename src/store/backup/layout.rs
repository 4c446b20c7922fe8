//! Where things are in a backup.

use crate::store::BlobId;

/// The database.
pub const DATABASE: &str = "stillage.sqlite3";

/// The folder of the blobs.
pub const BLOBS: &str = "blobs";

/// The name of a blob's file.
pub fn blob_name(id: &BlobId) -> String {
    format!("{BLOBS}/{}/{id}", &id.as_str()[..2])
}
