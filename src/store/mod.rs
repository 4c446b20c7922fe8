//! What is kept: rows in a database, big things as blobs. These files are the contract; an engine fulfils it.
//!
//! | file | what it promises |
//! | --- | --- |
//! | `maps` | uploads with their first job, the record of a map, deletion |
//! | `hidden_maps` | maps that were deleted and may be restored for a while |
//! | `analyses` | finished results, the one in force for each map |
//! | `capacity` | how much there may be, in all and of a tenant |
//! | `queue` | the worker's side of a job: claim, heartbeat, result |
//! | `jobs` | the client's side of a job: read, list, dismiss |
//! | `semantics` | human decisions, and the corrections they name |
//! | `registries` | the codes and names of a site's places |
//! | `rule_sets` | rule sets that people wrote |
//! | `keys`, `audit` | API keys, and who changed what |
//! | `blobs` | bytes by their hash, and the formats of stored values |
//! | `sql` | the store: all SQL, for both databases |
//! | `sqlite`, `postgres` | how each database is opened, and what only it has |
//! | `backup` | a copy of the store of one process, and a store made of the copy |
//! | `contract` | the tests that every engine must pass |
//!
//! What every engine keeps, whatever dies and when:
//! - What was answered is on stable storage.
//! - A row never names a blob that is not there. A blob is written before its row is committed, and removed when no row
//!   names it any more. A blob whose row never came is swept later.
//! - The queue hands a job to one worker at a time, and only the newest claim can finish it (see [`queue`]).
//! - Whatever is asked under a [`Tenant`](crate::records::Tenant) reads and writes rows of that tenant only: the id of
//!   another tenant's row is an id without a row.
//! - A change and its entry in the log of changes ([`with_entry`]) are there together, or neither is.
//! - No call reads a clock but [`Store::clock`]: the caller passes the time.

mod analyses;
mod audit;
mod backup;
mod blobs;
mod capacity;
mod clock;
#[cfg(test)]
pub(crate) mod contract;
mod database_faults;
mod engine;
mod error;
mod free_space;
mod hidden_maps;
mod jobs;
mod keys;
mod maps;
mod migrations;
#[cfg(feature = "postgres")]
mod postgres;
mod process_counts;
pub mod queue;
mod registries;
mod result_address;
mod rule_sets;
mod semantics;
mod sql;
mod sqlite;

use std::sync::Arc;

use crate::config::{Config, DatabaseAddress};
use sql::SqlStore;

pub use analyses::{Analyses, MapState, NewAnalysis, Outdated, Request, Snapshot};
pub use audit::{AuditLog, with_entry};
pub use backup::{BackupContents, BackupError, CopyProgress, back_up, check_backup, restore};
pub use blobs::{Blob, BlobId, Blobs, LocalBlobs, Stored};
pub use capacity::{Capacity, Full, Quotas};
pub use clock::now;
pub use engine::{DiskUse, Store};
pub use error::StoreError;
pub use hidden_maps::{HiddenMap, HiddenMaps};
pub use jobs::{Jobs, NewJob, Retry};
pub use keys::Keys;
pub use maps::{IdempotencyKey, Maps, NewMapRow, Upload};
pub use process_counts::{busy_calls, rescued_jobs};
pub use queue::Queue;
pub use registries::{Registries, SiteRegistry};
pub use result_address::ResultAddress;
pub use rule_sets::RuleSets;
pub use semantics::{NewCorrections, NewSemanticsRow, SemanticsVersions};
pub use sql::Moved;

/// Opens the configured store and brings its database up to date.
///
/// # Errors
/// [`StoreError::FolderInUse`] when another process has the data folder, [`StoreError::NewerDatabase`] when a newer
/// program wrote it, and whatever the disk answers.
pub async fn open(config: &Config) -> Result<Arc<dyn Store>, StoreError> {
    Ok(Arc::new(SqlStore::open(config).await?))
}

/// Opens the keys of a database, also of one that a service makes use of. One that nobody makes use of is made where it is
/// missing, and brought up to date.
///
/// # Errors
/// [`StoreError::NewerDatabase`] or [`StoreError::OlderService`] where the service is of another release, and whatever the
/// database answers.
pub async fn open_keys(database: &DatabaseAddress) -> Result<Box<dyn Keys>, StoreError> {
    Ok(Box::new(sql::Database::open_beside(database).await?))
}

/// Moves everything from one configured storage to another, of which nobody makes use meanwhile. After each map `tell` is
/// told how far it is.
///
/// # Errors
/// What stands against it; the same call goes on afterwards.
pub async fn move_all(from: &Config, to: &Config, tell: impl Fn(&Moved)) -> Result<Moved, StoreError> {
    let (from, to) = (SqlStore::open(from).await?, SqlStore::open(to).await?);
    let moved = sql::move_all(&from, &to, tell).await?;
    from.close().await;
    to.close().await;
    Ok(moved)
}
