//! The labels that people gave to one analysis, on another analysis of the same map, or of a later map of the site.
//!
//! Each analysis counts its categories and faces anew, so that what a person decided is carried by the ground it was
//! decided on, cell by cell:
//!
//! - A person decided on a face by giving it a label of its own, or by giving its category another label than the one
//!   suggested.
//! - A category gets the label that the categories of most of its ground had, and where no label had most of it, the
//!   suggested one. Ground that is unidentified because nothing was suggested has no label.
//! - A face gets a label of its own where a person decided that most of it has this label, if its category has another one,
//!   or if the label was a face's own before.
//! - A decision is kept where most of its ground has its label again, however that is cut now; otherwise it is lost.
//!
//! Of a later map, ground is what that one shows of it. Cost: O(cells). Limits: a face smaller than a cell has no ground, so
//! that its label is lost.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::assignment::Assignment;
use super::rule_set::RuleSet;
use super::suggestion::suggest;
use crate::analysis::Analysis;
use crate::arrangement::{CellFaces, CellOverlap, FaceId};
use crate::geometry::Point;

/// An analysis with the face of every cell.
#[derive(Debug, Clone, Copy)]
pub struct AnalysisGround<'a> {
    /// The analysis.
    pub analysis: &'a Analysis,
    /// Its face at every cell of the grid that labels are carried on: its own, or that of a later map
    /// ([`CellFaces::seen_on`]).
    pub cells: &'a CellFaces,
}

/// Labels that were carried over, and what became of the decisions behind them.
#[derive(Debug, Clone, PartialEq)]
pub struct CarriedLabels {
    /// The labels of the new analysis.
    pub assignment: Assignment,
    /// Decisions whose ground has their label again.
    pub kept: usize,
    /// The others: those of categories first, ascending.
    pub lost: Vec<LostLabel>,
}

/// A decision whose ground has other labels now.
#[derive(Debug, Clone, PartialEq)]
pub struct LostLabel {
    /// What had the label.
    pub subject: LabelSubject,
    /// Id of the label.
    pub label: String,
    /// A point inside the face, or inside the largest face of the category, in the grid frame of its analysis.
    pub at: Point,
}

/// What a person gives a label to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum LabelSubject {
    /// A category.
    Category(u8),
    /// A single face.
    Face(u32),
}

/// Carries labels of `old`, as a person decided them under a rule set, to `new`: two analyses by the cells of one grid.
#[must_use]
pub fn carry(
    old: AnalysisGround<'_>,
    decision: &Assignment,
    new: AnalysisGround<'_>,
    rule_set: &RuleSet,
) -> CarriedLabels {
    let old_labels = DecidedLabels::of(old.analysis, decision, rule_set);
    let overlaps = new.cells.overlaps(old.cells);
    let assignment = category_labels(&overlaps, new.analysis, &old_labels, rule_set);
    let overrides = face_labels(&overlaps, new.analysis, &old_labels, &assignment);
    let assignment = Assignment { assignment, overrides };
    let (kept, lost) = outcome(&overlaps, new.analysis, &old_labels, &assignment);
    CarriedLabels { assignment, kept, lost }
}

/// The labels of an analysis, and which of them a person decided.
struct DecidedLabels<'a> {
    analysis: &'a Analysis,
    by_category: Vec<&'a str>,
    by_face: &'a BTreeMap<u32, String>,
    /// Whether a category has another label than the suggested one.
    is_decided: Vec<bool>,
    unidentified: &'a str,
}

impl<'a> DecidedLabels<'a> {
    fn of(analysis: &'a Analysis, decision: &'a Assignment, rule_set: &'a RuleSet) -> Self {
        let suggestions = suggest(analysis, rule_set);
        let unidentified = rule_set.label(rule_set.unidentified()).id.as_str();
        let label = |category| decision.assignment.get(&category).map_or(unidentified, String::as_str);
        let by_category: Vec<&str> = suggestions.iter().map(|suggestion| label(suggestion.category)).collect();
        let pairs = suggestions.iter().zip(&by_category);
        let is_decided = pairs.map(|(suggestion, &label)| rule_set.label(suggestion.label).id != label).collect();
        Self { analysis, by_category, by_face: &decision.overrides, is_decided, unidentified }
    }

    fn category(&self, face: FaceId) -> usize {
        usize::from(self.analysis.faces[face.index()].category)
    }

    /// The label of the category of a face, if that says anything.
    fn of_category(&self, face: FaceId) -> Option<&'a str> {
        let category = self.category(face);
        let label = self.by_category[category];
        (label != self.unidentified || self.is_decided[category]).then_some(label)
    }

    /// What a person gave this label to, of a face.
    fn decision(&self, face: FaceId) -> Option<(LabelSubject, &'a str)> {
        if face == FaceId::OUTER {
            return None;
        }
        if let Some(label) = self.by_face.get(&face.0) {
            return Some((LabelSubject::Face(face.0), label));
        }
        let category = self.category(face);
        self.is_decided[category].then(|| (LabelSubject::Category(category as u8), self.by_category[category]))
    }
}

/// The label of every category of the new analysis.
fn category_labels(
    overlaps: &[CellOverlap],
    new: &Analysis,
    old: &DecidedLabels<'_>,
    rule_set: &RuleSet,
) -> BTreeMap<u8, String> {
    let suggested = Assignment::suggested(&suggest(new, rule_set), rule_set).assignment;
    let mut cells: BTreeMap<(u8, Option<&str>), u64> = BTreeMap::new();
    let mut all: BTreeMap<u8, u64> = BTreeMap::new();
    for overlap in overlaps.iter().filter(|overlap| overlap.new != FaceId::OUTER) {
        let category = new.faces[overlap.new.index()].category;
        let label = if overlap.old == FaceId::OUTER { None } else { old.of_category(overlap.old) };
        *cells.entry((category, label)).or_default() += overlap.cells;
        *all.entry(category).or_default() += overlap.cells;
    }
    let label = |(category, suggested): (u8, String)| {
        let most = cells.iter().find(|((of, _), part)| *of == category && is_most(**part, all[of]));
        let label = most.and_then(|((_, label), _)| *label);
        (category, label.map_or(suggested, str::to_owned))
    };
    suggested.into_iter().map(label).collect()
}

/// The faces of the new analysis that have a label of their own.
fn face_labels(
    overlaps: &[CellOverlap],
    new: &Analysis,
    old: &DecidedLabels<'_>,
    categories: &BTreeMap<u8, String>,
) -> BTreeMap<u32, String> {
    let mut labels = BTreeMap::new();
    for ground in overlaps.chunk_by(|first, second| first.new == second.new) {
        let face = ground[0].new;
        if face == FaceId::OUTER {
            continue;
        }
        let cells: u64 = ground.iter().map(|overlap| overlap.cells).sum();
        // By label: cells of it in all, and those of faces that had it as their own.
        let mut decided: BTreeMap<&str, [u64; 2]> = BTreeMap::new();
        for overlap in ground {
            if let Some((subject, label)) = old.decision(overlap.old) {
                let sums = decided.entry(label).or_default();
                sums[0] += overlap.cells;
                sums[1] += if matches!(subject, LabelSubject::Face(_)) { overlap.cells } else { 0 };
            }
        }
        let most = decided.into_iter().find(|(_, [all, _])| is_most(*all, cells));
        if let Some((label, [_, own])) = most {
            let category = &categories[&new.faces[face.index()].category];
            if label != category || is_most(own, cells) {
                labels.insert(face.0, label.to_owned());
            }
        }
    }
    labels
}

/// How many decisions have their label on most of their ground again, and those that have not.
fn outcome(
    overlaps: &[CellOverlap],
    new: &Analysis,
    old: &DecidedLabels<'_>,
    labels: &Assignment,
) -> (usize, Vec<LostLabel>) {
    let label = |face: FaceId| match labels.overrides.get(&face.0) {
        _ if face == FaceId::OUTER => None,
        Some(label) => Some(label),
        None => labels.assignment.get(&new.faces[face.index()].category),
    };
    // By decision: its label, cells of its ground in all, and those that have the label again.
    let mut ground: BTreeMap<LabelSubject, (&str, [u64; 2])> = BTreeMap::new();
    // A category whose ground is not seen here is decided on, too; one that never had any is not.
    let has_ground = |face: &FaceId| old.analysis.faces[face.index()].cells > 0;
    for (subject, label) in old.analysis.subdivision.faces().filter(has_ground).filter_map(|face| old.decision(face)) {
        ground.insert(subject, (label, [0, 0]));
    }
    for (&face, label) in old.by_face {
        ground.insert(LabelSubject::Face(face), (label, [0, 0]));
    }
    for overlap in overlaps {
        if let Some((subject, decided)) = old.decision(overlap.old) {
            let (_, sums) = ground.entry(subject).or_insert((decided, [0, 0]));
            sums[0] += overlap.cells;
            sums[1] += if label(overlap.new).is_some_and(|label| label == decided) { overlap.cells } else { 0 };
        }
    }
    let decisions = ground.len();
    let lost = ground.into_iter().filter(|(_, (_, [all, again]))| !is_most(*again, *all));
    let lost: Vec<LostLabel> = lost
        .map(|(subject, (label, _))| LostLabel { subject, label: label.to_owned(), at: inside(old, subject) })
        .collect();
    (decisions - lost.len(), lost)
}

/// A point inside a face, or inside the largest face of a category.
fn inside(labels: &DecidedLabels<'_>, subject: LabelSubject) -> Point {
    let analysis = labels.analysis;
    let face = match subject {
        LabelSubject::Face(face) => FaceId(face),
        LabelSubject::Category(_) => analysis
            .subdivision
            .faces()
            .filter(|&face| labels.decision(face).is_some_and(|(of, _)| of == subject))
            .max_by_key(|face| analysis.faces[face.index()].cells)
            .unwrap_or(FaceId::OUTER),
    };
    analysis.graph.position(face)
}

/// Whether a part is more than half.
const fn is_most(part: u64, whole: u64) -> bool {
    part * 2 > whole
}

#[cfg(test)]
mod tests;
