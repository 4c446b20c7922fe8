//! The labels that a truth uses, in a rule set.

use crate::semantics::{LabelId, RuleSet};

/// Id of the label of corridors.
const CORRIDOR: &str = "co";

/// Id of the label of junctions.
const JUNCTION: &str = "ju";

/// Id of the label of pallet cells.
const PALLET_CELL: &str = "pc";

/// A rule set without a label that the truth uses.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "the rule set has no label {id}: a truth of corridors (co), junctions (ju) and pallet cells (pc) needs all three"
)]
pub struct MissingLabel {
    /// Id of the missing label.
    pub id: &'static str,
}

/// The labels of a rule set that a truth uses.
pub(super) struct TruthLabels {
    corridor: LabelId,
    junction: LabelId,
    pub(super) pallet_cell: LabelId,
    unidentified: LabelId,
}

impl TruthLabels {
    pub(super) fn of(rule_set: &RuleSet) -> Result<Self, MissingLabel> {
        let find = |id: &'static str| rule_set.find(id).ok_or(MissingLabel { id });
        Ok(Self {
            corridor: find(CORRIDOR)?,
            junction: find(JUNCTION)?,
            pallet_cell: find(PALLET_CELL)?,
            unidentified: rule_set.unidentified(),
        })
    }

    /// Corridor, junction, pallet cell, unidentified.
    pub(super) const fn all(&self) -> [LabelId; 4] {
        [self.corridor, self.junction, self.pallet_cell, self.unidentified]
    }

    /// The label of the largest area; the first of equals.
    pub(super) fn largest(&self, areas: [f64; 4]) -> LabelId {
        let largest = (1..4).fold(0, |best, label| if areas[label] > areas[best] { label } else { best });
        self.all()[largest]
    }
}
