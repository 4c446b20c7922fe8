//! The data folder: owned by one process, with some space set aside.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Read, Seek, Write};
use std::path::{Path, PathBuf};

use rustix::fs::{FlockOperation, flock};

use crate::store::StoreError;

/// The file of the rows in a data folder.
pub(super) const DATABASE_FILE: &str = "stillage.sqlite3";

/// Space set aside. Deleting rows from a full disk needs some for the write-ahead log: 1 MiB was measured to be enough
/// for a small delete, the rest is margin.
const RESERVE_BYTES: u64 = 4 << 20;

/// The file that says that a restore has begun and not ended.
const RESTORING: &str = "restore-unfinished";

/// The folder, locked until this value is dropped (or the process dies, however it dies), unless another process has it.
#[derive(Debug)]
pub struct DataFolder {
    path: PathBuf,
    _lock: Option<File>,
}

impl DataFolder {
    /// Makes the folder if need be and takes its lock.
    ///
    /// # Errors
    /// [`StoreError::FolderInUse`] when another process holds the lock.
    fn take(path: &Path) -> Result<Self, StoreError> {
        fs::create_dir_all(path).map_err(|error| StoreError::folder(path, error))?;
        let path = fs::canonicalize(path).map_err(|error| StoreError::folder(path, error))?;
        let lock = take_lock(&path)?;
        Ok(Self { path, _lock: Some(lock) })
    }

    /// The folder of another process. No blob and no job may be touched in it.
    ///
    /// # Errors
    /// When it is not there any more.
    pub fn of_another_process(path: &Path) -> Result<Self, StoreError> {
        let path = fs::canonicalize(path).map_err(|error| StoreError::folder(path, error))?;
        Ok(Self { path, _lock: None })
    }

    /// Takes the folder for a service.
    ///
    /// # Errors
    /// What [`Self::take`] answers, and [`StoreError::RestoreUnfinished`] where only a part of a backup is there.
    pub fn open(path: &Path) -> Result<Self, StoreError> {
        let folder = Self::take(path)?;
        if folder.restoring().exists() {
            return Err(StoreError::RestoreUnfinished(folder.path));
        }
        Ok(folder)
    }

    /// Whether there is more in a folder than a restore may find there: what an interrupted one left, and what every disk has.
    #[must_use]
    pub fn holds_something(path: &Path) -> bool {
        let Ok(entries) = fs::read_dir(path) else { return path.exists() };
        let harmless = ["lock", "lost+found"];
        let mut others = entries.flatten().filter(|entry| !harmless.iter().any(|name| entry.file_name() == *name));
        !path.join(RESTORING).exists() && others.next().is_some()
    }

    /// Takes the folder for a restore. Until [`Self::end_restore`] no service opens it.
    ///
    /// # Errors
    /// What [`Self::take`] answers, and when the folder cannot be written.
    pub fn begin_restore(path: &Path) -> Result<Self, StoreError> {
        let folder = Self::take(path)?;
        let marked = File::create(folder.restoring()).and_then(|file| file.sync_all()).and_then(|()| folder.sync());
        marked.map_err(|error| StoreError::folder(&folder.path, error))?;
        Ok(folder)
    }

    /// Puts the rows where the blobs are, and lets services open the folder.
    ///
    /// # Errors
    /// When the folder cannot be written.
    pub fn end_restore(&self, rows: &Path) -> Result<(), StoreError> {
        let database = self.database();
        let copied = fs::copy(rows, &database)
            .and_then(|_| File::open(&database)?.sync_all())
            .and_then(|()| self.sync())
            .and_then(|()| fs::remove_file(self.restoring()))
            .and_then(|()| self.sync());
        copied.map_err(|error| StoreError::folder(&database, error))
    }

    fn sync(&self) -> io::Result<()> {
        File::open(&self.path)?.sync_all()
    }

    fn restoring(&self) -> PathBuf {
        self.path.join(RESTORING)
    }

    /// The database file.
    #[must_use]
    pub fn database(&self) -> PathBuf {
        self.path.join(DATABASE_FILE)
    }

    /// Length of the write-ahead log; none where it is empty.
    #[must_use]
    pub fn log_bytes(&self) -> u64 {
        fs::metadata(self.path.join(format!("{DATABASE_FILE}-wal"))).map_or(0, |metadata| metadata.len())
    }

    /// The folder itself.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Gives up the space set aside, so that a full disk lets something be deleted. Answers whether there was any.
    #[must_use]
    pub fn release_reserve(&self) -> bool {
        fs::remove_file(self.reserve()).is_ok()
    }

    /// Sets the space aside again, where there is enough.
    ///
    /// # Errors
    /// When it cannot be written; what was written of it is removed.
    pub fn restore_reserve(&self) -> io::Result<()> {
        let path = self.reserve();
        if fs::metadata(&path).is_ok_and(|metadata| metadata.len() == RESERVE_BYTES) {
            return Ok(());
        }
        // Written, not only made long: a sparse file would hold nothing back.
        let written =
            File::create(&path).and_then(|mut file| io::copy(&mut io::repeat(0x5a).take(RESERVE_BYTES), &mut file));
        if written.is_err() {
            let _ = fs::remove_file(&path);
        }
        written.map(drop)
    }

    fn reserve(&self) -> PathBuf {
        self.path.join("reserve")
    }
}

/// Locks the folder and leaves the process id in the lock file, for the message of the process that comes second.
fn take_lock(folder: &Path) -> Result<File, StoreError> {
    let path = folder.join("lock");
    let failed = |error: io::Error| StoreError::folder(&path, error);
    let mut file =
        OpenOptions::new().read(true).write(true).create(true).truncate(false).open(&path).map_err(failed)?;
    match flock(&file, FlockOperation::NonBlockingLockExclusive) {
        Ok(()) => {}
        Err(rustix::io::Errno::WOULDBLOCK) => {
            let mut holder = String::new();
            let _ = file.read_to_string(&mut holder);
            return Err(StoreError::FolderInUse { folder: folder.to_owned(), holder: holder.trim().parse().ok() });
        }
        Err(error) => return Err(failed(error.into())),
    }
    // Only a courtesy to people: a full disk must not keep the service from starting.
    let _ = file.set_len(0).and_then(|()| file.rewind()).and_then(|()| writeln!(file, "{}", std::process::id()));
    Ok(file)
}
