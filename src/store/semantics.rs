//! Human decisions: immutable versions, each bound to the analysis whose categories it names.

use async_trait::async_trait;
use jiff::Timestamp;
use stillage_core::corrections::Correction;
use stillage_core::layout::LayoutOptions;
use stillage_core::semantics::{Assignment, RuleSetDraft};
use uuid::Uuid;

use super::StoreError;
use crate::records::{
    CarryRecord, CorrectionId, CorrectionList, CorrectionRecord, SemanticsOrigin, SemanticsRecord, Tenant,
};

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
    /// The corrections of the map.
    pub corrections: NewCorrections,
    /// Suggested where a person went back to the suggestion.
    pub origin: SemanticsOrigin,
    /// What was carried over, where the origin says so.
    pub carried: Option<CarryRecord>,
    /// The version that it restores.
    pub restores: Option<u64>,
}

/// The corrections of a decision to be stored.
#[derive(Debug, Clone, PartialEq)]
pub enum NewCorrections {
    /// Those of a version before, or none.
    Stored(Option<CorrectionList>),
    /// Others, in their order. Those without an id are new.
    Changed(Vec<(Option<CorrectionId>, Correction)>),
}

impl NewSemanticsRow {
    /// The decision as if it were stored, in place of the version that it replaces. It names no list of corrections where
    /// these changed.
    #[must_use]
    pub fn unsaved(self, created: Timestamp) -> SemanticsRecord {
        SemanticsRecord {
            analysis: self.analysis,
            rule_set: self.rule_set,
            draft: self.draft,
            assignment: self.assignment,
            layout: self.layout,
            corrections: match self.corrections {
                NewCorrections::Stored(list) => list,
                NewCorrections::Changed(_) => None,
            },
            version: self.replaces,
            origin: self.origin,
            carried: self.carried,
            restores: self.restores,
            created,
        }
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

    /// All decisions on a map, newest first; none when there is no such map. The corrections are lists to be read.
    async fn semantics_versions(&self, tenant: &Tenant, map: Uuid) -> Result<Vec<SemanticsRecord>, StoreError>;

    /// The corrections of a list, in their order; `None` when the map has no such list.
    async fn corrections(
        &self,
        tenant: &Tenant,
        map: Uuid,
        list: CorrectionList,
    ) -> Result<Option<Vec<CorrectionRecord>>, StoreError>;

    /// The newest decision on a map that was made before a time.
    async fn semantics_before(
        &self,
        tenant: &Tenant,
        map: Uuid,
        time: Timestamp,
    ) -> Result<Option<SemanticsRecord>, StoreError>;

    /// How the locations of a map were cut and numbered before a version was made on it, or first.
    async fn layout_before(&self, tenant: &Tenant, map: Uuid, version: u64) -> Result<LayoutOptions, StoreError>;
}
