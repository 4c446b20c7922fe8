//! Content-addressed files: the name of a blob is the blake3 hash of its bytes.
//!
//! So a blob never changes, writing it twice is writing it once, and reading it can tell whether the disk kept it.
//! Values are written as postcard, compressed with zstd.

use std::fmt;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use bytes::Bytes;
use object_store::local::LocalFileSystem;
use object_store::{ObjectStore, ObjectStoreExt, PutMode, PutOptions, PutPayload};
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::StoreError;

/// zstd's own default: category maps shrink about tenfold at several hundred MB/s.
const COMPRESSION_LEVEL: i32 = 3;

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

    pub(super) const fn from_column(digits: String) -> Self {
        Self(digits)
    }

    fn location(&self) -> object_store::path::Path {
        let folder = self.0.get(..2).unwrap_or_default();
        object_store::path::Path::from_iter([folder, &self.0])
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
    /// Encodes a value. Takes a while for a big one: not for the threads of the async runtime.
    ///
    /// # Panics
    /// When the value cannot be written as postcard (only for a sequence of unknown length, which no stored type has).
    #[must_use]
    pub fn encode<T: Serialize>(value: &T) -> Self {
        let plain = postcard::to_stdvec(value).expect("stored types have sequences of known length");
        let bytes = zstd::encode_all(plain.as_slice(), COMPRESSION_LEVEL).expect("memory can be read and written");
        Self::new(bytes)
    }

    /// Bytes as they are.
    #[must_use]
    pub fn new(bytes: impl Into<Bytes>) -> Self {
        let bytes = bytes.into();
        Self { id: BlobId::of(&bytes), bytes }
    }

    /// Decodes what [`Self::encode`] wrote.
    ///
    /// # Errors
    /// [`StoreError::Damaged`] when it is something else.
    pub fn decode<T: DeserializeOwned>(&self) -> Result<T, StoreError> {
        let damaged = |reason: String| StoreError::Damaged { blob: self.id.clone(), reason };
        let plain = zstd::decode_all(&*self.bytes).map_err(|error| damaged(error.to_string()))?;
        postcard::from_bytes(&plain).map_err(|error| damaged(error.to_string()))
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

/// The folder of blobs.
#[derive(Debug)]
pub struct Blobs {
    folder: PathBuf,
    files: LocalFileSystem,
}

impl Blobs {
    /// Opens an existing folder.
    ///
    /// # Errors
    /// When it is not there.
    pub fn open(folder: &Path) -> Result<Self, StoreError> {
        // Without fsync, which is off by default, a committed row could name a file lost in a power cut.
        let files = LocalFileSystem::new_with_prefix(folder)?.with_fsync(true);
        Ok(Self { folder: folder.to_owned(), files })
    }

    /// Writes a blob, unless it is there already. A copy that the disk damaged is replaced.
    ///
    /// # Errors
    /// When it cannot be written.
    pub async fn put(&self, blob: &Blob) -> Result<(), StoreError> {
        let payload = || PutPayload::from_bytes(blob.bytes.clone());
        let create = PutOptions { mode: PutMode::Create, ..PutOptions::default() };
        match self.files.put_opts(&blob.id.location(), payload(), create).await {
            Ok(_) => Ok(()),
            Err(object_store::Error::AlreadyExists { .. }) => match self.get(&blob.id).await {
                Ok(_) => Ok(()),
                Err(_) => Ok(self.files.put(&blob.id.location(), payload()).await.map(drop)?),
            },
            Err(error) => Err(error.into()),
        }
    }

    /// Reads a blob and verifies it.
    ///
    /// # Errors
    /// [`StoreError::Damaged`] when it is missing or not what was written.
    pub async fn get(&self, id: &BlobId) -> Result<Blob, StoreError> {
        let damaged = |reason: &str| StoreError::Damaged { blob: id.clone(), reason: reason.to_owned() };
        let bytes = match self.files.get(&id.location()).await {
            Ok(file) => file.bytes().await?,
            Err(object_store::Error::NotFound { .. }) => return Err(damaged("it is missing")),
            Err(error) => return Err(error.into()),
        };
        let blob = off_the_runtime(move || Blob::new(bytes)).await;
        if blob.id == *id { Ok(blob) } else { Err(damaged("its bytes do not have its hash")) }
    }

    /// Removes a blob; a missing one is fine.
    ///
    /// # Errors
    /// When it cannot be removed.
    pub async fn remove(&self, id: &BlobId) -> Result<(), StoreError> {
        match self.files.delete(&id.location()).await {
            Ok(()) | Err(object_store::Error::NotFound { .. }) => Ok(()),
            Err(error) => Err(error.into()),
        }
    }

    /// Addresses of the blobs that were written longer than `age` ago, sorted.
    ///
    /// # Errors
    /// When the folder cannot be read.
    pub async fn older_than(&self, age: Duration) -> Result<Vec<BlobId>, StoreError> {
        let now = SystemTime::now();
        let files = self.list().await?;
        let old = |file: &File| now.duration_since(file.modified).is_ok_and(|elapsed| elapsed >= age);
        Ok(files.into_iter().filter(|file| is_address(&file.name) && old(file)).map(|file| BlobId(file.name)).collect())
    }

    /// Removes the staging files of writes that were cut off. To be called while nothing is written.
    ///
    /// # Errors
    /// When the folder cannot be read or a file not removed.
    pub(super) async fn remove_unfinished(&self) -> Result<(), StoreError> {
        for file in self.list().await?.into_iter().filter(|file| !is_address(&file.name)) {
            std::fs::remove_file(&file.path).map_err(|error| StoreError::folder(&file.path, error))?;
        }
        Ok(())
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

/// A file in the folder.
struct File {
    path: PathBuf,
    name: String,
    modified: SystemTime,
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

/// Whether a file is a whole blob; staging files have a suffix.
fn is_address(name: &str) -> bool {
    name.len() == 64 && name.bytes().all(|byte| byte.is_ascii_hexdigit())
}

/// Runs something long on a thread that may block.
pub async fn off_the_runtime<T: Send + 'static>(run: impl FnOnce() -> T + Send + 'static) -> T {
    // A task that has begun to block cannot be cancelled, so the error is a panic, and the caller's.
    tokio::task::spawn_blocking(run).await.unwrap_or_else(|error| std::panic::resume_unwind(error.into_panic()))
}
