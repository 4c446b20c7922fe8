//! What is kept: rows in a database, big things as blobs. These files are the contract; an engine fulfils it.
//!
//! | file | what it promises |
//! | --- | --- |
//! | `maps` | uploads with their first job, the record of a map, deletion |
//! | `analyses` | finished results, the one in force for each map |
//! | `queue` | the worker's side of a job: claim, heartbeat, result |
//! | `jobs` | the client's side of a job: read, list, dismiss |
//! | `semantics` | human decisions |
//! | `rule_sets` | rule sets that people wrote |
//! | `blobs` | bytes by their hash, and the formats of stored values |
//! | `sqlite` | the engine: all SQL |
//! | `contract` | the tests that every engine must pass |
//!
//! What every engine keeps, whatever dies and when:
//! - What was answered is on stable storage.
//! - A row never names a blob that is not there. A blob is written before its row is committed, and removed when no row
//!   names it any more. A blob whose row never came is swept later.
//! - The queue hands a job to one worker at a time, and only the newest claim can finish it (see [`queue`]).
//! - Whatever is asked under a [`Tenant`](crate::records::Tenant) reads and writes rows of that tenant only: the id of
//!   another tenant's row is an id without a row.
//! - No call reads the clock: the caller passes the time.

mod analyses;
mod blobs;
#[cfg(test)]
pub(crate) mod contract;
mod error;
mod jobs;
mod maps;
pub mod queue;
mod rule_sets;
mod semantics;
mod sqlite;

use std::fmt;
use std::sync::Arc;
use std::time::Duration;

use async_trait::async_trait;
use jiff::Timestamp;

use crate::config::Config;

pub use analyses::{Analyses, MapState, NewAnalysis, Outdated, Request, ResultAddress, Snapshot};
pub use blobs::{Blob, BlobId, Blobs, LocalBlobs, Stored};
pub use error::StoreError;
pub use jobs::{Jobs, NewJob};
pub use maps::{IdempotencyKey, Maps, NewMapRow, Upload};
pub use queue::Queue;
pub use rule_sets::RuleSets;
pub use semantics::{NewSemanticsRow, SemanticsVersions};
pub use sqlite::Sqlite;

/// An open store.
#[async_trait]
pub trait Store:
    Maps + Analyses + Queue + Jobs + SemanticsVersions + RuleSets + fmt::Debug + Send + Sync + 'static
{
    /// The blobs.
    fn blobs(&self) -> &dyn Blobs;

    /// Whether there is room for uploads and results.
    ///
    /// # Errors
    /// [`StoreError::NoSpace`] below the configured floor.
    fn check_space(&self) -> Result<(), StoreError>;

    /// Whether the database answers and there is room.
    ///
    /// # Errors
    /// What is wrong.
    async fn check(&self) -> Result<(), StoreError>;

    /// The schema version of the database.
    async fn schema_version(&self) -> Result<i64, StoreError>;

    /// Removes blobs without a row that are older than `age`, and what is left of interrupted writes. Answers how many
    /// blobs were removed.
    ///
    /// # Errors
    /// When the database or the blobs do not answer.
    async fn sweep_blobs(&self, age: Duration) -> Result<usize, StoreError>;

    /// Closes the connections; pending writes end first.
    async fn close(&self);
}

/// Opens the configured store and brings its database up to date.
///
/// # Errors
/// [`StoreError::FolderInUse`] when another process has the data folder, [`StoreError::NewerDatabase`] when a newer
/// program wrote it, and whatever the disk answers.
pub async fn open(config: &Config) -> Result<Arc<dyn Store>, StoreError> {
    Ok(Arc::new(Sqlite::open(config).await?))
}

/// The time, to the microsecond that databases keep.
#[must_use]
pub fn now() -> Timestamp {
    let now = Timestamp::now();
    Timestamp::from_microsecond(now.as_microsecond()).unwrap_or(now)
}
