//! Rule sets that people wrote. The built-in ones are not stored.

use async_trait::async_trait;
use stillage_core::semantics::RuleSetDraft;

use super::StoreError;
use crate::records::{RuleSetRecord, Tenant};

/// What is kept of rule sets. Two tenants may use the same id for different ones.
#[async_trait]
pub trait RuleSets {
    /// All stored rule sets, by id.
    async fn rule_sets(&self, tenant: &Tenant) -> Result<Vec<RuleSetRecord>, StoreError>;

    /// A stored rule set.
    async fn rule_set(&self, tenant: &Tenant, id: &str) -> Result<Option<RuleSetRecord>, StoreError>;

    /// Stores a new rule set; `None` when the id is in use.
    async fn create_rule_set(
        &self,
        tenant: &Tenant,
        id: &str,
        draft: &RuleSetDraft,
    ) -> Result<Option<RuleSetRecord>, StoreError>;

    /// Replaces a rule set that is at a version; `Err` with the version it is at when that is another one, `None` when
    /// there is none.
    async fn put_rule_set(
        &self,
        tenant: &Tenant,
        id: &str,
        draft: &RuleSetDraft,
        version: u64,
    ) -> Result<Option<Result<RuleSetRecord, u64>>, StoreError>;

    /// Deletes a rule set that is at a version; `Err` with the version it is at when that is another one, `None` when
    /// there is none.
    async fn delete_rule_set(
        &self,
        tenant: &Tenant,
        id: &str,
        version: u64,
    ) -> Result<Option<Result<(), u64>>, StoreError>;
}
