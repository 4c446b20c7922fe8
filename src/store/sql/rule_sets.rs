//! Rows of rule sets.

use async_trait::async_trait;
use stillage_core::semantics::RuleSetDraft;

use super::rows::{json, rule_set_record};
use super::statement::query;
use super::store::SqlStore;
use crate::records::{RuleSetRecord, Tenant};
use crate::store::{RuleSets, StoreError};

#[async_trait]
impl RuleSets for SqlStore {
    async fn rule_sets(&self, tenant: &Tenant) -> Result<Vec<RuleSetRecord>, StoreError> {
        let rows = query("SELECT * FROM rule_sets WHERE tenant = $1 ORDER BY id")
            .bind(tenant.as_str())
            .fetch_all(&self.database)
            .await?;
        rows.iter().map(rule_set_record).collect()
    }

    async fn rule_set(&self, tenant: &Tenant, id: &str) -> Result<Option<RuleSetRecord>, StoreError> {
        let row = query("SELECT * FROM rule_sets WHERE tenant = $1 AND id = $2").bind(tenant.as_str()).bind(id);
        row.fetch_optional(&self.database).await?.as_ref().map(rule_set_record).transpose()
    }

    async fn create_rule_set(
        &self,
        tenant: &Tenant,
        id: &str,
        draft: &RuleSetDraft,
    ) -> Result<Option<RuleSetRecord>, StoreError> {
        let mut transaction = self.database.write().await?;
        let row = query(
            "INSERT INTO rule_sets (tenant, id, draft, version) VALUES ($1, $2, $3, 1) \
             ON CONFLICT (tenant, id) DO NOTHING RETURNING *",
        )
        .bind(tenant.as_str())
        .bind(id)
        .bind(json(draft))
        .fetch_optional(&mut transaction)
        .await?;
        transaction.commit().await?;
        row.as_ref().map(rule_set_record).transpose()
    }

    async fn put_rule_set(
        &self,
        tenant: &Tenant,
        id: &str,
        draft: &RuleSetDraft,
        version: u64,
    ) -> Result<Option<Result<RuleSetRecord, u64>>, StoreError> {
        let mut transaction = self.database.write().await?;
        transaction.alone_on(&format!("rule set {} {id}", tenant.as_str())).await?;
        let row = query("SELECT version FROM rule_sets WHERE tenant = $1 AND id = $2").bind(tenant.as_str()).bind(id);
        let Some(row) = row.fetch_optional(&mut transaction).await? else { return Ok(None) };
        let current: u64 = row.whole("version")?;
        if current != version {
            return Ok(Some(Err(current)));
        }
        let row =
            query("UPDATE rule_sets SET draft = $3, version = version + 1 WHERE tenant = $1 AND id = $2 RETURNING *")
                .bind(tenant.as_str())
                .bind(id)
                .bind(json(draft))
                .fetch_one(&mut transaction)
                .await?;
        transaction.commit().await?;
        Ok(Some(Ok(rule_set_record(&row)?)))
    }

    async fn delete_rule_set(
        &self,
        tenant: &Tenant,
        id: &str,
        version: u64,
    ) -> Result<Option<Result<(), u64>>, StoreError> {
        let mut transaction = self.database.write().await?;
        transaction.alone_on(&format!("rule set {} {id}", tenant.as_str())).await?;
        let row = query("SELECT version FROM rule_sets WHERE tenant = $1 AND id = $2").bind(tenant.as_str()).bind(id);
        let Some(row) = row.fetch_optional(&mut transaction).await? else { return Ok(None) };
        let current: u64 = row.whole("version")?;
        if current != version {
            return Ok(Some(Err(current)));
        }
        query("DELETE FROM rule_sets WHERE tenant = $1 AND id = $2")
            .bind(tenant.as_str())
            .bind(id)
            .execute(&mut transaction)
            .await?;
        transaction.commit().await?;
        Ok(Some(Ok(())))
    }
}
