//! Rows of human decisions.

use async_trait::async_trait;
use jiff::Timestamp;
use sqlx::Row;
use uuid::Uuid;

use super::Sqlite;
use super::rows::{Columns, json, semantics_record};
use crate::records::{SemanticsRecord, Tenant};
use crate::store::{NewSemanticsRow, SemanticsVersions, StoreError};

#[async_trait]
impl SemanticsVersions for Sqlite {
    async fn insert_semantics(
        &self,
        tenant: &Tenant,
        new: &NewSemanticsRow,
        now: Timestamp,
    ) -> Result<Option<Result<SemanticsRecord, u64>>, StoreError> {
        let mut transaction = self.write().await?;
        let row = sqlx::query(
            "SELECT analysis, \
                 (SELECT coalesce(max(version), 0) FROM semantics_versions WHERE analysis = maps.analysis) AS in_force, \
                 (SELECT coalesce(max(version), 0) FROM semantics_versions WHERE map = maps.id) AS newest \
             FROM maps WHERE tenant = $1 AND id = $2",
        )
        .bind(tenant.as_str())
        .bind(new.map.to_string())
        .fetch_optional(&mut *transaction)
        .await?;
        let Some(row) = row else { return Ok(None) };
        let in_force: u64 = row.whole("in_force")?;
        if row.uuid_if("analysis")? != Some(new.analysis) || in_force != new.replaces {
            return Ok(Some(Err(in_force)));
        }
        let row = sqlx::query(
            "INSERT INTO semantics_versions (map, version, analysis, rule_set, draft, assignment, layout, origin, carried, created) \
             VALUES ($1, $2, $3, $4, $5, $6, $7, $8, $9, $10) RETURNING *",
        )
        .bind(new.map.to_string())
        .bind(row.try_get::<i64, _>("newest")? + 1)
        .bind(new.analysis.to_string())
        .bind(&new.rule_set)
        .bind(json(&new.draft))
        .bind(json(&new.assignment))
        .bind(json(&new.layout))
        .bind(new.origin.name())
        .bind(new.carried.as_ref().map(json))
        .bind(now.as_microsecond())
        .fetch_one(&mut *transaction)
        .await?;
        sqlx::query(
            "UPDATE maps SET version = version + 1 \
             WHERE site = (SELECT site FROM maps AS decided WHERE decided.id = $1) AND id > $1",
        )
        .bind(new.map.to_string())
        .execute(&mut *transaction)
        .await?;
        transaction.commit().await?;
        Ok(Some(Ok(semantics_record(&row)?)))
    }

    async fn semantics_versions(&self, tenant: &Tenant, map: Uuid) -> Result<Vec<SemanticsRecord>, StoreError> {
        let rows = sqlx::query(
            "SELECT semantics_versions.* FROM semantics_versions JOIN maps ON maps.id = semantics_versions.map \
             WHERE maps.tenant = $1 AND maps.id = $2 ORDER BY semantics_versions.version DESC",
        )
        .bind(tenant.as_str())
        .bind(map.to_string())
        .fetch_all(&self.readers)
        .await?;
        rows.iter().map(semantics_record).collect()
    }
}
