//! Where the servers under test keep what they store.

use std::net::SocketAddr;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;

use tempfile::TempDir;

use crate::object_store::ObjectStore;
use crate::postgres;

/// A folder, and a database on a server where several processes share it. A clone is the same deployment.
#[derive(Clone)]
pub struct Deployment {
    folder: Arc<TempDir>,
    database: Option<String>,
    bucket: Option<Arc<ObjectStore>>,
    lease_s: u64,
}

impl Deployment {
    /// SQLite and files in a folder, for one process.
    pub fn embedded() -> Self {
        let folder = Arc::new(tempfile::tempdir().expect("a temporary folder"));
        // Jobs of a process that was killed come back soon.
        Self { folder, database: None, bucket: None, lease_s: 2 }
    }

    /// PostgreSQL and files in a folder, for several processes; `None` where there is no PostgreSQL.
    pub fn shared() -> Option<Self> {
        Some(Self::on(postgres::new_database()?))
    }

    /// The same with the database at an address.
    pub fn on(database: String) -> Self {
        Self { database: Some(database), ..Self::embedded() }
    }

    /// The same with blobs in a bucket.
    pub fn with_bucket(self, bucket: ObjectStore) -> Self {
        Self { bucket: Some(Arc::new(bucket)), ..self }
    }

    /// The same with a lease of so many seconds.
    pub fn with_lease(self, lease_s: u64) -> Self {
        Self { lease_s, ..self }
    }

    /// The same deployment with its database seen through a proxy.
    pub fn through(&self, proxy: SocketAddr) -> Self {
        let (user, _, name) = self.parts_of_address();
        Self { database: Some(format!("{user}@{proxy}/{name}")), ..self.clone() }
    }

    /// Where the server of the database listens.
    pub fn database_server(&self) -> SocketAddr {
        self.parts_of_address().1.parse().expect("tests use loopback")
    }

    /// User, server and name.
    fn parts_of_address(&self) -> (&str, &str, &str) {
        let address = self.database.as_deref().expect("it has a server");
        let (user, place) = address.split_once('@').expect("an address has a user");
        let (server, name) = place.split_once('/').expect("an address has a database");
        (user, server, name)
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

    /// The bytes of a blob; `None` where there is none.
    pub fn blob(&self, blob: &str) -> Option<Vec<u8>> {
        match &self.bucket {
            Some(bucket) => bucket.object(&format!("blobs/{}/{blob}", &blob[..2])),
            None => std::fs::read(self.blob_file(blob)).ok(),
        }
    }

    /// Makes a key with these scopes, as operators do.
    pub fn new_key(&self, scopes: &str) -> String {
        let mut command = Command::new(env!("CARGO_BIN_EXE_stillage"));
        command.args(["key", "create", "--tenant", "local", "--scopes", scopes, "--data"]).arg(self.folder());
        let output = command.output().expect("it runs");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).expect("is text").trim().to_owned()
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
            let shared = ["--database", database, "--blobs", &blobs, "--lease-s", &self.lease_s.to_string()];
            arguments.extend(shared.map(str::to_owned));
        }
        arguments
    }
}
