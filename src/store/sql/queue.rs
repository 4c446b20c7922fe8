//! The steps of the queue, each one short transaction on the row of a job.

use std::time::Duration;

use async_trait::async_trait;
use jiff::{SignedDuration, Timestamp};
use serde_json::json as object;

use super::analyses::insert_analysis;
use super::columns::SqlRow;
use super::database::Transaction;
use super::rows::json;
use super::statement::{of_free_rows, query};
use super::store::SqlStore;
use crate::fail_point;
use crate::records::{JobState, StageReport};
use crate::store::process_counts::count_rescued_job;
use crate::store::queue::{Claim, JobResult, Progress, Queue, Terms};
use crate::store::{ResultAddress, StoreError};

/// How often a job may be cut off in all, for each attempt that it has: poison that dies in one stage now and in another then
/// comes to its end, too.
const CUT_OFFS_PER_ATTEMPT: u32 = 4;

/// How long a job that was cut off waits behind those that were cut off less often, microseconds: ten minutes. A machine that
/// dies again and again does so sooner; a queue that never empties holds nobody up for longer.
const LONGEST_PRECEDENCE_US: i64 = 600 * 1_000_000;

#[async_trait]
impl Queue for SqlStore {
    async fn claim(&self, terms: &Terms, now: Timestamp) -> Result<Option<Claim>, StoreError> {
        let mut transaction = self.database.write().await?;
        end_expired_claims(&mut transaction, terms, now).await?;
        if terms.running_of_tenant < u64::MAX {
            // Those that run are counted below.
            transaction.alone_on("claims").await?;
        }
        let row = query(of_free_rows!(
            transaction,
            "UPDATE jobs SET state = 'running', attempt = attempt + 1, claim = claim + 1, lease_until = $2, \
                 started = coalesce(started, $1), updated = CASE WHEN updated < $1 THEN $1 ELSE updated + 1 END, \
                 message = '', progress = 0, stage = NULL, stages = '[]' \
             WHERE id = (SELECT id FROM jobs WHERE state = 'accepted' AND tenant <> '' AND run_at <= $1 \
                 AND (SELECT count(*) FROM jobs AS others WHERE others.tenant = jobs.tenant AND others.state = 'running') < $3 \
                 ORDER BY coalesce((SELECT turn FROM tenant_turns WHERE tenant_turns.tenant = jobs.tenant), 0), \
                     CASE WHEN updated > $4 THEN attempt ELSE 0 END, id \
                 LIMIT 1",
            ") RETURNING *, (SELECT source FROM maps WHERE maps.id = jobs.map) AS source"
        ))
        .bind(now.as_microsecond())
        .bind(after(now, terms.lease))
        .bind(i64::try_from(terms.running_of_tenant).unwrap_or(i64::MAX))
        .bind(now.as_microsecond() - LONGEST_PRECEDENCE_US)
        .fetch_optional(&mut transaction)
        .await?;
        if let Some(row) = &row {
            end_turn(&mut transaction, &row.text("tenant")?, now).await?;
        }
        transaction.commit().await?;
        if row.is_some() {
            fail_point::pass("after-claim");
        }
        row.as_ref().map(claim_of).transpose()
    }

    /// The process that made these claims held the lock on the data folder. This process holds it now, so that one is
    /// dead, and its leases need not be waited for. Of a database that processes share nobody knows that.
    async fn end_claims_of_dead_processes(&self, max_attempts: u32, now: Timestamp) -> Result<u64, StoreError> {
        if self.database.is_shared() {
            return Ok(0);
        }
        let mut transaction = self.database.write().await?;
        let rows = query("SELECT * FROM jobs WHERE state = 'running'").fetch_all(&mut transaction).await?;
        for row in &rows {
            end_claim(&mut transaction, row, attempts_after_death(row)?, max_attempts, Duration::ZERO, now).await?;
        }
        transaction.commit().await?;
        Ok(rows.len() as u64)
    }

    async fn heartbeat(
        &self,
        claim: &Claim,
        progress: &Progress,
        lease: Duration,
        now: Timestamp,
    ) -> Result<bool, StoreError> {
        let mut transaction = self.database.write().await?;
        let row = query(
            "UPDATE jobs SET lease_until = $3, progress = $4, stage = $5, stages = $6, \
                 updated = CASE WHEN updated < $7 THEN $7 ELSE updated + 1 END \
             WHERE id = $1 AND claim = $2 AND state = 'running' RETURNING cancel_requested",
        )
        .bind(claim.job.to_string())
        .bind(claim.token)
        .bind(after(now, lease))
        .bind(progress.percent)
        .bind(&progress.stage)
        .bind(json(&progress.stages))
        .bind(now.as_microsecond())
        .fetch_optional(&mut transaction)
        .await?;
        transaction.commit().await?;
        cancel_requested(row)
    }

    async fn is_cancel_requested(&self, claim: &Claim) -> Result<bool, StoreError> {
        let row = query("SELECT cancel_requested FROM jobs WHERE id = $1 AND claim = $2 AND state = 'running'")
            .bind(claim.job.to_string())
            .bind(claim.token)
            .fetch_optional(&self.database)
            .await?;
        cancel_requested(row)
    }

    async fn finish(
        &self,
        claim: &Claim,
        result: &JobResult,
        stages: &[StageReport],
        now: Timestamp,
    ) -> Result<(), StoreError> {
        let (outputs, blob) = match result {
            JobResult::Analysis(analysis, blob) => (object!({"analysis": analysis.id.to_string()}), Some(blob)),
            JobResult::Document(outputs) => (outputs.clone(), None),
        };
        let mut transaction = self.write_with(blob).await?;
        fail_point::pass("after-blob");
        transaction.alone_on_site_of(claim.map).await?;
        let ended = query(
            "UPDATE jobs SET state = 'successful', progress = 100, stage = NULL, stages = $3, outputs = $4, \
                 lease_until = NULL, finished = $5, updated = CASE WHEN updated < $5 THEN $5 ELSE updated + 1 END \
             WHERE id = $1 AND claim = $2 AND state = 'running' AND NOT cancel_requested",
        )
        .bind(claim.job.to_string())
        .bind(claim.token)
        .bind(json(&stages))
        .bind(json(&outputs))
        .bind(now.as_microsecond())
        .execute(&mut transaction)
        .await?;
        if ended != 1 {
            return Err(StoreError::ClaimLost);
        }
        if let JobResult::Analysis(analysis, blob) = result {
            insert_analysis(&mut transaction, claim, analysis, stages, blob, now).await?;
        }
        fail_point::pass("before-finish-commit");
        transaction.commit().await?;
        fail_point::pass("after-finish-commit");
        Ok(())
    }

    async fn end(&self, claim: &Claim, state: JobState, message: &str, now: Timestamp) -> Result<(), StoreError> {
        let mut transaction = self.database.write().await?;
        let ended = query(
            "UPDATE jobs SET state = $3, message = $4, stage = NULL, lease_until = NULL, finished = $5, \
                 updated = CASE WHEN updated < $5 THEN $5 ELSE updated + 1 END \
             WHERE id = $1 AND claim = $2 AND state = 'running'",
        )
        .bind(claim.job.to_string())
        .bind(claim.token)
        .bind(state.name())
        .bind(message)
        .bind(now.as_microsecond())
        .execute(&mut transaction)
        .await?;
        transaction.commit().await?;
        if ended == 1 { Ok(()) } else { Err(StoreError::ClaimLost) }
    }

    async fn requeue(
        &self,
        claim: &Claim,
        attempt: u32,
        wait: Duration,
        message: &str,
        now: Timestamp,
    ) -> Result<(), StoreError> {
        let mut transaction = self.database.write().await?;
        let requeued = query(
            "UPDATE jobs SET state = 'accepted', attempt = $3, run_at = $4, message = $5, progress = 0, stage = NULL, \
                 stages = '[]', lease_until = NULL, updated = CASE WHEN updated < $6 THEN $6 ELSE updated + 1 END \
             WHERE id = $1 AND claim = $2 AND state = 'running'",
        )
        .bind(claim.job.to_string())
        .bind(claim.token)
        .bind(attempt)
        .bind(not_before(now, wait))
        .bind(message)
        .bind(now.as_microsecond())
        .execute(&mut transaction)
        .await?;
        transaction.commit().await?;
        if requeued == 1 { Ok(()) } else { Err(StoreError::ClaimLost) }
    }
}

/// Puts a tenant behind the others, whose jobs come first from now on.
async fn end_turn(transaction: &mut Transaction, tenant: &str, now: Timestamp) -> Result<(), StoreError> {
    query(
        "INSERT INTO tenant_turns (tenant, turn) VALUES ($1, $2) ON CONFLICT (tenant) DO UPDATE SET turn = excluded.turn",
    )
    .bind(tenant)
    .bind(now.as_microsecond())
    .execute(&mut *transaction)
    .await?;
    Ok(())
}

/// Ends the claims whose lease has run out.
async fn end_expired_claims(transaction: &mut Transaction, terms: &Terms, now: Timestamp) -> Result<(), StoreError> {
    let rows = query(of_free_rows!(transaction, "SELECT * FROM jobs WHERE state = 'running' AND lease_until < $1", ""))
        .bind(now.as_microsecond())
        .fetch_all(&mut *transaction)
        .await?;
    for row in &rows {
        // Its worker was there at this time.
        let renewed = row.time("lease_until")?.saturating_sub(terms.lease).unwrap_or(Timestamp::MIN);
        let attempts = if terms.in_touch_since <= renewed { row.whole("attempt")? } else { attempts_after_death(row)? };
        let wait = (terms.backoff)(row.uuid("id")?, attempts);
        end_claim(transaction, row, attempts, terms.max_attempts, wait, now).await?;
    }
    Ok(())
}

/// The attempts of a job that count after its process died, and all others of the service with it, as far as is known: where the
/// machine died, the job is innocent. A job that kills its process dies in the same stage each time, so only such deaths in a
/// row count.
fn attempts_after_death(row: &SqlRow) -> Result<u32, StoreError> {
    let stage = stage(row)?;
    let is_same_stage = row.text_if("cut_off_in")?.is_none_or(|last| last == stage);
    if is_same_stage { row.whole("attempt") } else { Ok(1) }
}

/// The stage of a job; empty before the first.
fn stage(row: &SqlRow) -> Result<String, StoreError> {
    Ok(row.text_if("stage")?.unwrap_or_default())
}

/// Takes a running job from a worker that is gone: dismissed where that was asked for, failed after its last attempt,
/// queued again otherwise. `attempt` is the number of attempts that count.
async fn end_claim(
    transaction: &mut Transaction,
    row: &SqlRow,
    attempt: u32,
    max_attempts: u32,
    wait: Duration,
    now: Timestamp,
) -> Result<(), StoreError> {
    let cut_offs = row.whole::<u32>("cut_offs")? + 1;
    let (state, message) = if row.flag("cancel_requested")? {
        (JobState::Dismissed, "dismissed".to_owned())
    } else if attempt >= max_attempts {
        let message = format!("given up: the service died or stalled in each of {attempt} attempts");
        (JobState::Failed, message)
    } else if cut_offs >= max_attempts.saturating_mul(CUT_OFFS_PER_ATTEMPT) {
        (JobState::Failed, format!("given up: the service died or stalled {cut_offs} times meanwhile"))
    } else {
        (JobState::Accepted, format!("attempt {attempt} of {max_attempts} was cut off"))
    };
    tracing::warn!(job = row.text("id")?, attempt, state = state.name(), "took a job from a worker that is gone");
    count_rescued_job();
    query(
        "UPDATE jobs SET state = $2, message = $3, run_at = $4, lease_until = NULL, stage = NULL, \
             updated = CASE WHEN updated < $5 THEN $5 ELSE updated + 1 END, \
             finished = CASE WHEN $6 THEN $5 END, attempt = $7, cut_offs = $8, cut_off_in = $9 \
         WHERE id = $1",
    )
    .bind(row.text("id")?)
    .bind(state.name())
    .bind(message)
    .bind(not_before(now, wait))
    .bind(now.as_microsecond())
    .bind(state.is_final())
    .bind(attempt)
    .bind(cut_offs)
    .bind(stage(row)?)
    .execute(&mut *transaction)
    .await?;
    Ok(())
}

fn claim_of(row: &SqlRow) -> Result<Claim, StoreError> {
    Ok(Claim {
        job: row.uuid("id")?,
        tenant: row.tenant()?,
        map: row.uuid("map")?,
        token: row.whole("claim")?,
        attempt: row.whole("attempt")?,
        process: row.text("process")?,
        inputs: row.json("inputs")?,
        address: ResultAddress::from_digits(row.text("address")?),
        source: row.blob("source")?,
    })
}

fn cancel_requested(row: Option<SqlRow>) -> Result<bool, StoreError> {
    row.ok_or(StoreError::ClaimLost)?.flag("cancel_requested")
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
