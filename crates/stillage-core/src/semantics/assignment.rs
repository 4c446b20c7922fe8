//! The human decision: which label each category has.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::rule_set::RuleSet;
use super::suggestion::Suggestion;

/// One label for each category, and exceptions for single faces.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct Assignment {
    /// Label id by category. A category without an entry has the rule set's unidentified label.
    pub assignment: BTreeMap<u8, String>,
    /// Label id by face; it overrides the label of the face's category.
    pub overrides: BTreeMap<u32, String>,
}

impl Assignment {
    /// The suggested labels as an assignment.
    #[must_use]
    pub fn suggested(suggestions: &[Suggestion], rule_set: &RuleSet) -> Self {
        let label = |suggestion: &Suggestion| (suggestion.category, rule_set.label(suggestion.label).id.clone());
        Self { assignment: suggestions.iter().map(label).collect(), ..Self::default() }
    }
}

/// Why one entry of an assignment cannot be applied.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{pointer}: {message}")]
pub struct AssignmentProblem {
    /// JSON pointer into the assignment.
    pub pointer: String,
    /// What is wrong and what would be right.
    pub message: String,
}
