//! Where the servers under test keep what they store.

use std::path::{Path, PathBuf};

use tempfile::TempDir;

use crate::object_store::ObjectStore;
use crate::postgres;

/// A folder, and a database on a server where several processes share it.
pub struct Deployment {
    folder: TempDir,
    database: Option<String>,
    bucket: Option<ObjectStore>,
}

impl Deployment {
    /// SQLite and files in a folder, for one process.
    pub fn embedded() -> Self {
        Self { folder: tempfile::tempdir().expect("a temporary folder"), database: None, bucket: None }
    }

    /// PostgreSQL and files in a folder, for several processes; `None` where there is no PostgreSQL.
    pub fn shared() -> Option<Self> {
        let database = Some(postgres::new_database()?);
        Some(Self { database, ..Self::embedded() })
    }

    /// The same with blobs in a bucket.
    pub fn with_bucket(self, bucket: ObjectStore) -> Self {
        Self { bucket: Some(bucket), ..self }
    }

    /// The address of the database that processes share.
    pub fn database(&self) -> Option<&str> {
        self.database.as_deref()
    }

    /// The data folder.
    pub fn folder(&self) -> &Path {
        self.folder.path()
    }

    /// The file of a blob.
    pub fn blob_file(&self, blob: &str) -> PathBuf {
        self.folder().join("blobs").join(&blob[..2]).join(blob)
    }

    /// What the environment is told of it.
    pub fn environment(&self) -> Vec<(&'static str, &str)> {
        self.bucket.as_ref().map(|bucket| bucket.environment().to_vec()).unwrap_or_default()
    }

    /// What the command line is told of it.
    pub fn arguments(&self) -> Vec<String> {
        let mut arguments = vec!["--data".to_owned(), self.folder().display().to_string()];
        if let Some(database) = &self.database {
            let blobs = match self.bucket {
                Some(_) => format!("s3://{}/blobs", ObjectStore::BUCKET),
                None => format!("file://{}", self.folder().join("blobs").display()),
            };
            // Jobs of a process that was killed come back soon.
            let shared = ["--database", database, "--blobs", &blobs, "--lease-s", "2"];
            arguments.extend(shared.map(str::to_owned));
        }
        arguments
    }
}
