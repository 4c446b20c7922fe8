//! The labels that people gave to another analysis of a map, carried over to the one in force.
//!
//! That happens when the first question about the map is asked after the other analysis came into force, and makes a version
//! that says what it was carried from, and what was lost. It is carried anew when the decision behind it changed, as long
//! as nobody decided on the analysis in force itself.

use std::sync::Arc;

use stillage_core::arrangement::CellFaces;
use stillage_core::semantics::{self, AnalysisGround, Assignment, CarriedLabels, LostLabel, RuleSet};
use stillage_core::{Analysis, OccupancyGrid};
use uuid::Uuid;

use super::context::{GeometricLevel, read_rule_set};
use super::{App, AppError, Caller, MapContext, SemanticsOrigin, SemanticsRecord};
use crate::blocking::off_the_runtime;
use crate::records::{CarryRecord, LostDecision};
use crate::store::{BlobId, NewSemanticsRow, StoreError, now};

/// Whether a decision that a person made on another analysis is to be carried over to the one with this id, on which
/// `in_force` is the newest version.
fn is_to_be_carried(before: &SemanticsRecord, analysis: Uuid, in_force: Option<&SemanticsRecord>) -> bool {
    before.analysis != analysis
        && match in_force {
            // Where nobody decided, the new suggestion stands.
            None => before.origin != SemanticsOrigin::Suggested,
            Some(version) => version.carried.as_ref().is_some_and(|carried| carried.from != before.version),
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
        let earlier = match self.earlier_analysis(known, &blob, &geometry.grid).await {
            Ok(earlier) => earlier,
            Err(error) if error.is_transient() => return Err(error.into()),
            Err(error) => {
                tracing::warn!(%map, %error, "labels could not be carried over from an earlier analysis");
                return Ok(in_force);
            }
        };
        let (rule_set, new, decision) = (read_rule_set(&before.draft)?, geometry.clone(), before.assignment);
        let carry = move || carried(&earlier, &rule_set, &decision, before.version, &new);
        let (assignment, carried) = off_the_runtime(carry).await;
        let row = NewSemanticsRow {
            map,
            analysis,
            replaces: in_force.map_or(0, |version| version.version),
            rule_set: before.rule_set,
            draft: before.draft,
            assignment,
            layout: before.layout,
            origin: SemanticsOrigin::Carried,
            carried: Some(carried),
        };
        let made = now();
        match self.store.insert_semantics(caller.tenant(), &row, made).await {
            Ok(Some(Ok(record))) => Ok(Some(record)),
            Ok(None) => Err(AppError::not_found("map", map)),
            // Somebody decided in between, which the next question sees; or the disk is full, and reading goes on.
            Ok(Some(Err(_))) | Err(StoreError::NoSpace) => Ok(Some(row.unsaved(made))),
            Err(error) => Err(error.into()),
        }
    }

    /// The analysis whose labels are carried over: from memory, or from its blob.
    async fn earlier_analysis(
        &self,
        known: Option<Arc<MapContext>>,
        blob: &BlobId,
        grid: &Arc<OccupancyGrid>,
    ) -> Result<EarlierAnalysis, StoreError> {
        if let Some(known) = known {
            return Ok(EarlierAnalysis::InMemory(known));
        }
        let (blob, grid) = (self.store.blobs().get(blob).await?, Arc::clone(grid));
        off_the_runtime(move || {
            let analysis: Analysis = blob.decode()?;
            let cells = CellFaces::of_grid(&analysis.subdivision, &grid);
            Ok(EarlierAnalysis::Read(Box::new(analysis), cells))
        })
        .await
    }
}

/// An analysis that was in force before.
enum EarlierAnalysis {
    InMemory(Arc<MapContext>),
    Read(Box<Analysis>, CellFaces),
}

impl EarlierAnalysis {
    fn ground(&self) -> AnalysisGround<'_> {
        match self {
            Self::InMemory(known) => AnalysisGround { analysis: &known.analysis, cells: &known.cells.faces },
            Self::Read(analysis, cells) => AnalysisGround { analysis, cells },
        }
    }
}

/// Carries the decision of version `from` over to a new analysis.
fn carried(
    earlier: &EarlierAnalysis,
    rule_set: &RuleSet,
    decision: &Assignment,
    from: u64,
    new: &GeometricLevel,
) -> (Assignment, CarryRecord) {
    let ground = AnalysisGround { analysis: &new.analysis, cells: &new.cells.faces };
    let CarriedLabels { assignment, kept, lost } = semantics::carry(earlier.ground(), decision, ground, rule_set);
    let decision = |LostLabel { subject, label, at }| {
        let at = new.analysis.frame.to_map(at);
        LostDecision { subject, label, at: [at.x, at.y] }
    };
    (assignment, CarryRecord { from, kept, lost: lost.into_iter().map(decision).collect() })
}
