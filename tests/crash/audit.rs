//! What was promised, compared with what is on disk after the server has gone.

use std::collections::BTreeMap;

use sqlx::postgres::PgConnection;
use sqlx::sqlite::{SqliteConnectOptions, SqliteConnection};
use sqlx::{Connection, Row};

use crate::deployment::Deployment;

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
    pub fn check(&self, deployment: &Deployment) {
        let jobs = block_on(whole(deployment));
        for (key, job) in &self.0 {
            let state = jobs.get(job).map(|(state, _)| state.as_str());
            assert_eq!(state, Some("successful"), "the job of {key} (nothing: it is lost)");
        }
        assert!(jobs.values().all(|(state, _)| state == "successful"), "{jobs:?}");
    }

    /// [`Self::check`], and nothing else is there: every upload was answered in the end.
    pub fn check_exactly(&self, deployment: &Deployment) {
        self.check(deployment);
        let jobs = block_on(whole(deployment));
        assert_eq!(jobs.len(), self.0.len(), "one job for each key");
    }
}

/// How many jobs were cut off and begun again.
pub fn interrupted(deployment: &Deployment) -> usize {
    block_on(whole(deployment)).values().filter(|(_, attempt)| *attempt > 1).count()
}

/// How many jobs have no outputs yet.
pub fn unfinished(deployment: &Deployment) -> u64 {
    let count = async {
        let mut database = Database::open(deployment).await;
        let rows = database.texts("SELECT CAST(count(*) AS TEXT) FROM jobs WHERE outputs IS NULL", 1).await;
        database.close().await;
        rows[0][0].parse().expect("a number")
    };
    block_on(count)
}

/// Changes the database behind the servers' backs.
pub fn change(deployment: &Deployment, statements: &[&'static str]) {
    block_on(async {
        let mut database = Database::open(deployment).await;
        for sql in statements {
            database.texts(sql, 0).await;
        }
        database.close().await;
    });
}

/// Jobs that were put back count no attempt, those that ended count one.
pub fn check_no_attempt_was_burnt(deployment: &Deployment) {
    for (job, (state, attempt)) in block_on(whole(deployment)) {
        let expected = i64::from(state == "successful");
        assert!(["accepted", "successful"].contains(&state.as_str()), "job {job} is {state}");
        assert_eq!(attempt, expected, "attempts of job {job}, which is {state}");
    }
}

/// Checks everything that must hold between the rows and the files: jobs with their states and attempts.
async fn whole(deployment: &Deployment) -> BTreeMap<String, (String, i64)> {
    let mut database = Database::open(deployment).await;
    if let Database::Sqlite(file) = &mut database {
        let integrity: String = sqlx::query_scalar("PRAGMA integrity_check").fetch_one(&mut *file).await.expect("runs");
        assert_eq!(integrity, "ok");
        let keys: i64 = sqlx::query_scalar(FOREIGN_KEYS).fetch_one(file).await.expect("runs");
        assert_eq!(keys, 0, "rows that name rows that are not there");
    }
    for (question, sql) in CONTRADICTIONS {
        assert_eq!(database.texts(sql, 1).await, [["0"]], "{question}");
    }
    for row in database.texts("SELECT source FROM maps UNION SELECT blob FROM analyses", 1).await {
        let bytes = deployment.blob(&row[0]).expect("every blob of a row is there");
        assert_eq!(blake3::hash(&bytes).to_hex().as_str(), row[0], "and is what was written");
    }
    let jobs = database.texts("SELECT id, state, CAST(attempt AS TEXT) FROM jobs", 3).await;
    database.close().await;
    let job = |row: Vec<String>| (row[0].clone(), (row[1].clone(), row[2].parse().expect("a number")));
    jobs.into_iter().map(job).collect()
}

/// The database, after the servers have gone.
enum Database {
    Sqlite(SqliteConnection),
    Postgres(PgConnection),
}

impl Database {
    async fn open(deployment: &Deployment) -> Self {
        if let Some(address) = deployment.database() {
            return Self::Postgres(PgConnection::connect(address).await.expect("it answers"));
        }
        let options = SqliteConnectOptions::new().filename(deployment.folder().join("stillage.sqlite3"));
        Self::Sqlite(SqliteConnection::connect_with(&options).await.expect("the database opens"))
    }

    /// The rows of a query whose columns are texts.
    async fn texts(&mut self, sql: &'static str, columns: usize) -> Vec<Vec<String>> {
        match self {
            Self::Sqlite(file) => {
                let rows = sqlx::query(sql).fetch_all(file).await.expect("it is SQL");
                rows.iter().map(|row| (0..columns).map(|column| row.get(column)).collect()).collect()
            }
            Self::Postgres(server) => {
                let rows = sqlx::query(sql).fetch_all(server).await.expect("it is SQL");
                rows.iter().map(|row| (0..columns).map(|column| row.get(column)).collect()).collect()
            }
        }
    }

    async fn close(self) {
        match self {
            Self::Sqlite(file) => file.close().await,
            Self::Postgres(server) => server.close().await,
        }
        .expect("it closes");
    }
}

/// PostgreSQL checks the keys itself, also after a crash.
const FOREIGN_KEYS: &str = "SELECT count(*) FROM pragma_foreign_key_check";

/// What must never be, each as a count of cases.
const CONTRADICTIONS: &[(&str, &str)] = &[
    ("maps without a job", "SELECT CAST(count(*) AS TEXT) FROM maps WHERE id NOT IN (SELECT map FROM jobs)"),
    ("jobs still running", "SELECT CAST(count(*) AS TEXT) FROM jobs WHERE state = 'running'"),
    (
        "successful jobs without exactly their one result",
        "SELECT CAST(count(*) AS TEXT) FROM jobs WHERE state = 'successful' AND \
             ((SELECT count(*) FROM analyses WHERE analyses.job = jobs.id) <> 1 OR NOT EXISTS \
             (SELECT 1 FROM analyses WHERE analyses.job = jobs.id AND jobs.outputs LIKE '%\"' || analyses.id || '\"%'))",
    ),
    (
        "results of jobs that did not end successful",
        "SELECT CAST(count(*) AS TEXT) FROM analyses WHERE job NOT IN (SELECT id FROM jobs WHERE state = 'successful')",
    ),
    (
        "analysed maps without an analysis in force",
        "SELECT CAST(count(*) AS TEXT) FROM maps WHERE analysis IS NULL AND id IN (SELECT map FROM analyses)",
    ),
    ("maps that were stored twice", "SELECT CAST(count(*) - count(DISTINCT name) AS TEXT) FROM maps"),
];

fn block_on<T>(future: impl Future<Output = T>) -> T {
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().expect("a runtime");
    runtime.block_on(future)
}
