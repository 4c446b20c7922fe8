//! What people corrected about a map: drawn, cut, merged, erased, labelled, named.
//!
//! Corrections are a list in the versions of the semantics. A change of it makes a version like any other decision: the new
//! arrangement is made first, so that a correction that does not fit is refused. Those that fitted when they were made and
//! no longer do, after a change of others or on another analysis, stay in the list and say why.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use stillage_core::arrangement::FaceId;
use stillage_core::corrections::{Correction, CorrectionProblem, Outcome};
use stillage_core::excerpt;
use stillage_core::semantics::RuleSet;
use uuid::Uuid;

use super::carrying::{DecisionGround, carried_overrides};
use super::error::FieldProblem;
use super::geometric_level::{AppliedCorrections, GeometricLevel};
use super::{App, AppError, Caller, CorrectionId, MapContext, SemanticsChange, SemanticsRecord, WantedCorrection};
use crate::records::LostDecision;

/// Problems that are told at most.
const MOST_TOLD: usize = 100;

/// What may be in a list of corrections.
#[derive(Debug, Clone, Copy)]
pub(super) struct CorrectionLimits {
    /// Corrections.
    pub(super) corrections: usize,
    /// Faces that one of them may make.
    pub(super) faces: usize,
}

impl MapContext {
    /// The corrections in their order, with their ids and what became of them.
    pub fn listed_corrections(&self) -> impl Iterator<Item = (CorrectionId, &Correction, &Outcome)> {
        let AppliedCorrections { list, outcomes, .. } = &*self.corrections;
        self.correction_ids.iter().zip(list).zip(outcomes).map(|((&id, correction), outcome)| (id, correction, outcome))
    }

    /// The list as it is, to be changed.
    #[must_use]
    pub fn wanted_corrections(&self) -> Vec<WantedCorrection> {
        self.listed_corrections().map(|(id, correction, _)| (Some(id), correction.clone())).collect()
    }
}

impl App {
    /// Puts another list of corrections in force, as a new version; needs `if_match`, the version in force. Answers the map
    /// as it is then, and the labels of single faces that were lost because their ground is cut otherwise.
    pub async fn change_corrections(
        &self,
        caller: &Caller,
        map: Uuid,
        wanted: Vec<WantedCorrection>,
        if_match: Option<u64>,
    ) -> Result<(Arc<MapContext>, Vec<LostDecision>), AppError> {
        let change = SemanticsChange { corrections: Some(wanted), ..SemanticsChange::default() };
        let (_, lost) = self.change_semantics(caller, map, change, if_match).await?;
        Ok((self.context(caller, map).await?, lost))
    }

    /// The ids and corrections of a version of the semantics.
    pub(super) async fn corrections_of(
        &self,
        caller: &Caller,
        map: Uuid,
        version: Option<&SemanticsRecord>,
    ) -> Result<(Vec<CorrectionId>, Vec<Correction>), AppError> {
        let Some(list) = version.and_then(|version| version.corrections) else { return Ok((Vec::new(), Vec::new())) };
        let records = self.store.corrections(caller.tenant(), map, list).await?;
        let records = records.ok_or_else(|| AppError::not_found("map", map))?;
        Ok(records.into_iter().map(|record| (record.id, record.correction)).unzip())
    }

    /// The limits on lists of corrections.
    pub(super) const fn correction_limits(&self) -> CorrectionLimits {
        CorrectionLimits { corrections: self.config.max_corrections, faces: self.config.max_correction_faces }
    }
}

/// A map under a list of corrections that it has not yet.
#[derive(Debug)]
pub(super) struct Correcting {
    /// The arrangement.
    pub(super) level: GeometricLevel,
    /// The labels of single faces there.
    pub(super) overrides: BTreeMap<u32, String>,
    /// Those that were lost.
    pub(super) lost: Vec<LostDecision>,
}

/// Corrects a map by a list, and carries the labels of single faces to the new arrangement. Where a new correction gives a
/// face a label, that one holds.
///
/// # Errors
/// What is wrong with new corrections, `/corrections/...`; also that they do not fit onto the map, unless `is_tried` only.
pub(super) fn correct(
    on: &MapContext,
    rule_set: &RuleSet,
    wanted: &[WantedCorrection],
    overrides: &BTreeMap<u32, String>,
    limits: CorrectionLimits,
    is_tried: bool,
) -> Result<Correcting, AppError> {
    let is_new = new_corrections(on, wanted, limits.corrections)?;
    let new = || wanted.iter().enumerate().filter(|&(index, _)| is_new[index]);
    check_corrections(new().map(|(index, (_, correction))| (index, correction)), rule_set, limits.faces)?;
    let before = on.geometric_level();
    let level = before.clone().corrected(wanted.iter().map(|(_, correction)| correction.clone()).collect());
    let outcomes = &level.corrections.outcomes;
    if !is_tried {
        refuse(new().filter_map(|(index, _)| match &outcomes[index] {
            Outcome::Unfit(problem) => Some((index, problem.clone())),
            Outcome::Applied { .. } => None,
        }))?;
    }
    let (mut carried, lost) = carried_overrides(&DecisionGround::same_map(&before), rule_set, overrides, &level);
    let labelled_anew: BTreeSet<FaceId> = new()
        .filter(|(_, (_, correction))| correction.label().is_some())
        .filter_map(|(index, _)| match &outcomes[index] {
            Outcome::Applied { faces } => Some(faces),
            Outcome::Unfit(_) => None,
        })
        .flatten()
        .copied()
        .filter(|face| level.corrections.labels.contains_key(face))
        .collect();
    carried.retain(|&face, _| !labelled_anew.contains(&FaceId(face)));
    Ok(Correcting { level, overrides: carried, lost })
}

/// Refuses corrections that make no sense on any map, by their numbers in a list; each may make `most_faces`.
///
/// # Errors
/// What is wrong with them, `/corrections/...`.
pub fn check_corrections<'a>(
    corrections: impl Iterator<Item = (usize, &'a Correction)>,
    rule_set: &RuleSet,
    most_faces: usize,
) -> Result<(), AppError> {
    let check = |correction: &Correction| -> Result<(), CorrectionProblem> {
        correction.check(most_faces)?;
        check_label(correction, rule_set)
    };
    refuse(corrections.filter_map(|(index, correction)| Some((index, check(correction).err()?))))
}

/// Which corrections of a list are new or say something else than before.
fn new_corrections(on: &MapContext, wanted: &[WantedCorrection], most: usize) -> Result<Vec<bool>, AppError> {
    if wanted.len() > most {
        let detail = format!("a map has at most {most} corrections, and these would be {}", wanted.len());
        return Err(AppError::invalid("/corrections", detail));
    }
    let known: BTreeMap<CorrectionId, &Correction> =
        on.listed_corrections().map(|(id, correction, _)| (id, correction)).collect();
    let mut seen = BTreeSet::new();
    let is_new = |(index, (id, correction)): (usize, &WantedCorrection)| {
        let Some(id) = id else { return Ok(true) };
        let wrong = |detail: String| AppError::invalid(&format!("/corrections/{index}/id"), detail);
        if !seen.insert(*id) {
            return Err(wrong(format!("{id} is named twice")));
        }
        let before = known
            .get(id)
            .ok_or_else(|| wrong(format!("there is no correction {id}: leave out the id of a new one")))?;
        Ok(*before != correction)
    };
    wanted.iter().enumerate().map(is_new).collect()
}

/// Refuses the labels of corrections that a rule set has not.
pub(super) fn check_labels(corrections: &AppliedCorrections, rule_set: &RuleSet) -> Result<(), AppError> {
    let missing = |correction: &&Correction| check_label(correction, rule_set).is_err();
    let Some(correction) = corrections.list.iter().find(missing) else { return Ok(()) };
    let detail = format!(
        "it has no label {}, which a correction gives: change the corrections first",
        correction.label().unwrap_or_default()
    );
    Err(AppError::invalid("/ruleSet", detail))
}

fn check_label(correction: &Correction, rule_set: &RuleSet) -> Result<(), CorrectionProblem> {
    let Some(label) = correction.label().filter(|label| rule_set.find(label).is_none()) else { return Ok(()) };
    let known: Vec<&str> = rule_set.labels().iter().map(|label| label.id.as_str()).collect();
    let label = excerpt(label);
    let message = format!("the rule set has no label {label:?}: it has {}", known.join(", "));
    Err(CorrectionProblem { pointer: "/label".to_owned(), message })
}

/// All problems as one refusal, if there are any.
fn refuse(problems: impl Iterator<Item = (usize, CorrectionProblem)>) -> Result<(), AppError> {
    let field = |(index, problem): (usize, CorrectionProblem)| FieldProblem {
        pointer: format!("/corrections/{index}{}", problem.pointer),
        detail: problem.message,
    };
    let fields: Vec<FieldProblem> = problems.take(MOST_TOLD).map(field).collect();
    let detail = match fields.as_slice() {
        [] => return Ok(()),
        [field] => field.detail.clone(),
        _ => "some corrections cannot be applied: nothing was changed".to_owned(),
    };
    Err(AppError::Invalid { detail, fields })
}
