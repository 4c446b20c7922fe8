//! The human level: rule sets, and the versions of what people decided.

use jiff::Timestamp;
use serde::{Deserialize, Serialize};
use stillage_core::layout::LayoutOptions;
use stillage_core::semantics::{Assignment, LabelSubject, RuleSetDraft};
use uuid::Uuid;

use super::CorrectionList;

/// A stored rule set.
#[derive(Debug, Clone, PartialEq)]
pub struct RuleSetRecord {
    /// Its id.
    pub id: String,
    /// The labels and rules.
    pub draft: RuleSetDraft,
    /// Built in, so that it cannot be changed.
    pub built_in: bool,
    /// From 1, raised with every change.
    pub version: u64,
}

/// One version of the human level of a map.
#[derive(Debug, Clone, PartialEq)]
pub struct SemanticsRecord {
    /// The analysis whose categories it names.
    pub analysis: Uuid,
    /// Id of the rule set.
    pub rule_set: String,
    /// The rule set as it was when this version was made.
    pub draft: RuleSetDraft,
    /// The decision.
    pub assignment: Assignment,
    /// How locations are cut and numbered.
    pub layout: LayoutOptions,
    /// The corrections of the map; `None` for none. Its faces, which the assignment names, are those of the corrected map.
    pub corrections: Option<CorrectionList>,
    /// 0 is the suggestion; assigned versions count from 1.
    pub version: u64,
    /// Who decided.
    pub origin: SemanticsOrigin,
    /// What became of the decisions on another analysis, where it was carried over from them.
    pub carried: Option<CarryRecord>,
    /// The version that it equals, where a person went back or forth in the history: one that restores none itself, or 0
    /// for the suggestion.
    pub restores: Option<u64>,
    /// When it was made.
    pub created: Timestamp,
}

/// What became of the decisions of a version when they were carried over to another analysis of the map, or to a later map
/// of the site.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct CarryRecord {
    /// The earlier map of the site that the version is of; `None` for the map itself.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub map: Option<Uuid>,
    /// The version, which a person made.
    pub from: u64,
    /// Decisions that hold on the other analysis, too.
    pub kept: usize,
    /// The others.
    pub lost: Vec<LostDecision>,
}

/// A decision that could not be carried over.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct LostDecision {
    /// What had the label on the analysis it was decided on.
    #[serde(flatten)]
    pub subject: LabelSubject,
    /// Id of the label.
    pub label: String,
    /// A point inside, in metres of the map frame.
    pub at: [f64; 2],
}

/// Who decided.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SemanticsOrigin {
    /// Nobody, or a person who went back to the suggestion.
    Suggested,
    /// A person.
    Assigned,
    /// A person, on another analysis of the map or on an earlier map of the site.
    Carried,
}

impl SemanticsOrigin {
    /// All of them.
    const ALL: [Self; 3] = [Self::Suggested, Self::Assigned, Self::Carried];

    /// The name in the database.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Suggested => "suggested",
            Self::Assigned => "assigned",
            Self::Carried => "carried",
        }
    }

    /// The origin with a name.
    #[must_use]
    pub fn find(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|origin| origin.name() == name)
    }
}
