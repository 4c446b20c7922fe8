//! The durable queue, the worker's side of a job: every step of a job's life is one short transaction.
//!
//! ```text
//! accepted ──claim──> running ──finish──> successful
//!    ^  └─dismiss┐       │ ├────fail────> failed
//!    │           └───────┼─┴─dismiss────> dismissed
//!    └──requeue, retry───┘
//! ```
//!
//! - A claim raises the job's token. Whatever a worker writes later carries that token and counts only while the job is
//!   still running under it; a worker that lost its claim (stalled beyond its lease, say) gets
//!   [`StoreError::ClaimLost`] and changes nothing. The token never goes down; the number of attempts does, when the
//!   service is stopped in an orderly way.
//! - A result and the end of its job are committed together, so there is exactly one of each.
//! - A claim not renewed in time is taken back by the next claim of any worker. An attempt counts from its beginning, so
//!   a job that kills its process is failed after the last attempt like any other.
//!
//! `updated` rises with every change, whatever the clock does, so that it numbers the states of a job.

use std::time::Duration;

use async_trait::async_trait;
use jiff::Timestamp;
use serde_json::Value;
use uuid::Uuid;

use super::{Blob, BlobId, NewAnalysis, ResultAddress, StoreError};
use crate::records::{JobState, StageReport, Tenant};

/// The right to work on a job, until the lease ends.
#[derive(Debug, Clone)]
pub struct Claim {
    /// The job.
    pub job: Uuid,
    /// Whose it is.
    pub tenant: Tenant,
    /// Its map.
    pub map: Uuid,
    /// The fencing token.
    pub token: i64,
    /// From 1.
    pub attempt: u32,
    /// Id of the process that computes it.
    pub process: String,
    /// What the process is given beside the map.
    pub inputs: Value,
    /// The address of the result.
    pub address: ResultAddress,
    /// Blob of the map's upload.
    pub source: BlobId,
}

/// How long a job is held, how often it is tried and what it waits in between.
#[derive(Debug, Clone, Copy)]
pub struct Terms {
    /// How long a claim lasts without a heartbeat.
    pub lease: Duration,
    /// How often a job is tried in all.
    pub max_attempts: u32,
    /// How many jobs of one tenant may run at the same time.
    pub running_of_tenant: u64,
    /// The wait after the n-th attempt (from 1) of a job.
    pub backoff: fn(Uuid, u32) -> Duration,
    /// Since when the worker that asks has been in touch with the database without a break, by the clock of the database.
    pub in_touch_since: Timestamp,
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

/// What a job made.
#[derive(Debug, Clone)]
pub enum JobResult {
    /// An analysis of its map. It comes into force where none is, or where its job activates it, unless another one was asked
    /// for later. The outputs of the job are
    /// `{"analysis": id}`.
    Analysis(Box<NewAnalysis>, Blob),
    /// A JSON object, which is the outputs of the job.
    Document(Value),
}

/// The queue.
#[async_trait]
pub trait Queue {
    /// Ends the claims whose lease has run out, then takes a job that is due, if there is one: of the tenant that was served
    /// longest ago, so that nobody waits for all the jobs of another; and of its jobs with the fewest attempts the one that waits
    /// longest, so that a job which kills its workers does not hold up the others. Attempts that ended ten minutes ago do not
    /// put a job behind others any more.
    ///
    /// Where the asking worker was in touch with the database ([`Terms::in_touch_since`]) from the last sign of life of a claim
    /// until its lease ran out, that worker alone was gone, and the attempt counts. Otherwise all may have been, with the machine
    /// or with the database: then it counts as [`Self::end_claims_of_dead_processes`] says.
    async fn claim(&self, terms: &Terms, now: Timestamp) -> Result<Option<Claim>, StoreError>;

    /// Ends the claims of processes that are known to be dead, without waiting for their leases. All that worked on the queue
    /// died with them, so their attempts count only where a job died in the same stage as the time before; in all it may die
    /// four times as often as it has attempts. An engine that other processes may use at the same time knows of none. Answers
    /// how many there were.
    async fn end_claims_of_dead_processes(&self, max_attempts: u32, now: Timestamp) -> Result<u64, StoreError>;

    /// Renews the lease and stores how far the job is. Answers whether it is to be cancelled.
    ///
    /// # Errors
    /// [`StoreError::ClaimLost`]: stop at once.
    async fn heartbeat(
        &self,
        claim: &Claim,
        progress: &Progress,
        lease: Duration,
        now: Timestamp,
    ) -> Result<bool, StoreError>;

    /// Asks what [`Self::heartbeat`] answers without writing anything.
    ///
    /// # Errors
    /// [`StoreError::ClaimLost`]: stop at once.
    async fn is_cancel_requested(&self, claim: &Claim) -> Result<bool, StoreError>;

    /// Stores the blob of a result, if it has one, then commits the result and the end of the job together.
    ///
    /// # Errors
    /// [`StoreError::ClaimLost`] when the job is not this claim's any more, or is to be cancelled: no row is written.
    async fn finish(
        &self,
        claim: &Claim,
        result: &JobResult,
        stages: &[StageReport],
        now: Timestamp,
    ) -> Result<(), StoreError>;

    /// Ends the job as failed or dismissed.
    ///
    /// # Errors
    /// [`StoreError::ClaimLost`] when the job is not this claim's any more.
    async fn end(&self, claim: &Claim, state: JobState, message: &str, now: Timestamp) -> Result<(), StoreError>;

    /// Puts the job back into the queue, to run after a wait. `attempt` is the number of attempts that count so far.
    ///
    /// # Errors
    /// [`StoreError::ClaimLost`] when the job is not this claim's any more.
    async fn requeue(
        &self,
        claim: &Claim,
        attempt: u32,
        wait: Duration,
        message: &str,
        now: Timestamp,
    ) -> Result<(), StoreError>;
}
