//! Rows of jobs as clients see them.

use std::time::Duration;

use async_trait::async_trait;
use jiff::Timestamp;
use uuid::Uuid;

use super::capacity::Addition;
use super::columns::SqlRow;
use super::database::Transaction;
use super::rows::{job_record, json};
use super::statement::query;
use super::store::SqlStore;
use crate::records::{JobFilter, JobRecord, JobState, Tenant};
use crate::store::{Capacity, Jobs, NewJob, Retry, StoreError, now};

#[async_trait]
impl Jobs for SqlStore {
    async fn dismiss(&self, tenant: &Tenant, id: Uuid, now: Timestamp) -> Result<Option<JobRecord>, StoreError> {
        let mut transaction = self.database.write().await?;
        query(
            "UPDATE jobs SET cancel_requested = (state = 'running'), \
                 state = CASE WHEN state = 'accepted' THEN 'dismissed' ELSE state END, \
                 message = CASE WHEN state = 'accepted' THEN 'dismissed before it began' ELSE message END, \
                 finished = CASE WHEN state = 'accepted' THEN $2 END, \
                 updated = CASE WHEN updated < $2 THEN $2 ELSE updated + 1 END \
             WHERE id = $1 AND tenant = $3 AND state IN ('accepted', 'running')",
        )
        .bind(id.to_string())
        .bind(now.as_microsecond())
        .bind(tenant.as_str())
        .execute(&mut transaction)
        .await?;
        let row = query("SELECT * FROM jobs WHERE id = $1 AND tenant = $2").bind(id.to_string()).bind(tenant.as_str());
        let row = row.fetch_optional(&mut transaction).await?;
        transaction.commit().await?;
        row.as_ref().map(job_record).transpose()
    }

    async fn job(&self, tenant: &Tenant, id: Uuid) -> Result<Option<JobRecord>, StoreError> {
        let row = query("SELECT * FROM jobs WHERE id = $1 AND tenant = $2").bind(id.to_string()).bind(tenant.as_str());
        row.fetch_optional(&self.database).await?.as_ref().map(job_record).transpose()
    }

    async fn jobs(&self, tenant: &Tenant, filter: &JobFilter) -> Result<Vec<JobRecord>, StoreError> {
        let rows = query(
            "SELECT * FROM jobs WHERE tenant = $5 AND ($1 IS NULL OR id < $1) AND ($2 IS NULL OR map = $2) \
                 AND ($3 = '' OR $3 LIKE '% ' || state || ' %') \
                 AND ($6 = '' OR $6 LIKE '% ' || process || ' %') \
                 AND ($7 IS NULL OR created >= $7) AND ($8 IS NULL OR created <= $8) \
                 AND ($9 IS NULL OR coalesce(finished, $11) - started >= $9) \
                 AND ($10 IS NULL OR coalesce(finished, $11) - started <= $10) \
             ORDER BY id DESC LIMIT $4",
        )
        .bind(filter.after.map(|id| id.to_string()))
        .bind(filter.map.map(|id| id.to_string()))
        .bind(words(filter.states.iter().map(|state| state.name())))
        .bind(filter.limit)
        .bind(tenant.as_str())
        .bind(words(filter.processes.iter().map(String::as_str)))
        .bind(filter.created_from.map(Timestamp::as_microsecond))
        .bind(filter.created_to.map(Timestamp::as_microsecond))
        .bind(filter.min_duration.map(microseconds))
        .bind(filter.max_duration.map(microseconds))
        .bind(now().as_microsecond())
        .fetch_all(&self.database)
        .await?;
        rows.iter().map(job_record).collect()
    }

    async fn retry(
        &self,
        tenant: &Tenant,
        id: Uuid,
        capacity: &Capacity,
        now: Timestamp,
    ) -> Result<Option<Retry>, StoreError> {
        let mut transaction = self.database.write().await?;
        transaction.alone_on_tenant(tenant, capacity).await?;
        let row = query(
            "SELECT *, EXISTS (SELECT 1 FROM analyses WHERE analyses.map = jobs.map AND analyses.address = jobs.address) \
                 OR EXISTS (SELECT 1 FROM jobs AS other WHERE other.map = jobs.map AND other.address = jobs.address \
                     AND other.id <> jobs.id AND other.state IN ('accepted', 'running')) AS superseded \
             FROM jobs WHERE id = $1 AND tenant = $2",
        )
        .bind(id.to_string())
        .bind(tenant.as_str())
        .fetch_optional(&mut transaction)
        .await?;
        let Some(row) = row else { return Ok(None) };
        if !matches!(row.state()?, JobState::Failed | JobState::Dismissed) {
            return Ok(Some(Retry::NotOver(Box::new(job_record(&row)?))));
        }
        if row.flag("superseded")? {
            return Ok(Some(Retry::Superseded));
        }
        if let Some(full) = transaction.full(tenant, capacity, Addition::default()).await? {
            return Ok(Some(Retry::Full(full)));
        }
        let row = query(
            "UPDATE jobs SET state = 'accepted', attempt = 0, cut_off_in = NULL, cut_offs = 0, cancel_requested = FALSE, \
                 run_at = 0, message = '', progress = 0, stage = NULL, stages = '[]', started = NULL, finished = NULL, \
                 updated = CASE WHEN updated < $2 THEN $2 ELSE updated + 1 END \
             WHERE id = $1 RETURNING *",
        )
        .bind(id.to_string())
        .bind(now.as_microsecond())
        .fetch_one(&mut transaction)
        .await?;
        transaction.commit().await?;
        Ok(Some(Retry::Queued(Box::new(job_record(&row)?))))
    }

    async fn job_counts(&self) -> Result<Vec<(JobState, u64)>, StoreError> {
        let rows = query("SELECT state, count(*) AS jobs FROM jobs WHERE tenant <> '' GROUP BY state")
            .fetch_all(&self.database)
            .await?;
        let count = |row: &SqlRow| Ok((row.state()?, row.whole("jobs")?));
        rows.iter().map(count).collect()
    }

    async fn oldest_waiting(&self) -> Result<Option<Timestamp>, StoreError> {
        let oldest =
            query("SELECT created FROM jobs WHERE state = 'accepted' AND tenant <> '' ORDER BY created LIMIT 1");
        oldest.fetch_optional(&self.database).await?.map(|row| row.time("created")).transpose()
    }
}

/// Words between spaces, among which a pattern finds a whole one; no text for none.
fn words<'a>(words: impl Iterator<Item = &'a str>) -> String {
    let all: String = words.map(|word| format!("{word} ")).collect();
    if all.is_empty() { all } else { format!(" {all}") }
}

/// Microseconds, as the columns of times count.
fn microseconds(duration: Duration) -> i64 {
    i64::try_from(duration.as_micros()).unwrap_or(i64::MAX)
}

/// Queues a job.
pub(super) async fn insert_job(
    transaction: &mut Transaction,
    tenant: &Tenant,
    job: &NewJob,
    now: Timestamp,
) -> Result<JobRecord, StoreError> {
    let row = query(
        "INSERT INTO jobs (id, tenant, map, process, inputs, state, address, activates, created, updated) \
         VALUES ($1, $2, $3, $4, $5, 'accepted', $6, $7, $8, $8) RETURNING *",
    )
    .bind(job.id.to_string())
    .bind(tenant.as_str())
    .bind(job.map.to_string())
    .bind(job.process)
    .bind(json(&job.inputs))
    .bind(job.address.as_str())
    .bind(job.activates)
    .bind(now.as_microsecond())
    .fetch_one(&mut *transaction)
    .await?;
    job_record(&row)
}
