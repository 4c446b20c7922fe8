//! What people decided on an earlier map of a site, carried over to the first analysis of a map that was aligned to it.
//!
//! That happens when the first question about the map is asked, and makes its first version. Corrections are moved by how the
//! two maps lie on one another, and applied anew. Labels are carried by their ground: the new map looks up its cells in the
//! corrected arrangement of the earlier one. What was decided on ground that the new map does not show, or shows as something
//! else, is lost and told.

use stillage_core::corrections::{Correction, Outcome};
use stillage_core::geometry::RigidMotion;
use stillage_core::layout::LayoutOptions;
use stillage_core::semantics::{self, AnalysisGround, Assignment, RuleSet};
use uuid::Uuid;

use super::carrying::{DecisionGround, carried};
use super::context::read_rule_set;
use super::geometric_level::GeometricLevel;
use super::{App, AppError, Caller, MapRecord, SemanticsOrigin, SemanticsRecord};
use crate::blocking::off_the_runtime;
use crate::records::CarryRecord;
use crate::store::{NewCorrections, NewSemanticsRow};

impl App {
    /// Carries what people decided on the map of the site before one to its first analysis, and stores it as the first
    /// version. That counts which the earlier map had when the other one was uploaded: what came later says nothing of it.
    pub(super) async fn carry_from_site(
        &self,
        caller: &Caller,
        record: &MapRecord,
        analysis: Uuid,
        geometry: &GeometricLevel,
        layout: &LayoutOptions,
    ) -> Result<Option<SemanticsRecord>, AppError> {
        let Some((earlier, decided)) = self.decided_on_site(caller, record).await? else { return Ok(None) };
        let (_, corrections) = self.corrections_of(caller, earlier.id, Some(&decided)).await?;
        if corrections.is_empty() && decided.origin == SemanticsOrigin::Suggested {
            return Ok(None);
        }
        let motion = earlier.to_site().then(&record.to_site().inverse());
        let (rule_set, new) = (read_rule_set(&decided.draft)?, geometry.clone());
        let level = match self.geometry_decided_on(caller, &earlier, decided.analysis).await {
            Ok(level) => Some(level),
            Err(error) if error.is_transient() => return Err(error),
            Err(error) => {
                tracing::warn!(map = %record.id, %error, "labels could not be carried over from an earlier map of the site");
                None
            }
        };
        let (decision, from) = (decided.assignment, decided.version);
        let carry = move || {
            let moved = corrections.iter().map(|correction| correction.clone().moved(&motion)).collect();
            let new = new.corrected(moved);
            let (assignment, carried) = match level {
                Some(level) => {
                    onto_later_map(&level.corrected(corrections), &motion, &rule_set, (&decision, from), &new)
                }
                None => (suggested(&new, &rule_set), CarryRecord { map: None, from, kept: 0, lost: Vec::new() }),
            };
            (new, assignment, carried)
        };
        let (level, assignment, carried) = off_the_runtime(carry).await;
        let fits = |outcome: &&Outcome| matches!(outcome, Outcome::Applied { .. });
        let fitting = level.corrections.outcomes.iter().filter(fits).count();
        let new: Vec<(_, Correction)> = level.corrections.list.iter().map(|moved| (None, moved.clone())).collect();
        self.last_corrected.keep(analysis, level);
        let row = NewSemanticsRow {
            map: record.id,
            analysis,
            replaces: 0,
            rule_set: decided.rule_set,
            draft: decided.draft,
            assignment,
            layout: layout.clone(),
            corrections: NewCorrections::Changed(new),
            origin: SemanticsOrigin::Carried,
            carried: Some(CarryRecord { map: Some(earlier.id), kept: carried.kept + fitting, ..carried }),
            restores: None,
        };
        self.carry_row(caller, row).await.map(Some)
    }

    /// The newest of the maps that a map was aligned to, one on the other, on which people had decided when the map was
    /// uploaded, and what.
    async fn decided_on_site(
        &self,
        caller: &Caller,
        record: &MapRecord,
    ) -> Result<Option<(MapRecord, SemanticsRecord)>, AppError> {
        let mut alignment = record.alignment;
        while let Some(previous) = alignment.map(|alignment| alignment.previous) {
            let Some(earlier) = self.store.map(caller.tenant(), previous).await? else { return Ok(None) };
            if let Some(decided) = self.store.semantics_before(caller.tenant(), previous, record.created).await? {
                return Ok(Some((earlier, decided)));
            }
            alignment = earlier.alignment;
        }
        Ok(None)
    }

    /// The analysis of an earlier map that a decision was made on, from the store.
    async fn geometry_decided_on(
        &self,
        caller: &Caller,
        earlier: &MapRecord,
        analysis: Uuid,
    ) -> Result<GeometricLevel, AppError> {
        let record = self.analysis(caller, earlier.id, analysis).await?;
        self.stored_geometry(caller, record).await
    }
}

/// Carries a decision and its version from an earlier map to a later one; `motion` leads from the map frame of the earlier one
/// to that of the later one.
fn onto_later_map(
    earlier: &GeometricLevel,
    motion: &RigidMotion,
    rule_set: &RuleSet,
    (decision, from): (&Assignment, u64),
    new: &GeometricLevel,
) -> (Assignment, CarryRecord) {
    let to_map = earlier.grid.frame().motion().then(motion);
    let to_earlier = new.grid.frame().motion().then(&to_map.inverse());
    let cells = earlier.cells.faces.seen_on(earlier.grid.resolution(), &new.grid, &to_earlier);
    let ground = AnalysisGround { analysis: &earlier.analysis, cells: &cells };
    carried(&DecisionGround { ground, to_map }, rule_set, decision, from, new)
}

fn suggested(level: &GeometricLevel, rule_set: &RuleSet) -> Assignment {
    Assignment::suggested(&semantics::suggest(&level.analysed, rule_set), rule_set)
}
