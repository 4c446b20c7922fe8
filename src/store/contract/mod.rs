//! The store on a real SQLite in a temporary folder: who may do what, and what survives.

use std::time::Duration;

use jiff::{SignedDuration, Timestamp};
use stillage_core::AnalysisOptions;
use stillage_core::semantics::{Assignment, RuleSetDraft};
use tempfile::TempDir;
use uuid::Uuid;

use super::queue::{Claim, Progress, Terms};
use super::*;
use crate::records::{JobFilter, JobRecord, JobState, MapPatch};

/// An open store that lives in its own folder.
pub struct Fixture {
    pub config: Config,
    _folder: TempDir,
}

impl Fixture {
    pub fn new() -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let config = Config { min_free_bytes: 0, job_slots: 0, ..Config::new(folder.path().join("data")) };
        Self { config, _folder: folder }
    }

    pub async fn open(&self) -> Store {
        Store::open(&self.config).await.expect("the store opens")
    }
}

pub const TERMS: Terms =
    Terms { lease: Duration::from_secs(30), max_attempts: 3, backoff: |_, _| Duration::from_secs(5) };

/// Stores an upload with these bytes and answers its job.
pub async fn upload(store: &Store, content: &str) -> JobRecord {
    match try_upload(store, content, None, u64::MAX).await {
        Upload::New(job) => job,
        other => panic!("not a new upload: {other:?}"),
    }
}

async fn try_upload(store: &Store, content: &str, key: Option<&IdempotencyKey>, max_queued: u64) -> Upload {
    let source = crate::ingest::MapSource::Message(content.as_bytes().to_vec());
    let map = NewMapRow {
        id: Uuid::now_v7(),
        name: content.to_owned(),
        width: 4,
        height: 3,
        resolution: 0.05,
        georeference: None,
        warnings: Vec::new(),
        options: AnalysisOptions::default(),
    };
    store.create_map(&map, &Blob::encode(&source), key, max_queued, now()).await.expect("the upload is stored")
}

fn draft() -> RuleSetDraft {
    RuleSetDraft { labels: Vec::new(), cogency: None }
}

fn later(seconds: i64) -> Timestamp {
    now() + SignedDuration::from_secs(seconds)
}

async fn claim(store: &Store, at: Timestamp) -> Option<Claim> {
    store.claim(&TERMS, at).await.expect("the queue answers")
}

async fn finish(store: &Store, claim: &Claim) -> Result<(), StoreError> {
    let analysis = NewAnalysis { id: Uuid::now_v7(), stages: Vec::new(), diagnostics: Vec::new() };
    store.finish(claim, &analysis, &Blob::new(format!("result of {}", claim.job).into_bytes()), now()).await
}

async fn state(store: &Store, job: Uuid) -> (JobState, u32) {
    let record = store.job(job).await.expect("the store answers").expect("the job is there");
    (record.state, record.attempt)
}

async fn count(store: &Store, table: &'static str) -> i64 {
    let sql = match table {
        "analyses" => "SELECT count(*) FROM analyses",
        "jobs" => "SELECT count(*) FROM jobs",
        _ => "SELECT count(*) FROM maps",
    };
    sqlx::query_scalar(sql).fetch_one(&store.readers).await.expect("a count")
}

#[tokio::test]
async fn the_bundled_sqlite_is_free_of_the_wal_reset_bug() {
    // https://sqlite.org/wal.html#walresetbug: 3.7.0 to 3.51.2 may corrupt a database.
    let store = Fixture::new();
    let store = store.open().await;
    let version: String = sqlx::query_scalar("SELECT sqlite_version()").fetch_one(&store.readers).await.unwrap();
    let version: Vec<u32> = version.split('.').map(|part| part.parse().unwrap()).collect();
    assert!(version >= vec![3, 51, 3], "SQLite {version:?}");
}

#[tokio::test]
async fn every_connection_syncs_and_checks_keys() {
    let fixture = Fixture::new();
    let store = fixture.open().await;
    for pool in [&store.writer, &store.readers] {
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
    let refusal = Store::open(&fixture.config).await.expect_err("the folder is taken").to_string();
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
    .execute(&store.writer)
    .await
    .unwrap();
    store.close().await;
    drop(store);
    let refusal = Store::open(&fixture.config).await.expect_err("it is newer").to_string();
    assert!(refusal.contains("was written by a newer stillage (schema 9999, this program knows up to 1)"), "{refusal}");
}

#[tokio::test]
async fn a_damaged_blob_is_an_error_and_a_new_copy_mends_it() {
    let fixture = Fixture::new();
    let store = fixture.open().await;
    let blob = Blob::new("a map".as_bytes());
    store.blobs.put(&blob).await.unwrap();
    assert_eq!(store.blobs.get(blob.id()).await.unwrap().bytes(), "a map");

    let file = fixture.config.data.join("blobs").join(&blob.id().as_str()[..2]).join(blob.id().as_str());
    std::fs::write(&file, "a mop").unwrap();
    assert!(matches!(store.blobs.get(blob.id()).await, Err(StoreError::Damaged { .. })));
    store.blobs.put(&blob).await.unwrap();
    assert_eq!(store.blobs.get(blob.id()).await.unwrap().bytes(), "a map");

    std::fs::remove_file(&file).unwrap();
    assert!(matches!(store.blobs.get(blob.id()).await, Err(StoreError::Damaged { .. })));
}

#[tokio::test]
async fn blobs_without_a_row_are_swept_when_they_are_old() {
    let fixture = Fixture::new();
    let store = fixture.open().await;
    upload(&store, "kept").await;
    let orphan = Blob::new("nobody's".as_bytes());
    store.blobs.put(&orphan).await.unwrap();
    let staging = fixture.config.data.join("blobs").join("ab#1");
    std::fs::write(&staging, "half of").unwrap();

    assert_eq!(store.sweep_blobs(Duration::from_hours(24)).await.unwrap(), 0);
    assert!(!staging.exists(), "what is left of an interrupted write goes at once");
    store.blobs.get(orphan.id()).await.expect("young orphans stay: their row may be on its way");
    assert_eq!(store.sweep_blobs(Duration::ZERO).await.unwrap(), 1);
    assert!(store.blobs.get(orphan.id()).await.is_err());
}

#[tokio::test]
async fn deleting_a_map_takes_everything_but_what_others_share() {
    let fixture = Fixture::new();
    let store = fixture.open().await;
    let (first, second) = (upload(&store, "same").await, upload(&store, "same").await);
    let claimed = claim(&store, now()).await.unwrap();
    assert_eq!(claimed.job, first.id, "first come, first served");
    finish(&store, &claimed).await.unwrap();

    assert!(store.delete_map(first.map).await.unwrap());
    assert!(!store.delete_map(first.map).await.unwrap());
    assert_eq!((count(&store, "maps").await, count(&store, "analyses").await, count(&store, "jobs").await), (1, 0, 1));
    let source = store.map_source(second.map).await.unwrap().unwrap();
    store.blobs.get(&source).await.expect("the other map still has its upload");

    store.delete_map(second.map).await.unwrap();
    assert!(store.blobs.get(&source).await.is_err());
    assert_eq!(store.blobs.older_than(Duration::ZERO).await.unwrap(), []);
}

#[tokio::test]
async fn a_job_is_claimed_once_however_many_ask() {
    let fixture = Fixture::new();
    let store = std::sync::Arc::new(fixture.open().await);
    for index in 0..20 {
        upload(&store, &index.to_string()).await;
    }
    let mut claims = tokio::task::JoinSet::new();
    for _ in 0..40 {
        let store = std::sync::Arc::clone(&store);
        claims.spawn(async move { claim(&store, now()).await.map(|claim| claim.job) });
    }
    let claims = claims.join_all().await;
    let mut jobs: Vec<Uuid> = claims.into_iter().flatten().collect();
    jobs.sort_unstable();
    jobs.dedup();
    assert_eq!(jobs.len(), 20);
}

#[tokio::test]
async fn a_zombie_can_neither_finish_nor_harm() {
    let fixture = Fixture::new();
    let store = fixture.open().await;
    let job = upload(&store, "map").await;
    let zombie = claim(&store, now()).await.unwrap();
    // The lease runs out; the next claim puts the job back, and after its wait hands it to another worker.
    assert!(claim(&store, later(31)).await.is_none());
    let heir = claim(&store, later(37)).await.expect("it is due again");
    assert_eq!((heir.job, heir.attempt), (job.id, 2));

    assert!(matches!(finish(&store, &zombie).await, Err(StoreError::ClaimLost)));
    let beat = store.heartbeat(&zombie, &Progress::default(), TERMS.lease, now()).await;
    assert!(matches!(beat, Err(StoreError::ClaimLost)));
    assert!(matches!(store.is_cancel_requested(&zombie).await, Err(StoreError::ClaimLost)));
    assert!(matches!(store.end(&zombie, JobState::Failed, "", now()).await, Err(StoreError::ClaimLost)));
    assert!(matches!(store.requeue(&zombie, 0, Duration::ZERO, "", now()).await, Err(StoreError::ClaimLost)));
    assert_eq!((state(&store, job.id).await, count(&store, "analyses").await), ((JobState::Running, 2), 0));

    finish(&store, &heir).await.unwrap();
    assert!(matches!(finish(&store, &heir).await, Err(StoreError::ClaimLost)), "nor does the heir finish twice");
    assert_eq!((state(&store, job.id).await, count(&store, "analyses").await), ((JobState::Successful, 2), 1));
}

#[tokio::test]
async fn an_attempt_given_back_does_not_give_its_token_back() {
    let fixture = Fixture::new();
    let store = fixture.open().await;
    let job = upload(&store, "map").await;
    let stopped = claim(&store, now()).await.unwrap();
    store.requeue(&stopped, stopped.attempt - 1, Duration::ZERO, "stopped", now()).await.unwrap();
    assert_eq!(state(&store, job.id).await, (JobState::Accepted, 0));

    let next = claim(&store, now()).await.expect("due at once");
    assert_eq!(next.attempt, 1);
    assert!(matches!(finish(&store, &stopped).await, Err(StoreError::ClaimLost)));
    finish(&store, &next).await.unwrap();
}

#[tokio::test]
async fn a_heartbeat_keeps_the_lease_and_shows_the_progress() {
    let fixture = Fixture::new();
    let store = fixture.open().await;
    let job = upload(&store, "map").await;
    let held = claim(&store, now()).await.unwrap();
    let progress = Progress { percent: 40, stage: Some("features".into()), stages: Vec::new() };
    assert!(!store.heartbeat(&held, &progress, TERMS.lease, later(25)).await.unwrap());
    assert!(claim(&store, later(40)).await.is_none());
    assert_eq!(state(&store, job.id).await, (JobState::Running, 1), "not rescued");
    let record = store.job(job.id).await.unwrap().unwrap();
    assert_eq!((record.progress, record.stage.as_deref()), (40, Some("features")));
}

#[tokio::test]
async fn a_job_that_kills_its_process_fails_after_the_last_attempt() {
    let fixture = Fixture::new();
    let store = fixture.open().await;
    let job = upload(&store, "poison").await;
    for attempt in 1..=TERMS.max_attempts {
        assert_eq!(claim(&store, now()).await.expect("due at once").attempt, attempt);
        assert_eq!(store.requeue_orphans(TERMS.max_attempts, now()).await.unwrap(), 1);
    }
    assert!(claim(&store, later(3600)).await.is_none());
    let record = store.job(job.id).await.unwrap().unwrap();
    assert_eq!((record.state, record.attempt), (JobState::Failed, 3));
    assert_eq!(record.message, "given up: the service died or stalled in each of 3 attempts");
    assert!(record.finished.is_some());
}

#[tokio::test]
async fn a_clock_set_back_holds_no_job_up() {
    let fixture = Fixture::new();
    let store = fixture.open().await;
    upload(&store, "map").await;
    let yesterday = later(-24 * 3600);
    let held = claim(&store, yesterday).await.expect("due whatever the clock says");
    store.requeue_orphans(TERMS.max_attempts, yesterday).await.unwrap();
    let again = claim(&store, later(-48 * 3600)).await.expect("due whatever the clock says");
    assert!(matches!(finish(&store, &held).await, Err(StoreError::ClaimLost)));
    finish(&store, &again).await.unwrap();
}

#[tokio::test]
async fn a_waiting_job_is_dismissed_at_once_a_running_one_is_asked_to_stop() {
    let fixture = Fixture::new();
    let store = fixture.open().await;
    let (running, waiting) = (upload(&store, "first").await, upload(&store, "second").await);
    let held = claim(&store, now()).await.unwrap();
    assert_eq!(store.dismiss(waiting.id, now()).await.unwrap().unwrap().state, JobState::Dismissed);
    assert_eq!(store.dismiss(running.id, now()).await.unwrap().unwrap().state, JobState::Running);
    assert!(store.heartbeat(&held, &Progress::default(), TERMS.lease, now()).await.unwrap());
    assert!(matches!(finish(&store, &held).await, Err(StoreError::ClaimLost)), "cancelled means no result");
    store.end(&held, JobState::Dismissed, "dismissed", now()).await.unwrap();
    assert!(claim(&store, later(3600)).await.is_none());
    assert_eq!(count(&store, "analyses").await, 0);
    assert!(store.dismiss(Uuid::now_v7(), now()).await.unwrap().is_none());
}

#[tokio::test]
async fn a_full_queue_takes_no_more() {
    let fixture = Fixture::new();
    let store = fixture.open().await;
    upload(&store, "first").await;
    assert_eq!(try_upload(&store, "second", None, 1).await, Upload::QueueFull);
    assert_eq!(count(&store, "maps").await, 1);
    claim(&store, now()).await.unwrap();
    assert!(matches!(try_upload(&store, "second", None, 1).await, Upload::New(_)), "running jobs do not wait");
}

#[tokio::test]
async fn an_idempotency_key_stands_for_one_upload() {
    let fixture = Fixture::new();
    let store = fixture.open().await;
    let key = |content: &str| IdempotencyKey { key: "key".into(), content: content.into() };
    let Upload::New(job) = try_upload(&store, "map", Some(&key("a")), 1).await else { panic!("it is new") };
    assert_eq!(try_upload(&store, "map", Some(&key("a")), 1).await, Upload::Seen(job.clone()), "even when full");
    assert_eq!(store.seen_upload(&key("a"), now()).await.unwrap(), Some(Upload::Seen(job.clone())));
    assert_eq!(try_upload(&store, "map", Some(&key("b")), 9).await, Upload::KeyReused);
    assert_eq!(count(&store, "maps").await, 1);
    assert_eq!(store.seen_upload(&key("a"), later(25 * 3600)).await.unwrap(), None, "forgotten after a day");
    store.delete_map(job.map).await.unwrap();
    assert!(matches!(try_upload(&store, "map", Some(&key("b")), 9).await, Upload::New(_)), "gone with its job");
}

#[tokio::test]
async fn the_analysis_asked_for_last_answers() {
    let fixture = Fixture::new();
    let store = fixture.open().await;
    let map = upload(&store, "map").await.map;
    let with_seed = |seed| AnalysisOptions { seed, ..AnalysisOptions::default() };
    let ask = async |seed| store.request_analysis(map, &with_seed(seed), 9, now()).await.unwrap().unwrap();
    let in_force = async || store.snapshot(map).await.unwrap().unwrap().analysis.map(|(record, _)| record.options.seed);

    assert!(matches!(ask(1).await, Request::Pending(_)), "the first job will make it");
    let Request::New(_) = ask(2).await else { panic!("other options") };
    let (first, second) = (claim(&store, now()).await.unwrap(), claim(&store, now()).await.unwrap());
    assert_eq!(in_force().await, None);
    finish(&store, &second).await.unwrap();
    assert_eq!(in_force().await, Some(2));
    finish(&store, &first).await.unwrap();
    assert_eq!(in_force().await, Some(2), "the first request ended later but was asked for before");

    let version = store.map(map).await.unwrap().unwrap().version;
    let Request::Existing(existing) = ask(1).await else { panic!("it is there") };
    assert_eq!((existing.options.seed, in_force().await), (1, Some(1)));
    assert_eq!(store.map(map).await.unwrap().unwrap().version, version + 1);
    assert_eq!(store.analyses(map).await.unwrap().len(), 2);
}

#[tokio::test]
async fn decisions_are_bound_to_their_analysis_and_replace_what_they_saw() {
    let fixture = Fixture::new();
    let store = fixture.open().await;
    let map = upload(&store, "map").await.map;
    let first = claim(&store, now()).await.unwrap();
    finish(&store, &first).await.unwrap();
    let analysis = store.map(map).await.unwrap().unwrap().analysis.unwrap();
    let decide = async |analysis, replaces| {
        let row = NewSemanticsRow {
            map,
            analysis,
            replaces,
            rule_set: "warehouse".into(),
            draft: draft(),
            assignment: Assignment::default(),
        };
        let decided = store.insert_semantics(&row, now()).await.unwrap().expect("the map is there");
        decided.map(|record| record.version)
    };
    assert_eq!(decide(analysis, 0).await, Ok(1));
    assert_eq!(decide(analysis, 0).await, Err(1), "somebody decided in between");
    assert_eq!(decide(analysis, 1).await, Ok(2));

    let options = AnalysisOptions { seed: 7, ..AnalysisOptions::default() };
    store.request_analysis(map, &options, 9, now()).await.unwrap();
    let second = claim(&store, now()).await.unwrap();
    finish(&store, &second).await.unwrap();
    let snapshot = store.snapshot(map).await.unwrap().unwrap();
    assert_eq!(snapshot.semantics, None, "the decisions named categories of the other analysis");
    assert_eq!(decide(analysis, 2).await, Err(0), "that analysis is no longer in force");
    assert_eq!(decide(snapshot.analysis.unwrap().0.id, 0).await, Ok(3), "numbers are never used twice");
    let versions: Vec<u64> = store.semantics_versions(map).await.unwrap().iter().map(|record| record.version).collect();
    assert_eq!(versions, [3, 2, 1]);

    store.request_analysis(map, &AnalysisOptions::default(), 9, now()).await.unwrap();
    let snapshot = store.snapshot(map).await.unwrap().unwrap();
    assert_eq!(snapshot.semantics.map(|record| record.version), Some(2), "back with its own decision");
}

#[tokio::test]
async fn lists_are_newest_first_and_paged_by_the_last_seen() {
    let fixture = Fixture::new();
    let store = fixture.open().await;
    let mut jobs = Vec::new();
    for index in 0..5 {
        jobs.push(upload(&store, &index.to_string()).await);
    }
    jobs.reverse();
    let page = async |after| store.jobs(&JobFilter { limit: 2, after, ..JobFilter::default() }).await.unwrap();
    assert_eq!(page(None).await, jobs[..2]);
    assert_eq!(page(Some(jobs[1].id)).await, jobs[2..4]);
    assert_eq!(page(Some(jobs[3].id)).await, jobs[4..]);
    let maps = store.maps(2, Some(jobs[2].map)).await.unwrap();
    assert_eq!(maps.iter().map(|map| map.id).collect::<Vec<_>>(), [jobs[3].map, jobs[4].map]);

    claim(&store, now()).await.unwrap();
    let running = JobFilter { states: vec![JobState::Running], limit: 9, ..JobFilter::default() };
    assert_eq!(store.jobs(&running).await.unwrap().len(), 1);
    let of_map = JobFilter { map: Some(jobs[0].map), limit: 9, ..JobFilter::default() };
    assert_eq!(store.jobs(&of_map).await.unwrap(), jobs[..1]);
    let mut counts = store.job_counts().await.unwrap();
    counts.sort_by_key(|(state, _)| state.name());
    assert_eq!(counts, [(JobState::Accepted, 4), (JobState::Running, 1)]);
}

#[tokio::test]
async fn a_map_is_changed_only_from_the_version_that_was_read() {
    let fixture = Fixture::new();
    let store = fixture.open().await;
    let map = upload(&store, "hall").await.map;
    let rename = async |name: &str, if_match| {
        let patch = MapPatch { name: Some(name.into()), georeference: None };
        store.update_map(map, &patch, if_match, now()).await.unwrap().unwrap()
    };
    assert_eq!(rename("hall 1", Some(1)).await.unwrap().version, 2);
    assert_eq!(rename("hall 2", Some(1)).await.unwrap_err().name, "hall 1");
    assert_eq!(rename("hall 3", None).await.unwrap().name, "hall 3");
    assert!(store.update_map(Uuid::now_v7(), &MapPatch::default(), None, now()).await.unwrap().is_none());
}

#[tokio::test]
async fn a_full_database_keeps_what_was_acknowledged_and_recovers() {
    let fixture = Fixture::new();
    let store = fixture.open().await;
    let kept = upload(&store, "kept").await;
    // The same error as a full disk, SQLITE_FULL: no page may be added.
    let pages: i64 = sqlx::query_scalar("PRAGMA page_count").fetch_one(&store.writer).await.unwrap();
    set_max_pages(&store, pages).await;
    let long = "x".repeat(100_000);
    let refused = store.create_rule_set(&long, &draft()).await;
    assert!(matches!(refused, Err(StoreError::NoSpace)), "{refused:?}");
    assert_eq!(store.job(kept.id).await.unwrap().unwrap(), kept, "reads go on");
    set_max_pages(&store, 1_000_000).await;
    assert!(store.create_rule_set(&long, &draft()).await.unwrap().is_some(), "and so do writes");
}

async fn set_max_pages(store: &Store, pages: i64) {
    let sql = sqlx::AssertSqlSafe(format!("PRAGMA max_page_count = {pages}"));
    sqlx::query(sql).execute(&store.writer).await.unwrap();
}

#[tokio::test]
async fn a_database_that_another_process_holds_is_busy_not_broken() {
    let fixture = Fixture::new();
    let store = fixture.open().await;
    let other = SqlitePoolOptions::new().max_connections(1).connect_with(connect_options(&store.folder)).await.unwrap();
    let held = other.begin_with("BEGIN IMMEDIATE").await.unwrap();
    let begun = std::time::Instant::now();
    let refused = store.dismiss(Uuid::now_v7(), now()).await;
    assert!(matches!(refused, Err(StoreError::Busy)), "{refused:?}");
    assert!(begun.elapsed() >= Duration::from_secs(4), "it waited");
    store.check().await.expect("reads are not held up");
    held.rollback().await.unwrap();
    store.dismiss(Uuid::now_v7(), now()).await.expect("and afterwards all is well");
}

#[tokio::test]
async fn below_the_floor_there_is_no_space() {
    let fixture = Fixture::new();
    let store = fixture.open().await;
    store.check_space().unwrap();
    store.close().await;
    drop(store);
    let store = Store::open(&Config { min_free_bytes: u64::MAX, ..fixture.config.clone() }).await.unwrap();
    assert!(matches!(store.check().await, Err(StoreError::NoSpace)));
}

#[tokio::test]
async fn a_transaction_that_ended_behind_the_driver_does_not_block_the_writer() {
    // What SQLite does by itself on some errors of the disk: https://sqlite.org/lang_transaction.html, section 3.
    let fixture = Fixture::new();
    let store = fixture.open().await;
    let mut transaction = store.write().await.unwrap();
    sqlx::query("ROLLBACK").execute(&mut *transaction).await.unwrap();
    assert!(transaction.commit().await.is_err());
    upload(&store, "map").await;
}
