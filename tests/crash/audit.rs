//! What was promised, compared with what is on disk after the server has gone.

use std::collections::BTreeMap;
use std::path::Path;

use sqlx::sqlite::{SqliteConnectOptions, SqliteConnection};
use sqlx::{Connection, Row};

/// The jobs that were accepted, by the idempotency key of their upload.
#[derive(Debug, Default)]
pub struct Ledger(BTreeMap<String, String>);

impl Ledger {
    /// Notes an accepted job. A key keeps its job.
    pub fn accepted(&mut self, key: &str, location: &str) {
        let job = location.rsplit('/').next().expect("an id").to_owned();
        let earlier = self.0.insert(key.to_owned(), job.clone());
        assert!(earlier.is_none_or(|earlier| earlier == job), "key {key} made two jobs");
    }

    pub fn len(&self) -> u64 {
        self.0.len() as u64
    }

    /// Every accepted job ended successful, and the data folder is whole. Uploads whose answer was cut off may be there,
    /// but then whole, too.
    pub fn check(&self, data: &Path) {
        let jobs = block_on(whole_folder(data));
        for (key, job) in &self.0 {
            let state = jobs.get(job).map(|(state, _)| state.as_str());
            assert_eq!(state, Some("successful"), "the job of {key} (nothing: it is lost)");
        }
        assert!(jobs.values().all(|(state, _)| state == "successful"), "{jobs:?}");
    }

    /// [`Self::check`], and nothing else is there: every upload was answered in the end.
    pub fn check_exactly(&self, data: &Path) {
        self.check(data);
        let jobs = block_on(whole_folder(data));
        assert_eq!(jobs.len(), self.0.len(), "one job for each key");
    }
}

/// How many jobs were cut off and begun again.
pub fn interrupted(data: &Path) -> usize {
    block_on(whole_folder(data)).values().filter(|(_, attempt)| *attempt > 1).count()
}

/// Jobs that were put back count no attempt, those that ended count one.
pub fn check_no_attempt_was_burnt(data: &Path) {
    for (job, (state, attempt)) in block_on(whole_folder(data)) {
        let expected = i64::from(state == "successful");
        assert!(["accepted", "successful"].contains(&state.as_str()), "job {job} is {state}");
        assert_eq!(attempt, expected, "attempts of job {job}, which is {state}");
    }
}

/// Checks everything that must hold between the rows and the files: jobs with their states and attempts.
async fn whole_folder(data: &Path) -> BTreeMap<String, (String, i64)> {
    let options = SqliteConnectOptions::new().filename(data.join("stillage.sqlite3"));
    let mut database = SqliteConnection::connect_with(&options).await.expect("the database opens");
    let integrity: String = sqlx::query_scalar("PRAGMA integrity_check").fetch_one(&mut database).await.expect("runs");
    assert_eq!(integrity, "ok");
    for (question, sql) in CONTRADICTIONS {
        let found: i64 = sqlx::query_scalar(*sql).fetch_one(&mut database).await.expect("the question is SQL");
        assert_eq!(found, 0, "{question}");
    }
    let blobs = sqlx::query("SELECT source AS blob FROM maps UNION SELECT blob FROM analyses");
    for row in blobs.fetch_all(&mut database).await.expect("a list of blobs") {
        let blob: String = row.get("blob");
        let bytes =
            std::fs::read(data.join("blobs").join(&blob[..2]).join(&blob)).expect("every blob of a row is there");
        assert_eq!(blake3::hash(&bytes).to_hex().as_str(), blob, "and is what was written");
    }
    let jobs =
        sqlx::query("SELECT id, state, attempt FROM jobs").fetch_all(&mut database).await.expect("a list of jobs");
    database.close().await.expect("it closes");
    jobs.iter().map(|row| (row.get("id"), (row.get("state"), row.get("attempt")))).collect()
}

/// What must never be, each as a count of cases.
const CONTRADICTIONS: &[(&str, &str)] = &[
    ("rows that name rows that are not there", "SELECT count(*) FROM pragma_foreign_key_check"),
    ("maps without a job", "SELECT count(*) FROM maps WHERE id NOT IN (SELECT map FROM jobs)"),
    ("jobs still running", "SELECT count(*) FROM jobs WHERE state = 'running'"),
    (
        "successful jobs without exactly their one result",
        "SELECT count(*) FROM jobs WHERE state = 'successful' AND \
             (SELECT count(*) FROM analyses WHERE analyses.job = jobs.id AND analyses.id = jobs.outputs ->> '$.analysis') <> 1",
    ),
    (
        "results of jobs that did not end successful",
        "SELECT count(*) FROM analyses WHERE job NOT IN (SELECT id FROM jobs WHERE state = 'successful')",
    ),
    (
        "analysed maps without an analysis in force",
        "SELECT count(*) FROM maps WHERE analysis IS NULL AND id IN (SELECT map FROM analyses)",
    ),
    ("maps that were stored twice", "SELECT count(*) - count(DISTINCT name) FROM maps"),
];

fn block_on<T>(future: impl Future<Output = T>) -> T {
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().expect("a runtime");
    runtime.block_on(future)
}
