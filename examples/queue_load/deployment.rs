//! Where processes keep what they store, and how they are started.

use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

use sqlx::{AssertSqlSafe, Connection, Executor, PgConnection};
use tempfile::TempDir;

use crate::serving::Serving;

/// Databases made so far.
static DATABASES: AtomicUsize = AtomicUsize::new(0);

/// A new, empty deployment.
pub struct Deployment {
    folder: TempDir,
    database: Option<String>,
}

impl Deployment {
    /// On SQLite, or in a new database of a server.
    pub fn new(server: Option<&str>) -> Self {
        Self { folder: tempfile::tempdir().expect("a temporary folder"), database: server.map(new_database) }
    }

    /// Whether several processes may use it.
    pub fn is_shared(&self) -> bool {
        self.database.is_some()
    }

    /// Starts a process with more arguments.
    pub fn start(&self, arguments: &[&str]) -> Serving {
        let data = self.folder.path().display().to_string();
        let blobs = format!("file://{data}/blobs");
        let mut all = vec!["serve", "--listen", "127.0.0.1:0", "--max-queued-jobs", "1000000", "--data", &data];
        if let Some(database) = &self.database {
            all.extend(["--database", database, "--blobs", &blobs]);
        }
        let own = || std::env::current_exe().expect("this program has a path");
        let program = std::env::var_os("STILLAGE_BINARY").map_or_else(own, PathBuf::from);
        Serving::start_program(&program, &[&all, arguments].concat())
    }
}

fn new_database(server: &str) -> String {
    let name = format!("queue_load_{}", 1 + DATABASES.fetch_add(1, Ordering::Relaxed));
    let made = async {
        let mut connection = PgConnection::connect(&format!("{server}/postgres")).await?;
        for sql in [format!("DROP DATABASE IF EXISTS {name} WITH (FORCE)"), format!("CREATE DATABASE {name}")] {
            connection.execute(AssertSqlSafe(sql)).await?;
        }
        connection.close().await
    };
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().expect("a runtime");
    runtime.block_on(made).expect("the server makes databases");
    format!("{server}/{name}")
}
