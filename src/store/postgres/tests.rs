//! The engine on a server of the tests' own.

#[path = "../../../tests/servers/postgres.rs"]
mod server;

use std::collections::BTreeMap;
use std::sync::Arc;

use sqlx::Row as _;
use tempfile::TempDir;

use super::*;
use crate::config::{Config, DatabaseAddress};
use crate::records::JobState;
use crate::store::contract::{Engine, Fixture, TERMS, local, upload};
use crate::store::sql::SqlStore;
use crate::store::{BlobId, Store, now};

/// A store on a database of its own.
pub struct OnServer {
    store: Arc<dyn Store>,
    sql: Arc<SqlStore>,
    config: Config,
    folder: TempDir,
}

impl Engine for OnServer {
    async fn empty() -> Option<Self> {
        let address = server::new_database()?;
        let folder = tempfile::tempdir().expect("a temporary folder");
        let database = DatabaseAddress::Postgres(address);
        let config = Config { database, min_free_bytes: 0, job_slots: 0, ..Config::new(folder.path()) };
        let sql = Arc::new(SqlStore::open(&config).await.expect("the store opens"));
        Some(Self { store: Arc::<SqlStore>::clone(&sql), sql, config, folder })
    }

    fn store(&self) -> &Arc<dyn Store> {
        &self.store
    }

    fn sql(&self) -> &SqlStore {
        &self.sql
    }

    fn blob_file(&self, blob: &BlobId) -> std::path::PathBuf {
        self.folder.path().join("blobs").join(&blob.as_str()[..2]).join(blob.as_str())
    }
}

#[tokio::test]
async fn processes_share_it_and_none_takes_the_jobs_of_another() {
    let Some(first) = OnServer::empty().await else { return };
    let second: Arc<dyn Store> = Arc::new(SqlStore::open(&first.config).await.expect("another process"));
    let job = upload(first.store(), "map").await;
    let held = first.store().claim(&TERMS, now()).await.unwrap().expect("it waits");
    assert_eq!(second.end_claims_of_dead_processes(1, now()).await.unwrap(), 0, "who knows that it is dead");
    assert!(second.claim(&TERMS, now()).await.unwrap().is_none());
    assert_eq!(second.writes(), None, "what was read may change");
    first.store().end(&held, JobState::Failed, "no", now()).await.unwrap();
    assert_eq!(second.job(&local(), job.id).await.unwrap().unwrap().message, "no");
}

#[tokio::test]
async fn a_change_of_a_job_is_told_to_other_processes() {
    let Some(first) = OnServer::empty().await else { return };
    let second: Arc<dyn Store> = Arc::new(SqlStore::open(&first.config).await.expect("another process"));
    second.job_changed_elsewhere().await;
    let told = tokio::spawn(async move {
        let begun = std::time::Instant::now();
        second.job_changed_elsewhere().await;
        begun.elapsed()
    });
    tokio::time::sleep(Duration::from_millis(50)).await;
    upload(first.store(), "map").await;
    assert!(told.await.unwrap() < Duration::from_millis(900), "before the second is over");
}

#[tokio::test]
async fn the_clock_is_that_of_the_server() {
    let Some(engine) = OnServer::empty().await else { return };
    let difference = engine.store().clock().await.unwrap().as_millisecond() - now().as_millisecond();
    assert!(difference.abs() < 5_000, "the server runs on this machine: {difference} ms");
}

#[tokio::test]
async fn a_newer_database_is_refused() {
    let Some(engine) = OnServer::empty().await else { return };
    let DatabaseAddress::Postgres(address) = &engine.config.database else { panic!("it is PostgreSQL") };
    let pool = PgPool::connect(address).await.unwrap();
    let sql = "INSERT INTO _sqlx_migrations (version, description, success, checksum, execution_time) \
               VALUES (9999, 'of the future', TRUE, '', 1)";
    sqlx::query(sql).execute(&pool).await.unwrap();
    let refusal = SqlStore::open(&engine.config).await.expect_err("it is newer").to_string();
    assert!(refusal.contains("was written by a newer stillage (schema 9999"), "{refusal}");
}

/// Tables, and their columns with types as PostgreSQL names them and whether they may be empty.
type Schema = BTreeMap<(String, String), (String, bool)>;

#[tokio::test]
async fn both_engines_have_the_same_tables_and_columns() {
    let Some(engine) = OnServer::empty().await else { return };
    let DatabaseAddress::Postgres(address) = &engine.config.database else { panic!("it is PostgreSQL") };
    let pool = PgPool::connect(address).await.unwrap();
    let of_server = sqlx::query(
        "SELECT table_name::text, column_name::text, data_type::text, is_nullable = 'YES' FROM information_schema.columns \
         WHERE table_schema = 'public' AND table_name <> '_sqlx_migrations'",
    );
    let of_server = of_server.fetch_all(&pool).await.unwrap();
    let of_server: Schema = of_server.iter().map(|row| ((row.get(0), row.get(1)), (row.get(2), row.get(3)))).collect();

    let embedded = Fixture::new().open().await;
    let of_file = sqlx::query(
        "SELECT tables.name, columns.name, columns.type, columns.\"notnull\" = 0 FROM pragma_table_list AS tables \
             JOIN pragma_table_info(tables.name) AS columns \
         WHERE tables.schema = 'main' AND tables.name NOT LIKE 'sqlite%' AND tables.name <> '_sqlx_migrations'",
    );
    let of_file = of_file.fetch_all(&embedded.engine().readers).await.unwrap();
    let as_server = |column: &str, name: &str| match (column, name) {
        ("cancel_requested" | "activates", _) => "boolean",
        (_, "INTEGER") => "bigint",
        (_, "REAL") => "double precision",
        _ => "text",
    };
    let of_file: Schema = of_file
        .iter()
        .map(|row| {
            let (table, column, name, is_nullable): (String, String, String, bool) =
                (row.get(0), row.get(1), row.get(2), row.get(3));
            let name = as_server(&column, &name).to_owned();
            ((table, column), (name, is_nullable))
        })
        .collect();
    assert!(!of_file.is_empty());
    assert_eq!(of_file, of_server);
}
