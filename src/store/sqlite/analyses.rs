//! Analyses: finished results, and the one in force for each map.
//!
//! A map may have many analyses; the one that was asked for last answers. Asking again for options that were analysed
//! before puts that analysis back in force without a job.

use jiff::Timestamp;
use sqlx::SqliteConnection;
use stillage_core::AnalysisOptions;
use stillage_core::analysis::{ALGORITHM_VERSION, Diagnostic};
use uuid::Uuid;

use super::queue::{Claim, NewJob, insert_job, is_queue_full};
use super::rows::{Columns, analysis_record, job_record, json, map_record, semantics_record};
use super::{BlobId, Store, StoreError};
use crate::records::{AnalysisRecord, JobRecord, MapRecord, SemanticsRecord, StageReport};

/// What identifies a result: hash of the upload, the options and the version of the algorithms.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AnalysisAddress(String);

impl AnalysisAddress {
    /// The address of the analysis of an upload with some options.
    #[must_use]
    pub fn of(source: &BlobId, options: &AnalysisOptions) -> Self {
        let identity = format!("{source}\n{ALGORITHM_VERSION}\n{}", json(options));
        Self(blake3::hash(identity.as_bytes()).to_hex().to_string())
    }

    pub(super) const fn from_column(digits: String) -> Self {
        Self(digits)
    }

    /// The digits.
    #[must_use]
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

/// A finished analysis to be stored.
#[derive(Debug, Clone)]
pub struct NewAnalysis {
    /// Its id.
    pub id: Uuid,
    /// What each stage cost.
    pub stages: Vec<StageReport>,
    /// What the user should know about the result.
    pub diagnostics: Vec<Diagnostic>,
}

/// What became of the wish for an analysis.
#[derive(Debug, Clone, PartialEq)]
pub enum Request {
    /// It was there, and is in force now.
    Existing(Box<AnalysisRecord>),
    /// A new job will make it.
    New(JobRecord),
    /// A job that waits or runs already will make it.
    Pending(JobRecord),
    /// Too many jobs wait.
    QueueFull,
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
    /// The newest job of the map.
    pub job: Option<Uuid>,
}

impl Store {
    /// Asks for an analysis of a map; `None` when there is no such map.
    pub async fn request_analysis(
        &self,
        map: Uuid,
        options: &AnalysisOptions,
        max_queued: u64,
        now: Timestamp,
    ) -> Result<Option<Request>, StoreError> {
        let mut transaction = self.write().await?;
        let row = sqlx::query("SELECT source FROM maps WHERE id = $1").bind(map.to_string());
        let Some(row) = row.fetch_optional(&mut *transaction).await? else { return Ok(None) };
        let address = AnalysisAddress::of(&row.blob("source")?, options);
        if let Some(existing) = find_analysis(&mut transaction, map, &address).await? {
            put_in_force(&mut transaction, map, existing.id, Uuid::now_v7(), now).await?;
            transaction.commit().await?;
            return Ok(Some(Request::Existing(Box::new(existing))));
        }
        let pending = sqlx::query(
            "SELECT * FROM jobs WHERE map = $1 AND address = $2 AND state IN ('accepted', 'running') \
             AND cancel_requested = 0 ORDER BY id DESC LIMIT 1",
        )
        .bind(map.to_string())
        .bind(address.as_str())
        .fetch_optional(&mut *transaction)
        .await?;
        if let Some(row) = pending {
            return Ok(Some(Request::Pending(job_record(&row)?)));
        }
        if is_queue_full(&mut transaction, max_queued).await? {
            return Ok(Some(Request::QueueFull));
        }
        let job = NewJob { id: Uuid::now_v7(), map, options, address };
        let job = insert_job(&mut transaction, &job, now).await?;
        transaction.commit().await?;
        Ok(Some(Request::New(job)))
    }

    /// The analyses of a map, newest first.
    pub async fn analyses(&self, map: Uuid) -> Result<Vec<AnalysisRecord>, StoreError> {
        let rows = sqlx::query("SELECT * FROM analyses WHERE map = $1 ORDER BY id DESC")
            .bind(map.to_string())
            .fetch_all(&self.readers)
            .await?;
        rows.iter().map(analysis_record).collect()
    }

    /// Maps whose analysis in force was made by another version of the algorithms, with the options it was made with.
    pub async fn outdated(&self) -> Result<Vec<(Uuid, AnalysisOptions)>, StoreError> {
        let rows = sqlx::query(
            "SELECT maps.id, analyses.options FROM maps JOIN analyses ON analyses.id = maps.analysis \
             WHERE analyses.algorithm <> $1 ORDER BY maps.id",
        )
        .bind(ALGORITHM_VERSION)
        .fetch_all(&self.readers)
        .await?;
        rows.iter().map(|row| Ok((row.uuid("id")?, row.json("options")?))).collect()
    }

    /// A map with its analysis in force and the newest human decision; `None` when there is no such map.
    pub async fn snapshot(&self, map: Uuid) -> Result<Option<Snapshot>, StoreError> {
        let mut transaction = self.read().await?;
        let row = sqlx::query("SELECT * FROM maps WHERE id = $1").bind(map.to_string());
        let Some(row) = row.fetch_optional(&mut *transaction).await? else { return Ok(None) };
        let record = map_record(&row)?;
        let analysis = sqlx::query("SELECT * FROM analyses WHERE id = $1 AND algorithm = $2")
            .bind(record.analysis.map(|id| id.to_string()))
            .bind(ALGORITHM_VERSION)
            .fetch_optional(&mut *transaction)
            .await?;
        let semantics =
            sqlx::query("SELECT * FROM semantics_versions WHERE analysis = $1 ORDER BY version DESC LIMIT 1")
                .bind(record.analysis.map(|id| id.to_string()))
                .fetch_optional(&mut *transaction)
                .await?;
        let job = sqlx::query("SELECT id FROM jobs WHERE map = $1 ORDER BY id DESC LIMIT 1")
            .bind(map.to_string())
            .fetch_optional(&mut *transaction)
            .await?;
        Ok(Some(Snapshot {
            source: row.blob("source")?,
            analysis: analysis
                .map(|row| Ok::<_, StoreError>((analysis_record(&row)?, row.blob("blob")?)))
                .transpose()?,
            semantics: semantics.as_ref().map(semantics_record).transpose()?,
            job: job.map(|row| row.uuid("id")).transpose()?,
            record,
        }))
    }
}

/// Stores the result of a claim and puts it in force, unless a later request did so before. The caller has ended the
/// job in the same transaction.
pub(super) async fn insert_analysis(
    connection: &mut SqliteConnection,
    claim: &Claim,
    analysis: &NewAnalysis,
    blob: &BlobId,
    now: Timestamp,
) -> Result<(), StoreError> {
    sqlx::query(
        "INSERT INTO analyses (id, map, job, created, options, algorithm, address, blob, stages, diagnostics) \
         VALUES ($1, $2, $3, $4, $5, $6, $7, $8, $9, $10)",
    )
    .bind(analysis.id.to_string())
    .bind(claim.map.to_string())
    .bind(claim.job.to_string())
    .bind(now.as_microsecond())
    .bind(json(&claim.options))
    .bind(ALGORITHM_VERSION)
    .bind(claim.address.as_str())
    .bind(blob.as_str())
    .bind(json(&analysis.stages))
    .bind(json(&analysis.diagnostics))
    .execute(&mut *connection)
    .await?;
    put_in_force(connection, claim.map, analysis.id, claim.job, now).await
}

/// Lets an analysis answer for its map, unless it does already or a later request chose another one. Ids are version 7,
/// so their order is the order of the requests.
async fn put_in_force(
    connection: &mut SqliteConnection,
    map: Uuid,
    analysis: Uuid,
    request: Uuid,
    now: Timestamp,
) -> Result<(), StoreError> {
    sqlx::query(
        "UPDATE maps SET version = version + (analysis IS NOT $2), updated = $4, analysis = $2, analysis_asked = $3 \
         WHERE id = $1 AND (analysis_asked IS NULL OR analysis_asked < $3)",
    )
    .bind(map.to_string())
    .bind(analysis.to_string())
    .bind(request.to_string())
    .bind(now.as_microsecond())
    .execute(connection)
    .await?;
    Ok(())
}

async fn find_analysis(
    connection: &mut SqliteConnection,
    map: Uuid,
    address: &AnalysisAddress,
) -> Result<Option<AnalysisRecord>, StoreError> {
    let row = sqlx::query("SELECT * FROM analyses WHERE map = $1 AND address = $2")
        .bind(map.to_string())
        .bind(address.as_str())
        .fetch_optional(connection)
        .await?;
    row.as_ref().map(analysis_record).transpose()
}
