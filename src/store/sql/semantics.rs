//! Rows of human decisions.

use async_trait::async_trait;
use jiff::Timestamp;
use stillage_core::corrections::Correction;
use stillage_core::layout::LayoutOptions;
use uuid::Uuid;

use super::database::Transaction;
use super::rows::{json, semantics_record};
use super::statement::query;
use super::store::SqlStore;
use crate::records::{CorrectionId, CorrectionList, CorrectionRecord, SemanticsRecord, Tenant};
use crate::store::{NewCorrections, NewSemanticsRow, SemanticsVersions, StoreError};

#[async_trait]
impl SemanticsVersions for SqlStore {
    async fn insert_semantics(
        &self,
        tenant: &Tenant,
        new: &NewSemanticsRow,
        now: Timestamp,
    ) -> Result<Option<Result<SemanticsRecord, u64>>, StoreError> {
        let mut transaction = self.database.write().await?;
        transaction.alone_on_site_of(new.map).await?;
        let row = query(
            "SELECT analysis, \
                 (SELECT coalesce(max(version), 0) FROM semantics_versions WHERE analysis = maps.analysis) AS in_force, \
                 (SELECT coalesce(max(version), 0) FROM semantics_versions WHERE map = maps.id) AS newest \
             FROM maps WHERE tenant = $1 AND id = $2",
        )
        .bind(tenant.as_str())
        .bind(new.map.to_string())
        .fetch_optional(&mut transaction)
        .await?;
        let Some(row) = row else { return Ok(None) };
        let in_force: u64 = row.whole("in_force")?;
        if row.uuid_if("analysis")? != Some(new.analysis) || in_force != new.replaces {
            return Ok(Some(Err(in_force)));
        }
        let corrections = match &new.corrections {
            NewCorrections::Stored(list) => *list,
            NewCorrections::Changed(list) => insert_corrections(&mut transaction, new.map, list).await?,
        };
        let row = query(
            "INSERT INTO semantics_versions (map, version, analysis, rule_set, draft, assignment, layout, origin, carried, \
                 created, corrections, correction_count, restores) \
             VALUES ($1, $2, $3, $4, $5, $6, $7, $8, $9, $10, $11, $12, $13) RETURNING *",
        )
        .bind(new.map.to_string())
        .bind(row.whole::<i64>("newest")? + 1)
        .bind(new.analysis.to_string())
        .bind(&new.rule_set)
        .bind(json(&new.draft))
        .bind(json(&new.assignment))
        .bind(json(&new.layout))
        .bind(new.origin.name())
        .bind(new.carried.as_ref().map(json))
        .bind(now.as_microsecond())
        .bind(corrections.map(|list| list.number))
        .bind(corrections.map_or(0, |list| list.count))
        .bind(new.restores.map(u64::cast_signed))
        .fetch_one(&mut transaction)
        .await?;
        query(
            "UPDATE maps SET version = version + 1 \
             WHERE site = (SELECT site FROM maps AS decided WHERE decided.id = $1) AND id > $1",
        )
        .bind(new.map.to_string())
        .execute(&mut transaction)
        .await?;
        transaction.commit().await?;
        Ok(Some(Ok(semantics_record(&row)?)))
    }

    async fn semantics_versions(&self, tenant: &Tenant, map: Uuid) -> Result<Vec<SemanticsRecord>, StoreError> {
        let rows = query(
            "SELECT semantics_versions.* FROM semantics_versions JOIN maps ON maps.id = semantics_versions.map \
             WHERE maps.tenant = $1 AND maps.id = $2 ORDER BY semantics_versions.version DESC",
        )
        .bind(tenant.as_str())
        .bind(map.to_string())
        .fetch_all(&self.database)
        .await?;
        rows.iter().map(semantics_record).collect()
    }

    async fn corrections(
        &self,
        tenant: &Tenant,
        map: Uuid,
        list: CorrectionList,
    ) -> Result<Option<Vec<CorrectionRecord>>, StoreError> {
        let row = query(
            "SELECT correction_lists.corrections FROM correction_lists JOIN maps ON maps.id = correction_lists.map \
             WHERE maps.tenant = $1 AND maps.id = $2 AND correction_lists.number = $3",
        )
        .bind(tenant.as_str())
        .bind(map.to_string())
        .bind(list.number)
        .fetch_optional(&self.database)
        .await?;
        row.map(|row| row.json("corrections")).transpose()
    }

    async fn semantics_before(
        &self,
        tenant: &Tenant,
        map: Uuid,
        time: Timestamp,
    ) -> Result<Option<SemanticsRecord>, StoreError> {
        let row = query(
            "SELECT semantics_versions.* FROM semantics_versions JOIN maps ON maps.id = semantics_versions.map \
             WHERE maps.tenant = $1 AND maps.id = $2 AND semantics_versions.created < $3 \
             ORDER BY semantics_versions.version DESC LIMIT 1",
        )
        .bind(tenant.as_str())
        .bind(map.to_string())
        .bind(time.as_microsecond())
        .fetch_optional(&self.database)
        .await?;
        row.as_ref().map(semantics_record).transpose()
    }

    async fn layout_before(&self, tenant: &Tenant, map: Uuid, version: u64) -> Result<LayoutOptions, StoreError> {
        let row = query(
            "SELECT semantics_versions.layout FROM maps AS asked JOIN maps ON maps.site = asked.site \
                 JOIN semantics_versions ON semantics_versions.map = maps.id \
             WHERE asked.tenant = $1 AND asked.id = $2 AND maps.tenant = $1 \
                 AND (maps.id < asked.id OR (maps.id = asked.id AND semantics_versions.version < $3)) \
             ORDER BY maps.id DESC, semantics_versions.version DESC LIMIT 1",
        )
        .bind(tenant.as_str())
        .bind(map.to_string())
        .bind(version.cast_signed())
        .fetch_optional(&self.database)
        .await?;
        Ok(row.map(|row| row.json("layout")).transpose()?.unwrap_or_default())
    }
}

/// Stores a list of corrections; the new ones get ids that none of the map had. `None` for an empty list.
async fn insert_corrections(
    transaction: &mut Transaction,
    map: Uuid,
    corrections: &[(Option<CorrectionId>, Correction)],
) -> Result<Option<CorrectionList>, StoreError> {
    if corrections.is_empty() {
        return Ok(None);
    }
    let row = query(
        "SELECT coalesce(max(number), 0) AS number, coalesce(max(newest), 0) AS newest FROM correction_lists \
         WHERE map = $1",
    )
    .bind(map.to_string())
    .fetch_one(&mut *transaction)
    .await?;
    let number = row.whole::<u32>("number")? + 1;
    let mut newest: u32 = row.whole("newest")?;
    let record = |(id, correction): &(Option<CorrectionId>, Correction)| CorrectionRecord {
        id: id.unwrap_or_else(|| {
            newest += 1;
            CorrectionId(newest)
        }),
        correction: correction.clone(),
    };
    let records: Vec<CorrectionRecord> = corrections.iter().map(record).collect();
    query("INSERT INTO correction_lists (map, number, corrections, newest) VALUES ($1, $2, $3, $4)")
        .bind(map.to_string())
        .bind(number)
        .bind(json(&records))
        .bind(newest)
        .execute(&mut *transaction)
        .await?;
    Ok(Some(CorrectionList { number, count: records.len() as u32 }))
}
