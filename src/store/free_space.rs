//! Room on a disk.

use std::path::Path;

use rustix::fs::statvfs;

use super::StoreError;

/// Bytes that this user may still write on the disk of a folder.
///
/// # Errors
/// When the file system does not answer.
pub fn free_bytes(folder: &Path) -> Result<u64, StoreError> {
    let status = statvfs(folder).map_err(|error| StoreError::folder(folder, error.into()))?;
    Ok(status.f_bavail.saturating_mul(status.f_frsize))
}
