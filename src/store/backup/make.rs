//! A backup is made.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::path::{Path, PathBuf};

use super::error::BackupError;
use super::layout::{BLOBS, DATABASE, blob_name, copy_synced};
use super::manifest::{self, BackupContents, Checksum, CopiedRows};
use super::progress::CopyProgress;
use crate::access::KEY_SECRET_FILE;
use crate::blocking::off_the_runtime;
use crate::config::Config;
use crate::store::sql::open_blobs;
use crate::store::sqlite::{DatabaseCopy, newest_schema};
use crate::store::{BlobId, Blobs, LocalBlobs, StoreError, now};

/// How often the rows are copied again because blobs of theirs were deleted before they were read. Each round has only what
/// came since the one before.
const MOST_ROUNDS: usize = 20;

/// Copies a store, of which a process may make use meanwhile, into a folder that is empty or not there. What was begun and not
/// ended does not get the name of the folder.
///
/// # Errors
/// [`BackupError::NoStore`], [`BackupError::Taken`], and what stands against it.
pub async fn back_up(config: &Config, to: &Path, tell: impl Fn(CopyProgress)) -> Result<BackupContents, BackupError> {
    let data = config.database.folder().ok_or(BackupError::Shared)?;
    if !DatabaseCopy::is_possible(data) {
        return Err(BackupError::NoStore(data.to_owned()));
    }
    let place = BackupPlace::beside(to)?;
    let unfinished = place.unfinished.path().to_owned();
    let source = open_blobs(&config.blobs)?;
    let copied_to = LocalBlobs::open(&unfinished.join(BLOBS))?;
    let mut blobs = BTreeMap::new();
    let mut missing_before = None;
    for _ in 0..MOST_ROUNDS {
        let made = now();
        let rows = DatabaseCopy::take(data, &unfinished.join(DATABASE), newest_schema()).await?;
        let missing = copy_blobs(&*source, &copied_to, &rows, &mut blobs, &tell).await?;
        // A blob that rows name again and again and nobody can read was not deleted: it is damaged.
        if missing.is_empty() || missing_before.as_ref() == Some(&missing) {
            forget_others(&copied_to, &rows, &mut blobs).await?;
            let damaged = missing.iter().map(ToString::to_string).collect();
            let rows = CopiedRows { schema: rows.schema, made, maps: rows.maps, damaged };
            let secret = data.join(KEY_SECRET_FILE);
            return off_the_runtime(move || finish(place, rows, &blobs, &secret)).await;
        }
        missing_before = Some(missing);
    }
    Err(BackupError::TooBusy)
}

/// Copies the blobs that rows name and that are not copied yet; answers those that cannot be read.
async fn copy_blobs(
    source: &dyn Blobs,
    to: &LocalBlobs,
    rows: &DatabaseCopy,
    copied: &mut BTreeMap<BlobId, u64>,
    tell: impl Fn(CopyProgress),
) -> Result<Vec<BlobId>, StoreError> {
    let mut missing = Vec::new();
    for (done, id) in rows.blobs.iter().enumerate() {
        tell(CopyProgress { done: done as u64, of: rows.blobs.len() as u64 });
        if copied.contains_key(id) {
            continue;
        }
        match source.get(id).await {
            Ok(blob) => {
                to.put(&blob).await?;
                copied.insert(id.clone(), blob.bytes().len() as u64);
            }
            Err(StoreError::Damaged { blob, .. }) => missing.push(blob),
            Err(error) => return Err(error),
        }
    }
    Ok(missing)
}

/// Removes the copies of blobs that were deleted since.
async fn forget_others(
    copies: &LocalBlobs,
    rows: &DatabaseCopy,
    copied: &mut BTreeMap<BlobId, u64>,
) -> Result<(), StoreError> {
    let others: Vec<BlobId> = copied.keys().filter(|id| !rows.blobs.contains(id)).cloned().collect();
    for id in others {
        copies.remove(&id).await?;
        copied.remove(&id);
    }
    Ok(())
}

/// Copies the secret of the keys, where there is one, writes the lists, and gives the backup its name.
fn finish(
    place: BackupPlace,
    rows: CopiedRows,
    blobs: &BTreeMap<BlobId, u64>,
    secret: &Path,
) -> Result<BackupContents, BackupError> {
    let unfinished = place.unfinished.path();
    let database = unfinished.join(DATABASE);
    File::open(&database).and_then(|file| file.sync_all()).map_err(BackupError::file(&database))?;
    let mut files: BTreeMap<String, Checksum> =
        blobs.iter().map(|(id, &bytes)| (blob_name(id), Checksum { hash: id.to_string(), bytes })).collect();
    files.insert(DATABASE.to_owned(), manifest::checksum(&database).map_err(BackupError::file(&database))?);
    if secret.exists() {
        let copy = unfinished.join(KEY_SECRET_FILE);
        copy_synced(secret, &copy).map_err(BackupError::file(&copy))?;
        files.insert(KEY_SECRET_FILE.to_owned(), manifest::checksum(&copy).map_err(BackupError::file(&copy))?);
    }
    let contents = manifest::write(unfinished, rows, blobs.len() as u64, &files)?;
    place.finish()?;
    Ok(contents)
}

/// Where a backup is to be, and where it is while it is made.
struct BackupPlace {
    folder: PathBuf,
    parent: PathBuf,
    /// Removed when this is dropped.
    unfinished: tempfile::TempDir,
}

impl BackupPlace {
    fn beside(folder: &Path) -> Result<Self, BackupError> {
        let is_free = match fs::read_dir(folder) {
            Ok(mut entries) => entries.next().is_none(),
            Err(_) => !folder.exists(),
        };
        if !is_free {
            return Err(BackupError::Taken(folder.to_owned()));
        }
        let parent =
            folder.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new(".")).to_owned();
        fs::create_dir_all(&parent).map_err(BackupError::file(&parent))?;
        let name = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let unfinished = tempfile::Builder::new().prefix(&format!("{name}.unfinished-")).tempdir_in(&parent);
        Ok(Self { folder: folder.to_owned(), unfinished: unfinished.map_err(BackupError::file(&parent))?, parent })
    }

    fn finish(self) -> Result<(), BackupError> {
        let sync = |folder: &Path| File::open(folder).and_then(|folder| folder.sync_all());
        let named = sync(self.unfinished.path())
            .and_then(|()| fs::rename(self.unfinished.path(), &self.folder))
            .and_then(|()| sync(&self.parent));
        named.map_err(BackupError::file(&self.folder))?;
        // It has another name now: there is nothing left to remove.
        let _ = self.unfinished.keep();
        Ok(())
    }
}
