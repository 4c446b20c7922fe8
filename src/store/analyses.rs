//! Analyses: finished results, and the one in force for each map.
//!
//! A map may have many analyses, one of which answers. The first one does so at once; later ones are proposals beside it
//! until they are activated, or at once where their request says so: of two such requests, the later one wins.

use async_trait::async_trait;
use jiff::Timestamp;
use stillage_core::AnalysisOptions;
use stillage_core::analysis::Diagnostic;
use stillage_core::layout::LayoutOptions;
use uuid::Uuid;

use super::{BlobId, Capacity, Full, NewJob, StoreError};
use crate::records::{AnalysisRecord, JobRecord, MapRecord, SemanticsRecord, Tenant};

/// A finished analysis to be stored.
#[derive(Debug, Clone)]
pub struct NewAnalysis {
    /// Its id.
    pub id: Uuid,
    /// The options, whole.
    pub options: AnalysisOptions,
    /// What the user should know about the result.
    pub diagnostics: Vec<Diagnostic>,
}

/// What became of the wish for an analysis.
#[derive(Debug, Clone, PartialEq)]
pub enum Request {
    /// It was there; it is in force now where that was asked.
    Existing(Box<AnalysisRecord>),
    /// A new job will make it.
    New(JobRecord),
    /// A job that waits or runs already will make it.
    Pending(JobRecord),
    /// There is no room for it.
    Full(Full),
}

/// A map whose analysis in force was made by another version of the algorithms.
#[derive(Debug, Clone, PartialEq)]
pub struct Outdated {
    /// Whose map it is.
    pub tenant: Tenant,
    /// The map.
    pub map: Uuid,
    /// The options its analysis was made with.
    pub options: AnalysisOptions,
}

/// What decides every answer about a map. Two moments with the same state have the same answers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MapState {
    /// Version of the map's record: its name and georeference, too.
    pub version: u64,
    /// The analysis in force.
    pub analysis: Option<Uuid>,
    /// The version of the decision in force on that analysis; 0 for the suggestion.
    pub semantics: u64,
}

/// All that is needed to answer questions about a map, as of one moment.
#[derive(Debug, Clone)]
pub struct Snapshot {
    /// The map.
    pub record: MapRecord,
    /// Blob of the upload.
    pub source: BlobId,
    /// The analysis in force and its blob; `None` before the first one, and when another version of the algorithms
    /// wrote it.
    pub analysis: Option<(AnalysisRecord, BlobId)>,
    /// The newest human decision on that analysis.
    pub semantics: Option<SemanticsRecord>,
    /// How locations are cut and numbered where nobody decided on that analysis: as the newest decision on the map says,
    /// or that on the newest of the site's maps before it.
    pub layout: LayoutOptions,
    /// The newest decision that a person made on the analysis that, of those with decisions, answered last before the one in
    /// force, and the blob of that analysis. Where what answered there was carried over itself from another analysis, it is
    /// the decision that was carried.
    pub decided_before: Option<(SemanticsRecord, BlobId)>,
    /// The newest job of the map.
    pub job: Option<Uuid>,
}

/// What is kept of analyses.
#[async_trait]
pub trait Analyses {
    /// Asks for the analysis of a map with some options, which `job` makes unless it is there or under way; `None` when
    /// there is no such map.
    async fn request_analysis(
        &self,
        tenant: &Tenant,
        options: &AnalysisOptions,
        job: &NewJob,
        capacity: &Capacity,
        now: Timestamp,
    ) -> Result<Option<Request>, StoreError>;

    /// Puts an analysis in force; `false` when the map has no such analysis by this version of the algorithms.
    async fn activate(&self, tenant: &Tenant, map: Uuid, analysis: Uuid, now: Timestamp) -> Result<bool, StoreError>;

    /// The analyses of a map, newest first; none when there is no such map.
    async fn analyses(&self, tenant: &Tenant, map: Uuid) -> Result<Vec<AnalysisRecord>, StoreError>;

    /// The blob of an analysis of a map by this version of the algorithms; `None` when there is no such analysis.
    async fn analysis_blob(&self, tenant: &Tenant, map: Uuid, analysis: Uuid) -> Result<Option<BlobId>, StoreError>;

    /// Maps of all tenants whose analysis in force was made by another version of the algorithms.
    async fn outdated(&self) -> Result<Vec<Outdated>, StoreError>;

    /// The state of a map, by one query on indexes: it is asked for with every question about the map. `None` when there
    /// is no such map.
    async fn map_state(&self, tenant: &Tenant, map: Uuid) -> Result<Option<MapState>, StoreError>;

    /// A map with its analysis in force and the newest human decision; `None` when there is no such map.
    async fn snapshot(&self, tenant: &Tenant, map: Uuid) -> Result<Option<Snapshot>, StoreError>;
}
