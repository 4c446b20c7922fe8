//! What only the embedded engine has: one process, one folder, SQLite's own faults.

use std::path::PathBuf;
use std::sync::Arc;

use jiff::SignedDuration;
use tempfile::TempDir;
use uuid::Uuid;

use super::*;
use crate::config::Config;
use crate::records::{JobFilter, JobRecord, JobState};
use crate::store::contract::{Engine, TERMS, draft, local, upload};
use crate::store::queue::Progress;
use crate::store::sql::{Database, SqlStore};
use crate::store::{BlobId, Jobs, Queue, RuleSets, Store, now};

/// An open store that lives in its own folder.
pub struct Fixture {
    pub config: Config,
    folder: TempDir,
}

impl Fixture {
    pub fn new() -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let config = Config { min_free_bytes: 0, job_slots: 0, ..Config::new(folder.path().join("data")) };
        Self { config, folder }
    }

    pub async fn open(&self) -> Arc<SqlStore> {
        Arc::new(SqlStore::open(&self.config).await.expect("the store opens"))
    }

    /// The file of a blob.
    pub fn blob_file(&self, blob: &BlobId) -> PathBuf {
        self.folder.path().join("data/blobs").join(&blob.as_str()[..2]).join(blob.as_str())
    }
}

/// The engine under the contract.
pub struct Embedded {
    store: Arc<dyn Store>,
    sql: Arc<SqlStore>,
    fixture: Fixture,
}

impl Engine for Embedded {
    async fn empty() -> Option<Self> {
        let fixture = Fixture::new();
        let sql = fixture.open().await;
        Some(Self { store: Arc::<SqlStore>::clone(&sql), sql, fixture })
    }

    fn store(&self) -> &Arc<dyn Store> {
        &self.store
    }

    fn sql(&self) -> &SqlStore {
        &self.sql
    }

    fn blob_file(&self, blob: &BlobId) -> PathBuf {
        self.fixture.blob_file(blob)
    }
}

impl SqlStore {
    /// The engine of a store in a folder.
    pub fn engine(&self) -> &Sqlite {
        match &self.database {
            Database::Sqlite(engine) => engine,
            #[cfg(feature = "postgres")]
            Database::Postgres(_) => panic!("not in a folder"),
        }
    }
}

/// Claims the next job, tells its stage, and lets the process die.
async fn die(fixture: &Fixture, stage: Option<&str>) -> Option<Uuid> {
    let store = fixture.open().await;
    store.end_claims_of_dead_processes(TERMS.max_attempts, now()).await.unwrap();
    let claim = store.claim(&TERMS, now()).await.unwrap()?;
    let progress = Progress { percent: 1, stage: stage.map(str::to_owned), stages: Vec::new() };
    store.heartbeat(&claim, &progress, TERMS.lease, now()).await.unwrap();
    Some(claim.job)
}

async fn jobs_in(fixture: &Fixture, state: JobState) -> usize {
    let store = fixture.open().await;
    store.end_claims_of_dead_processes(TERMS.max_attempts, now()).await.unwrap();
    store.jobs(&local(), &JobFilter { states: vec![state], limit: 100, ..JobFilter::default() }).await.unwrap().len()
}

#[tokio::test]
async fn jobs_that_die_with_the_machine_are_innocent() {
    let fixture = Fixture::new();
    let store = fixture.open().await;
    for index in 0..20 {
        upload_to(&store, &index.to_string()).await;
    }
    drop(store);
    for _ in 0..40 {
        assert!(die(&fixture, Some("features")).await.is_some());
    }
    assert_eq!(jobs_in(&fixture, JobState::Accepted).await, 20, "each death hits another job");
    let alone = Fixture::new();
    upload_to(&alone.open().await, "alone").await;
    for stage in ["features", "clustering", "features", "rooms", "decomposition", "features"] {
        assert!(die(&alone, Some(stage)).await.is_some());
    }
    assert_eq!(jobs_in(&alone, JobState::Accepted).await, 1, "it got to another stage each time");
}

#[tokio::test]
async fn poison_is_given_up_and_lets_the_others_through_before() {
    let fixture = Fixture::new();
    let poison = upload_to(&fixture.open().await, "poison").await;
    let other = upload_to(&fixture.open().await, "other").await;
    assert_eq!(die(&fixture, None).await, Some(poison.id));
    assert_eq!(die(&fixture, Some("rooms")).await, Some(other.id), "who was cut off waits behind");
    assert_eq!(die(&fixture, None).await, Some(poison.id));
    assert_eq!(die(&fixture, Some("features")).await, Some(other.id));
    assert_eq!(die(&fixture, Some("clustering")).await, Some(other.id), "it died elsewhere and is suspected less");
    assert_eq!(die(&fixture, Some("rooms")).await, Some(other.id));
    assert_eq!(jobs_in(&fixture, JobState::Failed).await, 0);
    let store = fixture.open().await;
    let claim = store.claim(&TERMS, now()).await.unwrap().expect("waits");
    store.end(&claim, JobState::Dismissed, "", now()).await.unwrap();
    drop(store);
    assert_eq!(die(&fixture, None).await, Some(poison.id));
    assert_eq!(jobs_in(&fixture, JobState::Failed).await, 1, "the third time in the same place");
    // Poison that is nowhere twice in a row.
    upload_to(&fixture.open().await, "clever").await;
    let mut deaths = 0;
    while die(&fixture, Some(if deaths % 2 == 0 { "rooms" } else { "features" })).await.is_some() {
        deaths += 1;
    }
    assert_eq!(deaths, 12);
}

async fn upload_to(store: &Arc<SqlStore>, content: &str) -> JobRecord {
    let store: Arc<dyn Store> = Arc::<SqlStore>::clone(store);
    upload(&store, content).await
}

#[tokio::test]
async fn the_bundled_sqlite_is_free_of_the_wal_reset_bug() {
    // https://sqlite.org/wal.html#walresetbug: 3.7.0 to 3.51.2 may corrupt a database.
    let store = Fixture::new();
    let store = store.open().await;
    let version: String =
        sqlx::query_scalar("SELECT sqlite_version()").fetch_one(&store.engine().readers).await.unwrap();
    let version: Vec<u32> = version.split('.').map(|part| part.parse().unwrap()).collect();
    assert!(version >= vec![3, 51, 3], "SQLite {version:?}");
}

#[tokio::test]
async fn every_connection_syncs_and_checks_keys() {
    let fixture = Fixture::new();
    let store = fixture.open().await;
    for pool in [&store.engine().writer, &store.engine().readers] {
        let journal: String = sqlx::query_scalar("PRAGMA journal_mode").fetch_one(pool).await.unwrap();
        let synchronous: i64 = sqlx::query_scalar("PRAGMA synchronous").fetch_one(pool).await.unwrap();
        let foreign_keys: i64 = sqlx::query_scalar("PRAGMA foreign_keys").fetch_one(pool).await.unwrap();
        assert_eq!((journal.as_str(), synchronous, foreign_keys), ("wal", 2, 1));
    }
}

#[tokio::test]
async fn a_data_folder_has_one_owner() {
    let fixture = Fixture::new();
    let store = fixture.open().await;
    let refusal = SqlStore::open(&fixture.config).await.expect_err("the folder is taken").to_string();
    assert!(refusal.contains("is in use by another process (pid "), "{refusal}");
    store.close().await;
    drop(store);
    fixture.open().await;
}

#[tokio::test]
async fn a_newer_database_is_refused() {
    let fixture = Fixture::new();
    let store = fixture.open().await;
    sqlx::query(
        "INSERT INTO _sqlx_migrations (version, description, success, checksum, execution_time) \
         VALUES (9999, 'of the future', 1, x'00', 1)",
    )
    .execute(&store.engine().writer)
    .await
    .unwrap();
    store.close().await;
    drop(store);
    let refusal = SqlStore::open(&fixture.config).await.expect_err("it is newer").to_string();
    assert!(
        refusal.contains("was written by a newer stillage (schema 9999, this program knows up to 11)"),
        "{refusal}"
    );
}

#[tokio::test]
async fn a_full_database_keeps_what_was_acknowledged_and_recovers() {
    let fixture = Fixture::new();
    let store = fixture.open().await;
    let kept = upload_to(&store, "kept").await;
    // The same error as a full disk, SQLITE_FULL: no page may be added.
    let pages: i64 = sqlx::query_scalar("PRAGMA page_count").fetch_one(&store.engine().writer).await.unwrap();
    set_max_pages(&store, pages).await;
    let long = "x".repeat(100_000);
    let refused = store.create_rule_set(&local(), &long, &draft()).await;
    assert!(matches!(refused, Err(StoreError::NoSpace)), "{refused:?}");
    assert_eq!(store.job(&local(), kept.id).await.unwrap().unwrap(), kept, "reads go on");
    set_max_pages(&store, 1_000_000).await;
    assert!(store.create_rule_set(&local(), &long, &draft()).await.unwrap().is_some(), "and so do writes");
}

#[tokio::test]
async fn a_database_that_another_process_holds_is_busy_not_broken() {
    let fixture = Fixture::new();
    let store = fixture.open().await;
    let other = SqlitePoolOptions::new()
        .max_connections(1)
        .connect_with(connect_options(&store.engine().folder))
        .await
        .unwrap();
    let held = other.begin_with("BEGIN IMMEDIATE").await.unwrap();
    let begun = std::time::Instant::now();
    let refused = store.dismiss(&local(), Uuid::now_v7(), now()).await;
    assert!(matches!(refused, Err(StoreError::Busy)), "{refused:?}");
    assert!(begun.elapsed() >= Duration::from_secs(4), "it waited");
    store.check().await.expect("reads are not held up");
    held.rollback().await.unwrap();
    store.dismiss(&local(), Uuid::now_v7(), now()).await.expect("and afterwards all is well");
}

#[tokio::test]
async fn below_the_floor_there_is_no_space() {
    let fixture = Fixture::new();
    let store = fixture.open().await;
    store.check_space().unwrap();
    store.close().await;
    drop(store);
    let store = SqlStore::open(&Config { min_free_bytes: u64::MAX, ..fixture.config.clone() }).await.unwrap();
    assert!(matches!(store.check().await, Err(StoreError::NoSpace)));
}

#[tokio::test]
async fn a_transaction_that_ended_behind_the_driver_does_not_block_the_writer() {
    // What SQLite does by itself on some errors of the disk: https://sqlite.org/lang_transaction.html, section 3.
    let fixture = Fixture::new();
    let store = fixture.open().await;
    let mut transaction = store.engine().write().await.unwrap();
    sqlx::query("ROLLBACK").execute(&mut *transaction).await.unwrap();
    assert!(transaction.commit().await.is_err());
    upload_to(&store, "map").await;
}

#[tokio::test]
async fn a_write_is_counted_and_while_it_lasts_nothing_read_is_known_to_stay() {
    let fixture = Fixture::new();
    let store = fixture.open().await;
    // The connection comes back by itself, also the one that migrated.
    let idle = async || {
        while store.writes().is_none() {
            tokio::time::sleep(Duration::from_millis(1)).await;
        }
        store.writes()
    };
    let before = idle().await.expect("nobody writes");
    let transaction = store.engine().write().await.unwrap();
    assert_eq!(store.writes(), None);
    drop(transaction);
    assert_eq!(idle().await, Some(before + 1));
}

#[tokio::test]
async fn what_an_interrupted_write_left_goes_at_the_next_start() {
    let fixture = Fixture::new();
    let store = fixture.open().await;
    let staging = fixture.folder.path().join("data/blobs/ab#1");
    std::fs::write(&staging, "half of").unwrap();
    assert_eq!(store.sweep_blobs(Duration::from_hours(24)).await.unwrap(), 0);
    assert!(!staging.exists());
}

#[tokio::test]
async fn the_process_with_the_lock_ends_the_claims_of_the_one_before() {
    let fixture = Fixture::new();
    let store = fixture.open().await;
    let job = upload_to(&store, "map").await;
    let held = store.claim(&TERMS, now()).await.unwrap().expect("due at once");
    assert_eq!(store.end_claims_of_dead_processes(TERMS.max_attempts, now()).await.unwrap(), 1);
    let again = store.claim(&TERMS, now()).await.unwrap().expect("due at once, without waiting for the lease");
    assert_eq!((again.job, again.attempt), (job.id, 2));
    assert!(matches!(store.end(&held, JobState::Failed, "", now()).await, Err(StoreError::ClaimLost)));
}

#[tokio::test]
async fn a_clock_set_back_holds_no_job_up() {
    let fixture = Fixture::new();
    let store = fixture.open().await;
    upload_to(&store, "map").await;
    let day = SignedDuration::from_hours(24);
    let yesterday = now() - day;
    store.claim(&TERMS, yesterday).await.unwrap().expect("due whatever the clock says");
    store.end_claims_of_dead_processes(TERMS.max_attempts, yesterday).await.unwrap();
    store.claim(&TERMS, yesterday - day).await.unwrap().expect("due whatever the clock says");
}

async fn set_max_pages(store: &SqlStore, pages: i64) {
    let sql = sqlx::AssertSqlSafe(format!("PRAGMA max_page_count = {pages}"));
    sqlx::query(sql).execute(&store.engine().writer).await.unwrap();
}
