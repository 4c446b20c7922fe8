//! Human decisions: immutable versions, each bound to the analysis whose categories it names.

use jiff::Timestamp;
use sqlx::Row;
use stillage_core::semantics::{Assignment, RuleSetDraft};
use uuid::Uuid;

use super::rows::{Columns, json, semantics_record};
use super::{Store, StoreError};
use crate::records::SemanticsRecord;

/// A decision to be stored.
#[derive(Debug, Clone)]
pub struct NewSemanticsRow {
    /// The map.
    pub map: Uuid,
    /// The analysis it was checked against.
    pub analysis: Uuid,
    /// The version that was in force when it was made; 0 for the suggestion.
    pub replaces: u64,
    /// Id of the rule set.
    pub rule_set: String,
    /// The rule set as it is.
    pub draft: RuleSetDraft,
    /// The decision.
    pub assignment: Assignment,
}

impl Store {
    /// Stores a decision, when the analysis and the version it was made on are still in force; otherwise `Err` with the
    /// version in force, and `None` when the map is gone.
    ///
    /// Versions count on over all analyses of a map, so that a number never means two decisions.
    pub async fn insert_semantics(
        &self,
        new: &NewSemanticsRow,
        now: Timestamp,
    ) -> Result<Option<Result<SemanticsRecord, u64>>, StoreError> {
        let mut transaction = self.write().await?;
        let row = sqlx::query(
            "SELECT analysis, \
                 (SELECT coalesce(max(version), 0) FROM semantics_versions WHERE analysis = maps.analysis) AS in_force, \
                 (SELECT coalesce(max(version), 0) FROM semantics_versions WHERE map = maps.id) AS newest \
             FROM maps WHERE id = $1",
        )
        .bind(new.map.to_string())
        .fetch_optional(&mut *transaction)
        .await?;
        let Some(row) = row else { return Ok(None) };
        let in_force: u64 = row.whole("in_force")?;
        if row.uuid_if("analysis")? != Some(new.analysis) || in_force != new.replaces {
            return Ok(Some(Err(in_force)));
        }
        let row = sqlx::query(
            "INSERT INTO semantics_versions (map, version, analysis, rule_set, draft, assignment, created) \
             VALUES ($1, $2, $3, $4, $5, $6, $7) RETURNING *",
        )
        .bind(new.map.to_string())
        .bind(row.try_get::<i64, _>("newest")? + 1)
        .bind(new.analysis.to_string())
        .bind(&new.rule_set)
        .bind(json(&new.draft))
        .bind(json(&new.assignment))
        .bind(now.as_microsecond())
        .fetch_one(&mut *transaction)
        .await?;
        transaction.commit().await?;
        Ok(Some(Ok(semantics_record(&row)?)))
    }

    /// All decisions on a map, newest first.
    pub async fn semantics_versions(&self, map: Uuid) -> Result<Vec<SemanticsRecord>, StoreError> {
        let rows = sqlx::query("SELECT * FROM semantics_versions WHERE map = $1 ORDER BY version DESC")
            .bind(map.to_string())
            .fetch_all(&self.readers)
            .await?;
        rows.iter().map(semantics_record).collect()
    }
}
