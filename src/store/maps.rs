//! Maps: the upload with its first job, and the record.

use async_trait::async_trait;
use jiff::Timestamp;
use stillage_core::analysis::Diagnostic;
use uuid::Uuid;

use super::{Blob, BlobId, Capacity, Full, NewJob, StoreError};
use crate::coordinates::Survey;
use crate::records::{AlignmentRecord, JobRecord, MapPatch, MapRecord, Tenant};

/// A map to be stored.
#[derive(Debug, Clone)]
pub struct NewMapRow {
    /// Its id.
    pub id: Uuid,
    /// Name for people.
    pub name: String,
    /// Columns of the grid.
    pub width: u32,
    /// Rows of the grid.
    pub height: u32,
    /// Side of a cell, metres.
    pub resolution: f64,
    /// Where it lies on Earth.
    pub georeference: Option<Survey>,
    /// Its site; its own id for the first map of one.
    pub site: Uuid,
    /// How it lies on an earlier map of the site.
    pub alignment: Option<AlignmentRecord>,
    /// Remarks of the ingest.
    pub warnings: Vec<Diagnostic>,
}

/// The key of a request and the hash of what it asked.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct IdempotencyKey {
    /// What the client chose.
    pub key: String,
    /// Hash of the request.
    pub content: String,
}

/// What became of an upload.
#[derive(Debug, Clone, PartialEq)]
pub enum Upload {
    /// Stored, with this job.
    New(JobRecord),
    /// The key was seen with the same content: this is its job.
    Seen(JobRecord),
    /// The key was seen with other content.
    KeyReused,
    /// There is no room for it.
    Full(Full),
}

/// What is kept of maps.
#[async_trait]
pub trait Maps {
    /// Why a tenant cannot add a map of whatever length, before it is decoded.
    async fn full(&self, tenant: &Tenant, capacity: &Capacity) -> Result<Option<Full>, StoreError>;

    /// Stores an upload, its map, its first job and its idempotency key: all or nothing.
    #[expect(clippy::too_many_arguments, reason = "all that is committed together")]
    async fn create_map(
        &self,
        tenant: &Tenant,
        map: &NewMapRow,
        source: &Blob,
        job: &NewJob,
        key: Option<&IdempotencyKey>,
        capacity: &Capacity,
        now: Timestamp,
    ) -> Result<Upload, StoreError>;

    /// The outcome of an earlier upload with this key, so that a repetition is answered even when the service is full.
    async fn seen_upload(
        &self,
        tenant: &Tenant,
        key: &IdempotencyKey,
        now: Timestamp,
    ) -> Result<Option<Upload>, StoreError>;

    /// Maps, newest first, after one when paging.
    async fn maps(&self, tenant: &Tenant, limit: u32, after: Option<Uuid>) -> Result<Vec<MapRecord>, StoreError>;

    /// A map.
    async fn map(&self, tenant: &Tenant, id: Uuid) -> Result<Option<MapRecord>, StoreError>;

    /// The blob of a map's upload, which never changes.
    async fn map_source(&self, tenant: &Tenant, id: Uuid) -> Result<Option<BlobId>, StoreError>;

    /// Changes a map, when it is at the version in `if_match`: the record after the change, or the one that stands in
    /// the way; `None` when there is no such map.
    async fn update_map(
        &self,
        tenant: &Tenant,
        id: Uuid,
        patch: &MapPatch,
        if_match: Option<u64>,
        now: Timestamp,
    ) -> Result<Option<Result<MapRecord, MapRecord>>, StoreError>;

    /// Deletes everything of a map, when it is at the version in `if_match`: rows first, then the blobs that no other map
    /// shares. `false` when there is no such map at that version. Its running jobs find out with their next heartbeat.
    async fn delete_map(&self, tenant: &Tenant, id: Uuid, if_match: Option<u64>) -> Result<bool, StoreError>;
}
