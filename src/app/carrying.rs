//! What people decided on another analysis of a map, carried over to the analysis in force (from an earlier map of its site:
//! `site_carrying`).
//!
//! That happens when the first question about the map is asked after the analysis came into force, and makes a version that
//! says what it was carried from, and what was lost. Corrections come along as they are and are applied anew. Labels are
//! carried by their ground, from one corrected arrangement to the other. What was decided on another analysis is carried anew
//! when it changed, as long as nobody decided on the analysis in force itself.

use std::collections::BTreeMap;
use std::sync::Arc;

use stillage_core::arrangement::FaceId;
use stillage_core::geometry::RigidMotion;
use stillage_core::semantics::{self, AnalysisGround, Assignment, CarriedLabels, LostLabel, RuleSet};
use uuid::Uuid;

use super::context::read_rule_set;
use super::geometric_level::GeometricLevel;
use super::{App, AppError, Caller, MapContext, SemanticsOrigin, SemanticsRecord};
use crate::blocking::off_the_runtime;
use crate::records::{CarryRecord, LostDecision};
use crate::store::{BlobId, NewCorrections, NewSemanticsRow, StoreError, now};

/// Whether a decision that a person made on another analysis is to be carried over to the one with this id, on which
/// `in_force` is the newest version.
pub(super) fn is_to_be_carried(before: &SemanticsRecord, analysis: Uuid, in_force: Option<&SemanticsRecord>) -> bool {
    before.analysis != analysis
        && match in_force {
            // Where nobody decided, the new suggestion stands.
            None => before.origin != SemanticsOrigin::Suggested,
            Some(version) => {
                let is_other = |carried: &CarryRecord| carried.map.is_some() || carried.from != before.version;
                version.carried.as_ref().is_some_and(is_other)
            }
        }
}

impl App {
    /// Carries a decision `before` to an analysis (`onto`: its map and its id), where it is to be, and stores it as the newest
    /// version. What is in force stays where the other analysis cannot be read. `previous` is what is known of the map
    /// already.
    pub(super) async fn carry(
        &self,
        caller: &Caller,
        onto: (Uuid, Uuid),
        geometry: &GeometricLevel,
        (before, blob): (SemanticsRecord, BlobId),
        in_force: Option<SemanticsRecord>,
        previous: Option<Arc<MapContext>>,
    ) -> Result<Option<SemanticsRecord>, AppError> {
        let (map, analysis) = onto;
        if !is_to_be_carried(&before, analysis, in_force.as_ref()) {
            return Ok(in_force);
        }
        let known = previous.filter(|known| known.analysis_id == before.analysis);
        let earlier = match self.earlier_analysis(known, &blob, geometry).await {
            Ok(earlier) => earlier,
            Err(error) if error.is_transient() => return Err(error.into()),
            Err(error) => {
                tracing::warn!(%map, %error, "labels could not be carried over from an earlier analysis");
                return Ok(in_force);
            }
        };
        let replaces = in_force.map_or(0, |version| version.version);
        let (row, level) = self.carried_row(caller, onto, geometry, (before, earlier), replaces).await?;
        self.last_corrected.keep(analysis, level);
        self.carry_row(caller, row).await.map(Some)
    }

    /// The version that a decision `before`, on an `earlier` analysis, becomes on another one (`onto`: its map and its id), and
    /// that one under the corrections.
    pub(super) async fn carried_row(
        &self,
        caller: &Caller,
        (map, analysis): (Uuid, Uuid),
        geometry: &GeometricLevel,
        (before, earlier): (SemanticsRecord, GeometricLevel),
        replaces: u64,
    ) -> Result<(NewSemanticsRow, GeometricLevel), AppError> {
        let (_, corrections) = self.corrections_of(caller, map, Some(&before)).await?;
        let (rule_set, new, decision) = (read_rule_set(&before.draft)?, geometry.clone(), before.assignment);
        let carry = move || {
            let (earlier, new) = (earlier.corrected(corrections.clone()), new.corrected(corrections));
            (carried(&DecisionGround::same_map(&earlier), &rule_set, &decision, before.version, &new), new)
        };
        let ((assignment, carried), level) = off_the_runtime(carry).await;
        let row = NewSemanticsRow {
            map,
            analysis,
            replaces,
            rule_set: before.rule_set,
            draft: before.draft,
            assignment,
            layout: before.layout,
            corrections: NewCorrections::Stored(before.corrections),
            origin: SemanticsOrigin::Carried,
            carried: Some(carried),
            restores: None,
        };
        Ok((row, level))
    }

    /// Stores what was carried over.
    pub(super) async fn carry_row(&self, caller: &Caller, row: NewSemanticsRow) -> Result<SemanticsRecord, AppError> {
        let made = now();
        match self.store.insert_semantics(caller.tenant(), &row, made).await {
            Ok(Some(Ok(record))) => Ok(record),
            Ok(None) => Err(AppError::not_found("map", row.map)),
            // Somebody decided in between, which the next question sees; or the disk is full, and reading goes on.
            Ok(Some(Err(_))) | Err(StoreError::NoSpace) => Ok(row.unsaved(made)),
            Err(error) => Err(error.into()),
        }
    }

    /// The analysis whose labels are carried over: from memory, or from its blob.
    pub(super) async fn earlier_analysis(
        &self,
        known: Option<Arc<MapContext>>,
        blob: &BlobId,
        geometry: &GeometricLevel,
    ) -> Result<GeometricLevel, StoreError> {
        if let Some(known) = known {
            return Ok(known.geometric_level());
        }
        let (blob, same_cells) = (self.store.blobs().get(blob).await?, geometry.clone());
        off_the_runtime(move || Ok(same_cells.with_analysis(blob.decode()?))).await
    }
}

/// Where a decision that is carried over comes from.
pub(super) struct DecisionGround<'a> {
    /// The analysis that it was made on, by the cells of the map that it is carried to.
    pub(super) ground: AnalysisGround<'a>,
    /// From the grid frame of the analysis to the map frame of that map.
    pub(super) to_map: RigidMotion,
}

impl<'a> DecisionGround<'a> {
    /// An analysis of the same map.
    pub(super) fn same_map(level: &'a GeometricLevel) -> Self {
        Self { ground: level.ground(), to_map: level.analysis.frame.motion() }
    }
}

/// Carries the decision of version `from` over to a new analysis. A face that a correction labels has that label, unless a
/// person gave it one of its own.
pub(super) fn carried(
    earlier: &DecisionGround<'_>,
    rule_set: &RuleSet,
    decision: &Assignment,
    from: u64,
    new: &GeometricLevel,
) -> (Assignment, CarryRecord) {
    let CarriedLabels { mut assignment, kept, lost } =
        semantics::carry(earlier.ground, decision, new.ground(), rule_set);
    if !new.corrections.labels.is_empty() {
        let (own, _) = carried_overrides(earlier, rule_set, &decision.overrides, new);
        let is_labelled = |face: u32| new.corrections.labels.contains_key(&FaceId(face));
        assignment.overrides.retain(|&face, _| !is_labelled(face) || own.contains_key(&face));
    }
    (assignment, CarryRecord { map: None, from, kept, lost: told(lost, &earlier.to_map) })
}

/// The labels that people gave to single faces of one arrangement, on those of another, and what was lost.
pub(super) fn carried_overrides(
    earlier: &DecisionGround<'_>,
    rule_set: &RuleSet,
    overrides: &BTreeMap<u32, String>,
    new: &GeometricLevel,
) -> (BTreeMap<u32, String>, Vec<LostDecision>) {
    if overrides.is_empty() {
        return (BTreeMap::new(), Vec::new());
    }
    // As if nobody had decided on a category.
    let suggested = Assignment::suggested(&semantics::suggest(earlier.ground.analysis, rule_set), rule_set);
    let decision = Assignment { overrides: overrides.clone(), ..suggested };
    let carried = semantics::carry(earlier.ground, &decision, new.ground(), rule_set);
    (carried.assignment.overrides, told(carried.lost, &earlier.to_map))
}

/// Lost labels, told where they are in the map frame.
fn told(lost: Vec<LostLabel>, to_map: &RigidMotion) -> Vec<LostDecision> {
    let decision = |LostLabel { subject, label, at }| {
        let at = to_map.apply(at);
        LostDecision { subject, label, at: [at.x, at.y] }
    };
    lost.into_iter().map(decision).collect()
}
