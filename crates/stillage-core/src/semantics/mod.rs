//! The human level: labels, rule sets, cogency and connectivity.
//!
//! A [`RuleSet`] says what labels there are and what edges between them mean; an [`Assignment`] names the categories
//! of an analysis; [`apply()`] reads the one under the other; [`suggest`] proposes an assignment.

mod apply;
mod draft;
#[cfg(test)]
pub(crate) mod pictures;
mod rule_set;
mod suggestion;

pub use apply::apply;
pub use rule_set::{
    Cogency, CogencyRule, Connectivity, Functionality, Label, LabelId, RuleSet, RuleSetDraft, RuleSetProblem,
};
pub use suggestion::suggest;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::arrangement::{EdgeId, FaceId};

/// The human decision: one label per category, and exceptions per face.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct Assignment {
    /// Label id by category. Categories that are not named are the rule set's unidentified label.
    pub assignment: BTreeMap<u8, String>,
    /// Label id of single faces, stronger than the category's.
    pub overrides: BTreeMap<u32, String>,
}

impl Assignment {
    /// The suggestions as if a person had assigned them.
    #[must_use]
    pub fn suggested(suggestions: &[Suggestion], rule_set: &RuleSet) -> Self {
        let label = |suggestion: &Suggestion| (suggestion.category, rule_set.label(suggestion.label).id.clone());
        Self { assignment: suggestions.iter().map(label).collect(), ..Self::default() }
    }
}

/// An assignment that cannot be applied: one problem per entry.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{pointer}: {message}")]
pub struct AssignmentProblem {
    /// JSON pointer into the assignment.
    pub pointer: String,
    /// What is wrong and what would be right.
    pub message: String,
}

/// A proposed label for a category.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Suggestion {
    /// Category.
    pub category: u8,
    /// Proposed label.
    pub label: LabelId,
    /// 0 to 1.
    pub confidence: f64,
    /// Why, for people.
    pub reason: String,
    /// What the proposal rests on.
    pub evidence: CategoryEvidence,
}

/// Aggregates over the faces of one category (area-weighted means).
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct CategoryEvidence {
    /// Number of faces.
    pub faces: usize,
    /// Their area, square metres.
    pub area: f64,
    /// Share of their cells that are free.
    pub free_fraction: f64,
    /// Share of their cells that are occupied.
    pub occupied_fraction: f64,
    /// Share of their cells that are unknown.
    pub unknown_fraction: f64,
    /// Long over short side.
    pub elongation: f64,
    /// Median face area, square metres.
    pub median_area: f64,
    /// Share of the length of their edges that is open (passable on both sides).
    pub open_fraction: f64,
    /// Share of the length of their edges with an obstacle along it, or without a free face behind it.
    pub lined_fraction: f64,
    /// Share of their area that was cut out as places.
    pub place_fraction: f64,
    /// Share of their area that was cut out as aisles.
    pub aisle_fraction: f64,
    /// Share of their area that was cut out as lanes and gaps.
    pub floor_fraction: f64,
    /// Share of their area that is rooms beside the hall, or bays behind its gates.
    pub room_fraction: f64,
    /// Share of their area that was cut out as something else.
    pub rest_fraction: f64,
}

/// Merged faces: a room, or faces of one label that are mutually open (a corridor, a junction, a block of storage).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Place {
    /// Its label; for a room the label of most of its area.
    pub label: LabelId,
    /// The room it is, if walls bound it.
    pub room: Option<u32>,
    /// Its faces, ascending.
    pub faces: Vec<FaceId>,
    /// Area, square metres.
    pub area: f64,
}

/// The semantic map: an analysis read under a rule set and an assignment.
#[derive(Debug, Clone, PartialEq)]
pub struct SemanticMap {
    /// The rule set in force.
    pub rule_set: RuleSet,
    /// Label of each face, by face id (entry 0 is the unidentified label).
    pub labels: Vec<LabelId>,
    /// How sure that label is, 0 to 1, by face id.
    pub confidences: Vec<f64>,
    /// C(e) by edge id.
    pub cogency: Vec<Cogency>,
    /// C(l) by edge id; `None` on the outer boundary, where there is no link.
    pub connectivity: Vec<Option<Connectivity>>,
    /// Edges whose cogency and physical support disagree, by edge id.
    pub disagreements: Vec<bool>,
    /// Place of each face, by face id (`None` for the unbounded face and for unidentified faces outside rooms).
    pub face_places: Vec<Option<u32>>,
    /// Merged faces.
    pub places: Vec<Place>,
}

impl SemanticMap {
    /// The label of a face.
    #[must_use]
    pub fn label(&self, face: FaceId) -> &Label {
        self.rule_set.label(self.labels[face.index()])
    }

    /// Whether a robot may drive over a link: connected, and both faces drivable.
    #[must_use]
    pub fn is_drivable_link(&self, edge: EdgeId, sides: [FaceId; 2]) -> bool {
        self.connectivity[edge.index()] == Some(Connectivity::Connected)
            && sides.iter().all(|&face| self.label(face).is_drivable())
    }
}
