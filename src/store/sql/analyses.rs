//! Rows of analyses, and the one in force for each map.

use async_trait::async_trait;
use jiff::Timestamp;
use stillage_core::AnalysisOptions;
use stillage_core::analysis::ALGORITHM_VERSION;
use uuid::Uuid;

use super::capacity::Addition;
use super::columns::SqlRow;
use super::database::Transaction;
use super::jobs::insert_job;
use super::rows::{analysis_record, job_record, json, map_record, semantics_record};
use super::statement::query;
use super::store::SqlStore;
use crate::records::{AnalysisRecord, SemanticsRecord, StageReport, Tenant};
use crate::store::queue::Claim;
use crate::store::{
    Analyses, Blob, BlobId, Capacity, MapState, NewAnalysis, NewJob, Outdated, Request, Snapshot, StoreError,
};

#[async_trait]
impl Analyses for SqlStore {
    async fn request_analysis(
        &self,
        tenant: &Tenant,
        options: &AnalysisOptions,
        job: &NewJob,
        capacity: &Capacity,
        now: Timestamp,
    ) -> Result<Option<Request>, StoreError> {
        let mut transaction = self.database.write().await?;
        transaction.alone_on_tenant(tenant, capacity).await?;
        transaction.alone_on_site_of(job.map).await?;
        let row =
            query("SELECT id FROM maps WHERE tenant = $1 AND id = $2").bind(tenant.as_str()).bind(job.map.to_string());
        if row.fetch_optional(&mut transaction).await?.is_none() {
            return Ok(None);
        }
        if let Some(existing) = find_analysis(&mut transaction, job.map, options).await? {
            if job.activates {
                put_in_force(&mut transaction, job.map, existing.id, job.id, now).await?;
                transaction.commit().await?;
            }
            return Ok(Some(Request::Existing(Box::new(existing))));
        }
        let pending = query(
            "SELECT * FROM jobs WHERE map = $1 AND address = $2 AND state IN ('accepted', 'running') \
             AND NOT cancel_requested ORDER BY id DESC LIMIT 1",
        )
        .bind(job.map.to_string())
        .bind(job.address.as_str())
        .fetch_optional(&mut transaction)
        .await?;
        if let Some(row) = pending {
            query("UPDATE jobs SET activates = (activates OR $2) WHERE id = $1")
                .bind(row.text("id")?)
                .bind(job.activates)
                .execute(&mut transaction)
                .await?;
            transaction.commit().await?;
            return Ok(Some(Request::Pending(job_record(&row)?)));
        }
        if let Some(full) = transaction.full(tenant, capacity, Addition::default()).await? {
            return Ok(Some(Request::Full(full)));
        }
        let job = insert_job(&mut transaction, tenant, job, now).await?;
        transaction.commit().await?;
        Ok(Some(Request::New(job)))
    }

    async fn activate(&self, tenant: &Tenant, map: Uuid, analysis: Uuid, now: Timestamp) -> Result<bool, StoreError> {
        let mut transaction = self.database.write().await?;
        transaction.alone_on_site_of(map).await?;
        let found = query(
            "SELECT 1 FROM analyses JOIN maps ON maps.id = analyses.map \
             WHERE maps.tenant = $1 AND maps.id = $2 AND analyses.id = $3 AND analyses.algorithm = $4",
        )
        .bind(tenant.as_str())
        .bind(map.to_string())
        .bind(analysis.to_string())
        .bind(ALGORITHM_VERSION)
        .fetch_optional(&mut transaction)
        .await?;
        if found.is_some() {
            put_in_force(&mut transaction, map, analysis, Uuid::now_v7(), now).await?;
            transaction.commit().await?;
        }
        Ok(found.is_some())
    }

    async fn analyses(&self, tenant: &Tenant, map: Uuid) -> Result<Vec<AnalysisRecord>, StoreError> {
        let rows = query(
            "SELECT analyses.* FROM analyses JOIN maps ON maps.id = analyses.map \
             WHERE maps.tenant = $1 AND maps.id = $2 ORDER BY analyses.id DESC",
        )
        .bind(tenant.as_str())
        .bind(map.to_string())
        .fetch_all(&self.database)
        .await?;
        rows.iter().map(analysis_record).collect()
    }

    async fn analysis_blob(&self, tenant: &Tenant, map: Uuid, analysis: Uuid) -> Result<Option<BlobId>, StoreError> {
        let row = query(
            "SELECT analyses.blob FROM analyses JOIN maps ON maps.id = analyses.map \
             WHERE maps.tenant = $1 AND maps.id = $2 AND analyses.id = $3 AND analyses.algorithm = $4",
        )
        .bind(tenant.as_str())
        .bind(map.to_string())
        .bind(analysis.to_string())
        .bind(ALGORITHM_VERSION)
        .fetch_optional(&self.database)
        .await?;
        row.map(|row| row.blob("blob")).transpose()
    }

    async fn outdated(&self) -> Result<Vec<Outdated>, StoreError> {
        let rows = query(
            "SELECT maps.tenant, maps.id, analyses.options FROM maps JOIN analyses ON analyses.id = maps.analysis \
             WHERE analyses.algorithm <> $1 AND maps.hidden IS NULL ORDER BY maps.id",
        )
        .bind(ALGORITHM_VERSION)
        .fetch_all(&self.database)
        .await?;
        let outdated =
            |row: &SqlRow| Ok(Outdated { tenant: row.tenant()?, map: row.uuid("id")?, options: row.json("options")? });
        rows.iter().map(outdated).collect()
    }

    async fn map_state(&self, tenant: &Tenant, map: Uuid) -> Result<Option<MapState>, StoreError> {
        let row = query(
            "SELECT version, analysis, \
                 (SELECT coalesce(max(version), 0) FROM semantics_versions WHERE analysis = maps.analysis) AS semantics \
             FROM maps WHERE tenant = $1 AND id = $2",
        )
        .bind(tenant.as_str())
        .bind(map.to_string())
        .fetch_optional(&self.database)
        .await?;
        let state = |row: SqlRow| {
            let (version, semantics) = (row.whole("version")?, row.whole("semantics")?);
            Ok(MapState { version, analysis: row.uuid_if("analysis")?, semantics })
        };
        row.map(state).transpose()
    }

    async fn snapshot(&self, tenant: &Tenant, map: Uuid) -> Result<Option<Snapshot>, StoreError> {
        let mut transaction = self.database.snapshot().await?;
        let row = query("SELECT * FROM maps WHERE tenant = $1 AND id = $2").bind(tenant.as_str()).bind(map.to_string());
        let Some(row) = row.fetch_optional(&mut transaction).await? else { return Ok(None) };
        let record = map_record(&row)?;
        let analysis = query("SELECT * FROM analyses WHERE id = $1 AND algorithm = $2")
            .bind(record.analysis.map(|id| id.to_string()))
            .bind(ALGORITHM_VERSION)
            .fetch_optional(&mut transaction)
            .await?;
        let semantics = query("SELECT * FROM semantics_versions WHERE analysis = $1 ORDER BY version DESC LIMIT 1")
            .bind(record.analysis.map(|id| id.to_string()))
            .fetch_optional(&mut transaction)
            .await?;
        let decided_before = match row.uuid_if("decided_before")? {
            Some(analysis) => decision_on(&mut transaction, analysis).await?,
            None => None,
        };
        let layout = query(
            "SELECT semantics_versions.layout FROM semantics_versions JOIN maps ON maps.id = semantics_versions.map \
             WHERE maps.tenant = $3 AND maps.site = $1 AND maps.id <= $2 ORDER BY maps.id DESC, semantics_versions.version DESC LIMIT 1",
        )
        .bind(record.site.to_string())
        .bind(map.to_string())
        .bind(tenant.as_str())
        .fetch_optional(&mut transaction)
        .await?;
        let job = query("SELECT id FROM jobs WHERE map = $1 ORDER BY id DESC LIMIT 1")
            .bind(map.to_string())
            .fetch_optional(&mut transaction)
            .await?;
        Ok(Some(Snapshot {
            source: row.blob("source")?,
            analysis: analysis
                .map(|row| Ok::<_, StoreError>((analysis_record(&row)?, row.blob("blob")?)))
                .transpose()?,
            semantics: semantics.as_ref().map(semantics_record).transpose()?,
            decided_before,
            layout: layout.map(|row| row.json("layout")).transpose()?.unwrap_or_default(),
            job: job.map(|row| row.uuid("id")).transpose()?,
            record,
        }))
    }
}

/// The newest decision on an analysis, with the blob of the analysis it was made on: where it was carried over from another
/// analysis of the map, the one that was carried.
async fn decision_on(
    transaction: &mut Transaction,
    analysis: Uuid,
) -> Result<Option<(SemanticsRecord, BlobId)>, StoreError> {
    let newest = query("SELECT * FROM semantics_versions WHERE analysis = $1 ORDER BY version DESC LIMIT 1")
        .bind(analysis.to_string())
        .fetch_optional(&mut *transaction)
        .await?;
    let Some(row) = newest else { return Ok(None) };
    let newest = semantics_record(&row)?;
    let version = match &newest.carried {
        Some(carried) if carried.map.is_none() => carried.from,
        _ => newest.version,
    };
    let decided = query(
        "SELECT semantics_versions.*, analyses.blob FROM semantics_versions \
             JOIN analyses ON analyses.id = semantics_versions.analysis \
         WHERE semantics_versions.map = $1 AND semantics_versions.version = $2",
    )
    .bind(row.text("map")?)
    .bind(version.cast_signed())
    .fetch_optional(&mut *transaction)
    .await?;
    decided.map(|row| Ok((semantics_record(&row)?, row.blob("blob")?))).transpose()
}

/// Stores the result of a claim, and puts it in force where none is or where the job activates it, unless a later request
/// did so before. The caller has ended the job in the same transaction.
pub(super) async fn insert_analysis(
    transaction: &mut Transaction,
    claim: &Claim,
    analysis: &NewAnalysis,
    stages: &[StageReport],
    blob: &Blob,
    now: Timestamp,
) -> Result<(), StoreError> {
    query(
        "INSERT INTO analyses (id, map, job, created, options, algorithm, address, blob, stages, diagnostics, bytes) \
         VALUES ($1, $2, $3, $4, $5, $6, $7, $8, $9, $10, $11)",
    )
    .bind(analysis.id.to_string())
    .bind(claim.map.to_string())
    .bind(claim.job.to_string())
    .bind(now.as_microsecond())
    .bind(json(&analysis.options))
    .bind(ALGORITHM_VERSION)
    .bind(claim.address.as_str())
    .bind(blob.id().as_str())
    .bind(json(&stages))
    .bind(json(&analysis.diagnostics))
    .bind(blob.bytes().len() as i64)
    .execute(&mut *transaction)
    .await?;
    let comes_into_force = query(
        "SELECT 1 FROM jobs JOIN maps ON maps.id = jobs.map WHERE jobs.id = $1 AND (jobs.activates OR maps.analysis IS NULL)",
    )
    .bind(claim.job.to_string())
    .fetch_optional(&mut *transaction)
    .await?;
    if comes_into_force.is_some() {
        put_in_force(transaction, claim.map, analysis.id, claim.job, now).await?;
    }
    Ok(())
}

/// Lets an analysis answer for its map, unless it does already or a later request chose another one. Ids are version 7,
/// so their order is the order of the requests.
async fn put_in_force(
    transaction: &mut Transaction,
    map: Uuid,
    analysis: Uuid,
    request: Uuid,
    now: Timestamp,
) -> Result<(), StoreError> {
    query(
        "UPDATE maps SET version = CASE WHEN analysis IS DISTINCT FROM $2 THEN version + 1 ELSE version END, \
             updated = CASE WHEN analysis IS DISTINCT FROM $2 THEN $4 ELSE updated END, \
             decided_before = CASE WHEN analysis IS DISTINCT FROM $2 \
                     AND EXISTS (SELECT 1 FROM semantics_versions WHERE semantics_versions.analysis = maps.analysis) \
                 THEN analysis ELSE decided_before END, \
             analysis = $2, analysis_asked = $3 \
         WHERE id = $1 AND (analysis_asked IS NULL OR analysis_asked < $3)",
    )
    .bind(map.to_string())
    .bind(analysis.to_string())
    .bind(request.to_string())
    .bind(now.as_microsecond())
    .execute(&mut *transaction)
    .await?;
    Ok(())
}

/// The analysis of a map with some options. The options are compared, not a hash of them, so that an analysis of an
/// earlier release is found by options that had fewer members then.
async fn find_analysis(
    transaction: &mut Transaction,
    map: Uuid,
    options: &AnalysisOptions,
) -> Result<Option<AnalysisRecord>, StoreError> {
    let rows = query("SELECT * FROM analyses WHERE map = $1 AND algorithm = $2 ORDER BY id DESC")
        .bind(map.to_string())
        .bind(ALGORITHM_VERSION)
        .fetch_all(&mut *transaction)
        .await?;
    for row in &rows {
        let record = analysis_record(row)?;
        if record.options == *options {
            return Ok(Some(record));
        }
    }
    Ok(None)
}
