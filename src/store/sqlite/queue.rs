//! The durable queue: every step of a job's life is one short transaction.
//!
//! ```text
//! accepted ──claim──> running ──finish──> successful
//!    ^  └─dismiss┐       │ ├────fail────> failed
//!    │           └───────┼─┴─dismiss────> dismissed
//!    └──requeue, retry───┘
//! ```
//!
//! - A claim raises the job's token. Whatever a worker says later carries that token and counts only while the job is
//!   still running under it; a worker that lost its claim (stalled beyond its lease, say) learns so from
//!   [`StoreError::ClaimLost`] and cannot harm. The token never goes down; the number of attempts does, when the
//!   service is stopped in an orderly way.
//! - A result and the end of its job are committed together, so there is exactly one of each.
//! - A claim not renewed in time is rescued by the next claim. An attempt counts from its beginning, so a job that
//!   kills its process is failed after the last attempt like any other.
//!
//! No step reads the clock: the caller passes the time. `updated` rises with every change, whatever the clock does, so
//! that it numbers the states of a job.

use std::time::Duration;

use jiff::{SignedDuration, Timestamp};
use sqlx::sqlite::SqliteRow;
use sqlx::{Row, SqliteConnection};
use stillage_core::AnalysisOptions;
use uuid::Uuid;

use super::analyses::insert_analysis;
use super::rows::{Columns, job_record, json};
use super::{AnalysisAddress, Blob, BlobId, NewAnalysis, Store, StoreError};
use crate::fail_point;
use crate::records::{JobFilter, JobRecord, JobState, StageReport};

/// A job to be queued.
#[derive(Debug)]
pub struct NewJob<'a> {
    /// Its id.
    pub id: Uuid,
    /// The map to analyse.
    pub map: Uuid,
    /// The options of the analysis.
    pub options: &'a AnalysisOptions,
    /// The address of the analysis.
    pub address: AnalysisAddress,
}

/// The right to work on a job, until the lease ends.
#[derive(Debug, Clone)]
pub struct Claim {
    /// The job.
    pub job: Uuid,
    /// Its map.
    pub map: Uuid,
    /// The fencing token.
    pub token: i64,
    /// From 1.
    pub attempt: u32,
    /// The options of the analysis.
    pub options: AnalysisOptions,
    /// The address of the analysis.
    pub address: AnalysisAddress,
    /// Blob of the upload.
    pub source: BlobId,
}

/// How long a job is held, how often it is tried and what it waits in between.
#[derive(Debug, Clone, Copy)]
pub struct Terms {
    /// How long a claim lasts without a heartbeat.
    pub lease: Duration,
    /// How often a job is tried in all.
    pub max_attempts: u32,
    /// The wait after the n-th attempt (from 1) of a job.
    pub backoff: fn(Uuid, u32) -> Duration,
}

/// Where a running job is.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Progress {
    /// 0 to 100.
    pub percent: u8,
    /// The stage it is in.
    pub stage: Option<String>,
    /// What the stages that ended cost.
    pub stages: Vec<StageReport>,
}

impl Store {
    /// Rescues jobs whose lease has ended, then takes the job that waits longest, if one is due.
    pub async fn claim(&self, terms: &Terms, now: Timestamp) -> Result<Option<Claim>, StoreError> {
        let mut transaction = self.write().await?;
        rescue(&mut transaction, terms, now).await?;
        let row = sqlx::query(
            "UPDATE jobs SET state = 'running', attempt = attempt + 1, claim = claim + 1, lease_until = $2, \
                 started = coalesce(started, $1), updated = max(updated + 1, $1), message = '', progress = 0, stage = NULL, stages = '[]' \
             WHERE id = (SELECT id FROM jobs WHERE state = 'accepted' AND run_at <= $1 ORDER BY id LIMIT 1) \
             RETURNING *, (SELECT source FROM maps WHERE maps.id = jobs.map) AS source",
        )
        .bind(now.as_microsecond())
        .bind(after(now, terms.lease))
        .fetch_optional(&mut *transaction)
        .await?;
        transaction.commit().await?;
        fail_point::pass("after-claim");
        row.as_ref().map(claim_of).transpose()
    }

    /// Puts the jobs of a process that died back into the queue at once, without waiting for their leases. Their
    /// attempts count. Answers how many there were.
    pub async fn requeue_orphans(&self, max_attempts: u32, now: Timestamp) -> Result<u64, StoreError> {
        let mut transaction = self.write().await?;
        let rows = sqlx::query("SELECT * FROM jobs WHERE state = 'running'").fetch_all(&mut *transaction).await?;
        for row in &rows {
            end_orphan(&mut transaction, row, max_attempts, Duration::ZERO, now).await?;
        }
        transaction.commit().await?;
        Ok(rows.len() as u64)
    }

    /// Renews the lease and tells where the job is. Answers whether somebody wants it cancelled.
    ///
    /// # Errors
    /// [`StoreError::ClaimLost`]: stop at once.
    pub async fn heartbeat(
        &self,
        claim: &Claim,
        progress: &Progress,
        lease: Duration,
        now: Timestamp,
    ) -> Result<bool, StoreError> {
        let mut transaction = self.write().await?;
        let row = sqlx::query(
            "UPDATE jobs SET lease_until = $3, progress = $4, stage = $5, stages = $6, updated = max(updated + 1, $7) \
             WHERE id = $1 AND claim = $2 AND state = 'running' RETURNING cancel_requested",
        )
        .bind(claim.job.to_string())
        .bind(claim.token)
        .bind(after(now, lease))
        .bind(progress.percent)
        .bind(&progress.stage)
        .bind(json(&progress.stages))
        .bind(now.as_microsecond())
        .fetch_optional(&mut *transaction)
        .await?;
        transaction.commit().await?;
        cancel_requested(row)
    }

    /// Asks what [`Self::heartbeat`] answers without writing anything.
    ///
    /// # Errors
    /// [`StoreError::ClaimLost`]: stop at once.
    pub async fn is_cancel_requested(&self, claim: &Claim) -> Result<bool, StoreError> {
        let row = sqlx::query("SELECT cancel_requested FROM jobs WHERE id = $1 AND claim = $2 AND state = 'running'")
            .bind(claim.job.to_string())
            .bind(claim.token)
            .fetch_optional(&self.readers)
            .await?;
        cancel_requested(row)
    }

    /// Stores the blob of a result, then commits the result, the map's pointer to it and the end of the job together.
    ///
    /// # Errors
    /// [`StoreError::ClaimLost`] when the job is not this claim's any more, or is to be cancelled: no row is written.
    pub async fn finish(
        &self,
        claim: &Claim,
        analysis: &NewAnalysis,
        blob: &Blob,
        now: Timestamp,
    ) -> Result<(), StoreError> {
        let _gate = self.blob_gate.read().await;
        self.blobs.put(blob).await?;
        fail_point::pass("after-blob");
        let mut transaction = self.write().await?;
        let ended = sqlx::query(
            "UPDATE jobs SET state = 'successful', progress = 100, stage = NULL, stages = $3, analysis = $4, \
                 lease_until = NULL, finished = $5, updated = max(updated + 1, $5) \
             WHERE id = $1 AND claim = $2 AND state = 'running' AND cancel_requested = 0",
        )
        .bind(claim.job.to_string())
        .bind(claim.token)
        .bind(json(&analysis.stages))
        .bind(analysis.id.to_string())
        .bind(now.as_microsecond())
        .execute(&mut *transaction)
        .await?;
        if ended.rows_affected() != 1 {
            return Err(StoreError::ClaimLost);
        }
        insert_analysis(&mut transaction, claim, analysis, blob.id(), now).await?;
        fail_point::pass("before-finish-commit");
        transaction.commit().await?;
        fail_point::pass("after-finish-commit");
        Ok(())
    }

    /// Ends the job as failed or dismissed.
    ///
    /// # Errors
    /// [`StoreError::ClaimLost`] when the job is not this claim's any more.
    pub async fn end(&self, claim: &Claim, state: JobState, message: &str, now: Timestamp) -> Result<(), StoreError> {
        let mut transaction = self.write().await?;
        let ended = sqlx::query(
            "UPDATE jobs SET state = $3, message = $4, stage = NULL, lease_until = NULL, finished = $5, updated = max(updated + 1, $5) \
             WHERE id = $1 AND claim = $2 AND state = 'running'",
        )
        .bind(claim.job.to_string())
        .bind(claim.token)
        .bind(state.name())
        .bind(message)
        .bind(now.as_microsecond())
        .execute(&mut *transaction)
        .await?;
        transaction.commit().await?;
        if ended.rows_affected() == 1 { Ok(()) } else { Err(StoreError::ClaimLost) }
    }

    /// Puts the job back into the queue, to run after a wait. `attempt` is the number of attempts that count so far.
    ///
    /// # Errors
    /// [`StoreError::ClaimLost`] when the job is not this claim's any more.
    pub async fn requeue(
        &self,
        claim: &Claim,
        attempt: u32,
        wait: Duration,
        message: &str,
        now: Timestamp,
    ) -> Result<(), StoreError> {
        let mut transaction = self.write().await?;
        let requeued = sqlx::query(
            "UPDATE jobs SET state = 'accepted', attempt = $3, run_at = $4, message = $5, progress = 0, stage = NULL, \
                 stages = '[]', lease_until = NULL, updated = max(updated + 1, $6) \
             WHERE id = $1 AND claim = $2 AND state = 'running'",
        )
        .bind(claim.job.to_string())
        .bind(claim.token)
        .bind(attempt)
        .bind(not_before(now, wait))
        .bind(message)
        .bind(now.as_microsecond())
        .execute(&mut *transaction)
        .await?;
        transaction.commit().await?;
        if requeued.rows_affected() == 1 { Ok(()) } else { Err(StoreError::ClaimLost) }
    }

    /// Dismisses a job: one that waits at once, one that runs is asked to stop. A finished one stays as it is.
    pub async fn dismiss(&self, id: Uuid, now: Timestamp) -> Result<Option<JobRecord>, StoreError> {
        let mut transaction = self.write().await?;
        sqlx::query(
            "UPDATE jobs SET state = 'dismissed', message = 'dismissed before it began', finished = $2, updated = max(updated + 1, $2) \
             WHERE id = $1 AND state = 'accepted'",
        )
        .bind(id.to_string())
        .bind(now.as_microsecond())
        .execute(&mut *transaction)
        .await?;
        sqlx::query(
            "UPDATE jobs SET cancel_requested = 1, updated = max(updated + 1, $2) WHERE id = $1 AND state = 'running'",
        )
        .bind(id.to_string())
        .bind(now.as_microsecond())
        .execute(&mut *transaction)
        .await?;
        let row = sqlx::query("SELECT * FROM jobs WHERE id = $1").bind(id.to_string());
        let row = row.fetch_optional(&mut *transaction).await?;
        transaction.commit().await?;
        row.as_ref().map(job_record).transpose()
    }

    /// A job.
    pub async fn job(&self, id: Uuid) -> Result<Option<JobRecord>, StoreError> {
        let row = sqlx::query("SELECT * FROM jobs WHERE id = $1").bind(id.to_string());
        row.fetch_optional(&self.readers).await?.as_ref().map(job_record).transpose()
    }

    /// Jobs, newest first.
    pub async fn jobs(&self, filter: &JobFilter) -> Result<Vec<JobRecord>, StoreError> {
        let rows = sqlx::query(
            "SELECT * FROM jobs WHERE ($1 IS NULL OR id < $1) AND ($2 IS NULL OR map = $2) \
                 AND ($3 = '[]' OR state IN (SELECT value FROM json_each($3))) \
             ORDER BY id DESC LIMIT $4",
        )
        .bind(filter.after.map(|id| id.to_string()))
        .bind(filter.map.map(|id| id.to_string()))
        .bind(json(&filter.states))
        .bind(filter.limit)
        .fetch_all(&self.readers)
        .await?;
        rows.iter().map(job_record).collect()
    }

    /// How many jobs are in a state, for every state that has some.
    pub async fn job_counts(&self) -> Result<Vec<(JobState, u64)>, StoreError> {
        let rows =
            sqlx::query("SELECT state, count(*) AS jobs FROM jobs GROUP BY state").fetch_all(&self.readers).await?;
        let count = |row: &SqliteRow| {
            let state = row.text("state")?;
            let found = JobState::find(&state).ok_or(StoreError::BadValue { column: "state", value: state })?;
            Ok((found, row.whole("jobs")?))
        };
        rows.iter().map(count).collect()
    }
}

/// Queues a job.
pub(super) async fn insert_job(
    connection: &mut SqliteConnection,
    job: &NewJob<'_>,
    now: Timestamp,
) -> Result<JobRecord, StoreError> {
    let row = sqlx::query(
        "INSERT INTO jobs (id, map, state, options, address, created, updated) \
         VALUES ($1, $2, 'accepted', $3, $4, $5, $5) RETURNING *",
    )
    .bind(job.id.to_string())
    .bind(job.map.to_string())
    .bind(json(job.options))
    .bind(job.address.as_str())
    .bind(now.as_microsecond())
    .fetch_one(connection)
    .await?;
    job_record(&row)
}

/// Whether as many jobs wait as may.
pub(super) async fn is_queue_full(connection: &mut SqliteConnection, max_queued: u64) -> Result<bool, StoreError> {
    let row =
        sqlx::query("SELECT count(*) AS waiting FROM jobs WHERE state = 'accepted'").fetch_one(connection).await?;
    Ok(row.whole::<u64>("waiting")? >= max_queued)
}

/// Ends the claims whose lease has run out.
async fn rescue(connection: &mut SqliteConnection, terms: &Terms, now: Timestamp) -> Result<(), StoreError> {
    let rows = sqlx::query("SELECT * FROM jobs WHERE state = 'running' AND lease_until < $1")
        .bind(now.as_microsecond())
        .fetch_all(&mut *connection)
        .await?;
    for row in &rows {
        let wait = (terms.backoff)(row.uuid("id")?, row.whole("attempt")?);
        end_orphan(connection, row, terms.max_attempts, wait, now).await?;
    }
    Ok(())
}

/// Takes a running job from a worker that is gone: cancelled if somebody wanted that, failed after its last attempt,
/// queued again otherwise.
async fn end_orphan(
    connection: &mut SqliteConnection,
    row: &SqliteRow,
    max_attempts: u32,
    wait: Duration,
    now: Timestamp,
) -> Result<(), StoreError> {
    let attempt: u32 = row.whole("attempt")?;
    let (state, message) = if row.try_get("cancel_requested")? {
        (JobState::Dismissed, "dismissed".to_owned())
    } else if attempt >= max_attempts {
        let message = format!("given up: the service died or stalled in each of {attempt} attempts");
        (JobState::Failed, message)
    } else {
        (JobState::Accepted, format!("attempt {attempt} of {max_attempts} was cut off"))
    };
    tracing::warn!(job = row.text("id")?, attempt, state = state.name(), "took a job from a worker that is gone");
    sqlx::query(
        "UPDATE jobs SET state = $2, message = $3, run_at = $4, lease_until = NULL, stage = NULL, updated = max(updated + 1, $5), \
             finished = CASE WHEN $6 THEN $5 END \
         WHERE id = $1",
    )
    .bind(row.text("id")?)
    .bind(state.name())
    .bind(message)
    .bind(not_before(now, wait))
    .bind(now.as_microsecond())
    .bind(state.is_final())
    .execute(connection)
    .await?;
    Ok(())
}

fn claim_of(row: &SqliteRow) -> Result<Claim, StoreError> {
    Ok(Claim {
        job: row.uuid("id")?,
        map: row.uuid("map")?,
        token: row.try_get("claim")?,
        attempt: row.whole("attempt")?,
        options: row.json("options")?,
        address: AnalysisAddress::from_column(row.text("address")?),
        source: row.blob("source")?,
    })
}

fn cancel_requested(row: Option<SqliteRow>) -> Result<bool, StoreError> {
    Ok(row.ok_or(StoreError::ClaimLost)?.try_get("cancel_requested")?)
}

/// The earliest time of the next attempt. Without a wait it is 0, so that a clock set back holds nothing up.
fn not_before(now: Timestamp, wait: Duration) -> i64 {
    if wait.is_zero() { 0 } else { after(now, wait) }
}

/// A time in the future, microseconds.
fn after(now: Timestamp, wait: Duration) -> i64 {
    let wait = SignedDuration::try_from(wait).unwrap_or(SignedDuration::MAX);
    now.saturating_add(wait).map_or(i64::MAX, Timestamp::as_microsecond)
}
