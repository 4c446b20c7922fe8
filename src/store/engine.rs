//! What an engine offers as a whole.

use std::fmt;
use std::time::Duration;

use async_trait::async_trait;
use jiff::Timestamp;

use super::{
    Analyses, AuditLog, Blobs, HiddenMaps, Jobs, Keys, Maps, Queue, Registries, RuleSets, SemanticsVersions, StoreError,
};

/// What the files of a store take, and what is free beside them.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct DiskUse {
    /// Bytes that may still be written; `None` where nothing is written to disks of this machine.
    pub free_bytes: Option<u64>,
    /// Length of the write-ahead log, where the engine has a file of it.
    pub log_bytes: Option<u64>,
}

/// An open store.
#[async_trait]
pub trait Store:
    Maps
    + HiddenMaps
    + Analyses
    + Queue
    + Jobs
    + SemanticsVersions
    + Registries
    + RuleSets
    + fmt::Debug
    + Send
    + Sync
    + 'static
{
    /// The blobs.
    fn blobs(&self) -> &dyn Blobs;

    /// The keys.
    fn keys(&self) -> &dyn Keys;

    /// The log of changes.
    fn audit(&self) -> &dyn AuditLog;

    /// Whether other processes may use the database at the same time.
    fn is_shared(&self) -> bool;

    /// How many writes there were, where none is under way: what was read of the database between two calls that answer the
    /// same number is as it was. `None` while somebody writes.
    fn writes(&self) -> Option<u64>;

    /// Whether there is room for uploads and results.
    ///
    /// # Errors
    /// [`StoreError::NoSpace`] below the configured floor.
    fn check_space(&self) -> Result<(), StoreError>;

    /// What its files take, and what is free beside them.
    ///
    /// # Errors
    /// When the disk does not answer.
    fn disk_use(&self) -> Result<DiskUse, StoreError>;

    /// Whether the database answers and there is room.
    ///
    /// # Errors
    /// What is wrong.
    async fn check(&self) -> Result<(), StoreError>;

    /// The schema version of the database.
    async fn schema_version(&self) -> Result<i64, StoreError>;

    /// The time by the clock of the database, by which leases run: processes that share one share its clock.
    ///
    /// # Errors
    /// When the database does not answer.
    async fn clock(&self) -> Result<Timestamp, StoreError>;

    /// Returns when another process may have queued or changed a job: a hint, at least once a second. Where no other process
    /// can, it never returns.
    async fn job_changed_elsewhere(&self);

    /// Removes blobs without a row that are older than `age`, and what is left of interrupted writes. Answers how many
    /// blobs were removed.
    ///
    /// # Errors
    /// When the database or the blobs do not answer.
    async fn sweep_blobs(&self, age: Duration) -> Result<usize, StoreError>;

    /// Fills in the lengths of uploads and results that an earlier release stored without, so that they count to the quotas of
    /// their tenants. Answers how many there were.
    ///
    /// # Errors
    /// When the database or the blobs do not answer; what is left is for the next call.
    async fn measure_unmeasured_blobs(&self) -> Result<u64, StoreError>;

    /// Closes the connections; pending writes end first.
    async fn close(&self);
}
