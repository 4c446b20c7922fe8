//! A backup is checked, and becomes a store.

use std::collections::BTreeMap;
use std::path::Path;

use super::error::BackupError;
use super::layout::{BLOBS, DATABASE, blob_name, copy_synced};
use super::manifest::{self, BackupContents, damaged};
use super::progress::CopyProgress;
use crate::access::KEY_SECRET_FILE;
use crate::blocking::off_the_runtime;
use crate::config::Config;
use crate::store::sql::open_blobs;
use crate::store::sqlite::{DataFolder, DatabaseCopy, newest_schema};
use crate::store::{BlobId, Blobs as _, LocalBlobs};

/// Reads all of a backup and compares it with its checksums.
///
/// # Errors
/// [`BackupError::Damaged`] names the first file that is not what was written.
pub async fn check_backup(backup: &Path, tell: impl Fn(CopyProgress)) -> Result<BackupContents, BackupError> {
    let (contents, files) = {
        let backup = backup.to_owned();
        off_the_runtime(move || manifest::read(&backup)).await?
    };
    let of = files.len() as u64;
    for (done, (name, hash)) in files.iter().enumerate() {
        tell(CopyProgress { done: done as u64, of });
        let (path, hash) = (backup.join(name), hash.clone());
        off_the_runtime(move || check_file(&path, &hash)).await?;
    }
    check_rows(backup, &contents, &files).await?;
    Ok(contents)
}

fn check_file(path: &Path, hash: &str) -> Result<(), BackupError> {
    match manifest::checksum(path) {
        Ok(found) if found.hash == hash => Ok(()),
        Ok(_) => Err(damaged(path, "its bytes do not have its hash")),
        Err(error) => Err(damaged(path, &format!("it cannot be read ({error})"))),
    }
}

/// The rows name what is there, and nothing else.
async fn check_rows(
    backup: &Path,
    contents: &BackupContents,
    files: &BTreeMap<String, String>,
) -> Result<(), BackupError> {
    let database = backup.join(DATABASE);
    if !files.contains_key(DATABASE) {
        return Err(BackupError::Incomplete { folder: backup.to_owned(), file: DATABASE });
    }
    let rows = DatabaseCopy::read(&database, newest_schema()).await?;
    let is_there = |id: &BlobId| files.contains_key(&blob_name(id)) || contents.damaged.contains(&id.to_string());
    match rows.blobs.iter().find(|id| !is_there(id)) {
        Some(id) => Err(damaged(&database, &format!("it names the blob {id}, which the backup does not have"))),
        None => Ok(()),
    }
}

/// Makes a store of a backup, in a data folder that is empty or not there. Where it is interrupted, the folder does not open,
/// and the same call begins anew.
///
/// # Errors
/// [`BackupError::Taken`] where the folder holds something, [`BackupError::Damaged`] before anything is written.
pub async fn restore(
    backup: &Path,
    config: &Config,
    tell: impl Fn(CopyProgress),
) -> Result<BackupContents, BackupError> {
    let data = config.database.folder().ok_or(BackupError::Shared)?;
    if DataFolder::holds_something(data) {
        return Err(BackupError::Taken(data.to_owned()));
    }
    let contents = check_backup(backup, &tell).await?;
    let folder = DataFolder::begin_restore(data)?;
    let (copies, blobs) = (LocalBlobs::open(&backup.join(BLOBS))?, open_blobs(&config.blobs)?);
    let rows = DatabaseCopy::read(&backup.join(DATABASE), newest_schema()).await?;
    for (done, id) in rows.blobs.iter().enumerate() {
        tell(CopyProgress { done: done as u64, of: rows.blobs.len() as u64 });
        if !contents.damaged.contains(&id.to_string()) {
            blobs.put(&copies.get(id).await?).await?;
        }
    }
    let (secret, its_place) = (backup.join(KEY_SECRET_FILE), data.join(KEY_SECRET_FILE));
    let database = backup.join(DATABASE);
    off_the_runtime(move || {
        if secret.exists() {
            copy_synced(&secret, &its_place).map_err(BackupError::file(&its_place))?;
        }
        Ok::<_, BackupError>(folder.end_restore(&database)?)
    })
    .await?;
    Ok(contents)
}
