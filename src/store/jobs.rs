//! The client's side of a job: it is asked for, read, listed and dismissed.

use async_trait::async_trait;
use jiff::Timestamp;
use serde_json::Value;
use uuid::Uuid;

use super::{Capacity, Full, ResultAddress, StoreError};
use crate::records::{JobFilter, JobRecord, JobState, Tenant};

/// A job to be queued.
#[derive(Debug, Clone)]
pub struct NewJob {
    /// Its id, of version 7: the order of the ids is the order of the requests.
    pub id: Uuid,
    /// The map it works on.
    pub map: Uuid,
    /// Id of the process that computes it.
    pub process: &'static str,
    /// What the process is given beside the map, as a JSON object.
    pub inputs: Value,
    /// The address of its result.
    pub address: ResultAddress,
    /// Whether an analysis that it makes comes into force at once. The first one of a map does anyway.
    pub activates: bool,
}

/// What became of the wish to run a job once more.
#[derive(Debug, Clone, PartialEq)]
pub enum Retry {
    /// It waits again, as if it had never run.
    Queued(Box<JobRecord>),
    /// It waits, runs, or was successful.
    NotOver(Box<JobRecord>),
    /// Another job has made the same result, or is about to.
    Superseded,
    /// There is no room for it.
    Full(Full),
}

/// What is kept of jobs.
#[async_trait]
pub trait Jobs {
    /// A job.
    async fn job(&self, tenant: &Tenant, id: Uuid) -> Result<Option<JobRecord>, StoreError>;

    /// Jobs, newest first.
    async fn jobs(&self, tenant: &Tenant, filter: &JobFilter) -> Result<Vec<JobRecord>, StoreError>;

    /// Dismisses a job: one that waits at once, one that runs is asked to stop. A finished one stays as it is. `None`
    /// when there is no such job.
    async fn dismiss(&self, tenant: &Tenant, id: Uuid, now: Timestamp) -> Result<Option<JobRecord>, StoreError>;

    /// Puts a job that failed or was dismissed back into the queue. `None` when there is no such job.
    async fn retry(
        &self,
        tenant: &Tenant,
        id: Uuid,
        capacity: &Capacity,
        now: Timestamp,
    ) -> Result<Option<Retry>, StoreError>;

    /// How many jobs of all tenants are in a state, for every state that has some.
    async fn job_counts(&self) -> Result<Vec<(JobState, u64)>, StoreError>;

    /// When the oldest job of all tenants that waits was asked for.
    async fn oldest_waiting(&self) -> Result<Option<Timestamp>, StoreError>;
}
