//! Human decisions: immutable versions, each bound to the analysis whose categories it names.

use async_trait::async_trait;
use jiff::Timestamp;
use stillage_core::layout::LayoutOptions;
use stillage_core::semantics::{Assignment, RuleSetDraft};
use uuid::Uuid;

use super::StoreError;
use crate::records::{CarryRecord, SemanticsOrigin, SemanticsRecord, Tenant};

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
    /// How locations are cut and numbered.
    pub layout: LayoutOptions,
    /// Suggested where a person went back to the suggestion.
    pub origin: SemanticsOrigin,
    /// What was carried over, where the origin says so.
    pub carried: Option<CarryRecord>,
}

impl NewSemanticsRow {
    /// The decision as if it were stored, in place of the version that it replaces.
    #[must_use]
    pub fn unsaved(self, created: Timestamp) -> SemanticsRecord {
        let Self { map: _, analysis, replaces: version, rule_set, draft, assignment, layout, origin, carried } = self;
        SemanticsRecord { analysis, rule_set, draft, assignment, layout, version, origin, carried, created }
    }
}

/// What is kept of human decisions.
#[async_trait]
pub trait SemanticsVersions {
    /// Stores a decision, when the analysis and the version it was made on are still in force; otherwise `Err` with the
    /// version in force, and `None` when the map is gone.
    ///
    /// Versions count on over all analyses of a map, so that a number never means two decisions. The record versions of
    /// later maps of the site are raised: without a decision of their own they have its layout.
    async fn insert_semantics(
        &self,
        tenant: &Tenant,
        new: &NewSemanticsRow,
        now: Timestamp,
    ) -> Result<Option<Result<SemanticsRecord, u64>>, StoreError>;

    /// All decisions on a map, newest first; none when there is no such map.
    async fn semantics_versions(&self, tenant: &Tenant, map: Uuid) -> Result<Vec<SemanticsRecord>, StoreError>;
}
