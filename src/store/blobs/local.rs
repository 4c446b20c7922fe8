//! Blobs as files of a local folder, two levels deep: `ab/abcd...`.

use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use async_trait::async_trait;
use object_store::local::LocalFileSystem;
use object_store::{ObjectStore, ObjectStoreExt, PutMode, PutOptions, PutPayload};

use super::reading::{length, location, read_whole};
use super::{Blob, BlobId, Blobs};
use crate::blocking::off_the_runtime;
use crate::store::StoreError;

/// The folder of the blobs.
#[derive(Debug)]
pub struct LocalBlobs {
    folder: PathBuf,
    files: LocalFileSystem,
}

impl LocalBlobs {
    /// Opens a folder; makes it where it is missing.
    ///
    /// # Errors
    /// When it cannot be made or read.
    pub fn open(folder: &Path) -> Result<Self, StoreError> {
        std::fs::create_dir_all(folder).map_err(|error| StoreError::folder(folder, error))?;
        // Without fsync, which is off by default, a committed row could name a file lost in a power cut.
        let files = LocalFileSystem::new_with_prefix(folder)?.with_fsync(true);
        Ok(Self { folder: folder.to_owned(), files })
    }

    async fn list(&self) -> Result<Vec<File>, StoreError> {
        let folder = self.folder.clone();
        off_the_runtime(move || {
            let mut files = Vec::new();
            list_into(&folder, &mut files).map_err(|error| StoreError::folder(&folder, error))?;
            files.sort_by(|first, second| first.name.cmp(&second.name));
            Ok(files)
        })
        .await
    }
}

#[async_trait]
impl Blobs for LocalBlobs {
    async fn put(&self, blob: &Blob) -> Result<(), StoreError> {
        let payload = || PutPayload::from_bytes(blob.bytes().clone());
        let create = PutOptions { mode: PutMode::Create, ..PutOptions::default() };
        match self.files.put_opts(&location("", blob.id()), payload(), create).await {
            Ok(_) => Ok(()),
            Err(object_store::Error::AlreadyExists { .. }) => match self.get(blob.id()).await {
                Ok(_) => Ok(()),
                Err(_) => Ok(self.files.put(&location("", blob.id()), payload()).await.map(drop)?),
            },
            Err(error) => Err(error.into()),
        }
    }

    async fn get(&self, id: &BlobId) -> Result<Blob, StoreError> {
        read_whole(&self.files, &location("", id), id).await
    }

    async fn length(&self, id: &BlobId) -> Result<Option<u64>, StoreError> {
        length(&self.files, &location("", id)).await
    }

    async fn remove(&self, id: &BlobId) -> Result<(), StoreError> {
        match self.files.delete(&location("", id)).await {
            Ok(()) | Err(object_store::Error::NotFound { .. }) => Ok(()),
            Err(error) => Err(error.into()),
        }
    }

    async fn older_than(&self, age: Duration) -> Result<Vec<BlobId>, StoreError> {
        let files = self.list().await?;
        let old = files.into_iter().filter(|file| file.is_blob() && file.is_older_than(age));
        Ok(old.map(|file| BlobId::from_digits(file.name)).collect())
    }

    async fn remove_unfinished(&self, age: Duration) -> Result<(), StoreError> {
        let files = self.list().await?;
        for file in files.into_iter().filter(|file| !file.is_blob() && file.is_older_than(age)) {
            std::fs::remove_file(&file.path).map_err(|error| StoreError::folder(&file.path, error))?;
        }
        Ok(())
    }
}

/// A file in the folder.
struct File {
    path: PathBuf,
    name: String,
    modified: SystemTime,
}

impl File {
    /// Whether it is a whole blob; staging files have a suffix.
    fn is_blob(&self) -> bool {
        BlobId::find(&self.name).is_some()
    }

    fn is_older_than(&self, age: Duration) -> bool {
        age.is_zero() || SystemTime::now().duration_since(self.modified).is_ok_and(|elapsed| elapsed >= age)
    }
}

fn list_into(folder: &Path, files: &mut Vec<File>) -> std::io::Result<()> {
    for entry in std::fs::read_dir(folder)? {
        let entry = entry?;
        let metadata = entry.metadata()?;
        if metadata.is_dir() {
            list_into(&entry.path(), files)?;
        } else {
            let name = entry.file_name().to_string_lossy().into_owned();
            files.push(File { path: entry.path(), name, modified: metadata.modified()? });
        }
    }
    Ok(())
}
