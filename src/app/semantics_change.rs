//! What a person changes about the human level of a map. What is not named stays as it is in force.

use std::collections::BTreeMap;

use stillage_core::layout::LayoutOptions;
use stillage_core::semantics::{Assignment, RuleSet, RuleSetDraft};

use super::{AppError, CorrectionId, SemanticsOrigin, SemanticsRecord};
use stillage_core::corrections::Correction;

/// A correction of a list that a person wants; without an id it is new.
pub type WantedCorrection = (Option<CorrectionId>, Correction);

/// Changes that make a new version of the human level.
#[derive(Debug, Clone, Default)]
pub struct SemanticsChange {
    /// The rule set; the one in force when absent.
    pub rule_set: Option<RuleSetChoice>,
    /// Label id by category; `None` gives the category its suggested label.
    pub categories: BTreeMap<u8, Option<String>>,
    /// What becomes of the categories that are not named.
    pub other_categories: Unnamed,
    /// Label id by face; `None` gives the face the label of its category.
    pub overrides: BTreeMap<u32, Option<String>>,
    /// What becomes of the overrides that are not named.
    pub other_overrides: Unnamed,
    /// How locations are cut and numbered; as in force when absent.
    pub layout: Option<LayoutOptions>,
    /// All corrections of the map, in their order; as in force when absent. The faces that `overrides` name are those before.
    pub corrections: Option<Vec<WantedCorrection>>,
}

/// The rule set that labels are of.
#[derive(Debug, Clone)]
pub enum RuleSetChoice {
    /// A stored one, by its id.
    Stored(String),
    /// One that is not stored: it can be tried, not decided on.
    Unsaved(RuleSetDraft),
}

impl From<&str> for RuleSetChoice {
    fn from(id: &str) -> Self {
        Self::Stored(id.to_owned())
    }
}

/// What becomes of what a change does not name.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Unnamed {
    /// It stays as it is in force.
    #[default]
    Stays,
    /// It becomes as if nobody had decided on it.
    IsForgotten,
}

impl SemanticsChange {
    /// The labels after the change: `suggested` are those of `rule_set`, which is the rule set after the change.
    ///
    /// Under another rule set than before, a category that nobody decided on, or whose label is not in it, has its
    /// suggested label.
    ///
    /// # Errors
    /// An override stays whose label is not in the rule set.
    pub(super) fn labels(
        &self,
        in_force: &SemanticsRecord,
        rule_set: &RuleSet,
        suggested: &Assignment,
    ) -> Result<Assignment, AppError> {
        let is_other_rule_set = *rule_set.draft() != in_force.draft;
        let is_usable = |label: &String| rule_set.find(label).is_some();
        let mut assignment = match (self.other_categories, in_force.origin) {
            (Unnamed::IsForgotten, _) => suggested.assignment.clone(),
            (Unnamed::Stays, SemanticsOrigin::Suggested) if is_other_rule_set => suggested.assignment.clone(),
            (Unnamed::Stays, _) => in_force.assignment.assignment.clone(),
        };
        for (category, label) in &mut assignment {
            if let (false, Some(suggested)) = (is_usable(label), suggested.assignment.get(category)) {
                label.clone_from(suggested);
            }
        }
        for (&category, label) in &self.categories {
            let label = label.as_ref().or_else(|| suggested.assignment.get(&category));
            let no_such = || AppError::invalid(&format!("/assignment/{category}"), "there is no such category");
            assignment.insert(category, label.ok_or_else(no_such)?.clone());
        }
        let mut overrides = match self.other_overrides {
            Unnamed::IsForgotten => BTreeMap::new(),
            Unnamed::Stays => in_force.assignment.overrides.clone(),
        };
        overrides.retain(|face, _| !self.overrides.contains_key(face));
        if let Some((face, label)) = overrides.iter().find(|(_, label)| !is_usable(label)) {
            let detail = format!(
                "it has no label {label}, which a person gave to face {face}: give that face another label in \
                 overrides, or take the overrides away"
            );
            return Err(AppError::invalid("/ruleSet", detail));
        }
        let named = self.overrides.iter();
        overrides.extend(named.filter_map(|(&face, label)| Some((face, label.clone()?))));
        Ok(Assignment { assignment, overrides })
    }
}
