//! Where things are in a backup, and how single files get there.

use std::fs::{self, File};
use std::io;
use std::path::Path;

use crate::store::BlobId;

/// The database.
pub const DATABASE: &str = "stillage.sqlite3";

/// The folder of the blobs.
pub const BLOBS: &str = "blobs";

/// The name of a blob's file.
pub fn blob_name(id: &BlobId) -> String {
    format!("{BLOBS}/{}/{id}", &id.as_str()[..2])
}

/// Copies a file with its permissions, onto the disk.
pub fn copy_synced(from: &Path, to: &Path) -> io::Result<()> {
    fs::copy(from, to)?;
    File::open(to)?.sync_all()
}
