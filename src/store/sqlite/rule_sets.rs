//! Rule sets that people wrote. The built-in ones are not stored.

use stillage_core::semantics::RuleSetDraft;

use super::rows::{Columns, json, rule_set_record};
use super::{Store, StoreError};
use crate::records::RuleSetRecord;

impl Store {
    /// All stored rule sets, by id.
    pub async fn rule_sets(&self) -> Result<Vec<RuleSetRecord>, StoreError> {
        let rows = sqlx::query("SELECT * FROM rule_sets ORDER BY id").fetch_all(&self.readers).await?;
        rows.iter().map(rule_set_record).collect()
    }

    /// A stored rule set.
    pub async fn rule_set(&self, id: &str) -> Result<Option<RuleSetRecord>, StoreError> {
        let row = sqlx::query("SELECT * FROM rule_sets WHERE id = $1").bind(id);
        row.fetch_optional(&self.readers).await?.as_ref().map(rule_set_record).transpose()
    }

    /// Stores a new rule set; `None` when the id is in use.
    pub async fn create_rule_set(&self, id: &str, draft: &RuleSetDraft) -> Result<Option<RuleSetRecord>, StoreError> {
        let mut transaction = self.write().await?;
        let row = sqlx::query(
            "INSERT INTO rule_sets (id, draft, version) VALUES ($1, $2, 1) ON CONFLICT (id) DO NOTHING RETURNING *",
        )
        .bind(id)
        .bind(json(draft))
        .fetch_optional(&mut *transaction)
        .await?;
        transaction.commit().await?;
        row.as_ref().map(rule_set_record).transpose()
    }

    /// Replaces a rule set that is at a version; `Err` with the version it is at when that is another one, `None` when
    /// there is none.
    pub async fn put_rule_set(
        &self,
        id: &str,
        draft: &RuleSetDraft,
        version: u64,
    ) -> Result<Option<Result<RuleSetRecord, u64>>, StoreError> {
        let mut transaction = self.write().await?;
        let row = sqlx::query("SELECT version FROM rule_sets WHERE id = $1").bind(id);
        let Some(row) = row.fetch_optional(&mut *transaction).await? else { return Ok(None) };
        let current: u64 = row.whole("version")?;
        if current != version {
            return Ok(Some(Err(current)));
        }
        let row = sqlx::query("UPDATE rule_sets SET draft = $2, version = version + 1 WHERE id = $1 RETURNING *")
            .bind(id)
            .bind(json(draft))
            .fetch_one(&mut *transaction)
            .await?;
        transaction.commit().await?;
        Ok(Some(Ok(rule_set_record(&row)?)))
    }

    /// Deletes a rule set that is at a version; `Err` with the version it is at when that is another one, `None` when
    /// there is none.
    pub async fn delete_rule_set(&self, id: &str, version: u64) -> Result<Option<Result<(), u64>>, StoreError> {
        let mut transaction = self.write().await?;
        let row = sqlx::query("SELECT version FROM rule_sets WHERE id = $1").bind(id);
        let Some(row) = row.fetch_optional(&mut *transaction).await? else { return Ok(None) };
        let current: u64 = row.whole("version")?;
        if current != version {
            return Ok(Some(Err(current)));
        }
        sqlx::query("DELETE FROM rule_sets WHERE id = $1").bind(id).execute(&mut *transaction).await?;
        transaction.commit().await?;
        Ok(Some(Ok(())))
    }
}
