//! A rule set as a person writes it, and its check.
//!
//! All problems are reported at once, each with a JSON pointer (RFC 6901) to the value that is wrong.
//! Cost: O(labels^2 + rules). Limits: see [`MAX_LABELS`] and [`MAX_RULES`].

use serde::{Deserialize, Serialize};

use super::cogency::CogencyRule;
use super::label::{Label, LabelId};
use crate::excerpt::excerpt;

/// Most labels of a rule set: a legend cannot show more, and the table of cogency stays small.
const MAX_LABELS: usize = 32;
/// Most explicit rules: every pair of labels in either order.
const MAX_RULES: usize = MAX_LABELS * MAX_LABELS;
/// Longest id of a label, characters.
const MAX_ID: usize = 32;
/// Longest name of a label, characters.
const MAX_NAME: usize = 100;

/// A rule set as a person writes it, not yet checked.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "camelCase")]
pub struct RuleSetDraft {
    /// The labels.
    pub labels: Vec<Label>,
    /// Explicit rules; the first that matches applies. Without a match the cogency is derived from the labels.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cogency: Option<Vec<CogencyRule>>,
}

/// What is wrong with a draft.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{pointer}: {message}")]
pub struct RuleSetProblem {
    /// JSON pointer into the draft.
    pub pointer: String,
    /// What is wrong and what would be right.
    pub message: String,
}

impl RuleSetDraft {
    /// Every problem of the draft; none when it is valid.
    pub(super) fn problems(&self) -> Vec<RuleSetProblem> {
        let mut problems = Problems::default();
        let labels = &self.labels;
        problems.unless(labels.len() <= MAX_LABELS, "/labels", || {
            format!("{} labels are more than {MAX_LABELS}", labels.len())
        });
        // Each label is compared with all others, so their number is bounded first.
        for index in 0..labels.len().min(MAX_LABELS) {
            check_label(labels, index, &mut problems);
        }
        check_rules(self, &mut problems);
        problems.unless(self.unidentified().is_some(), "/labels", || {
            "a label without functionality is needed for places that nobody named".to_owned()
        });
        problems.0
    }

    /// The rules that never apply, because an earlier one matches every pair that they match. Such a draft is valid: its
    /// cogency is what it says, though hardly what was meant.
    #[must_use]
    pub fn unreachable_rules(&self) -> Vec<RuleSetProblem> {
        let rules = self.cogency.as_deref().unwrap_or_default();
        let unreachable = |(index, rule): (usize, &CogencyRule)| {
            let earlier = rules[..index].iter().position(|earlier| earlier.covers(rule))?;
            let message = format!("never applies: rule {earlier} comes first and matches whatever it matches");
            Some(RuleSetProblem { pointer: format!("/cogency/{index}"), message })
        };
        rules.iter().enumerate().take(MAX_RULES).filter_map(unreachable).collect()
    }

    /// The first label without functionality.
    pub(super) fn unidentified(&self) -> Option<LabelId> {
        let index = self.labels.iter().position(|label| label.functionality.is_empty());
        index.map(|index| LabelId(index as u8))
    }

    fn knows(&self, id: &str) -> bool {
        self.labels.iter().any(|label| label.id == id)
    }
}

fn check_label(labels: &[Label], index: usize, problems: &mut Problems) {
    let label = &labels[index];
    let at = |field: &str| format!("/labels/{index}/{field}");
    let is_id_character = |character: char| matches!(character, 'a'..='z' | '0'..='9' | '-');
    let well_formed = (1..=MAX_ID).contains(&label.id.len()) && label.id.chars().all(is_id_character);
    problems.unless(well_formed, &at("id"), || {
        format!("{:?} is not 1 to {MAX_ID} characters of a-z, 0-9 and -", excerpt(&label.id))
    });
    let namesake = labels[..index].iter().position(|earlier| earlier.id == label.id);
    problems
        .unless(namesake.is_none(), &at("id"), || format!("{:?} is the id of an earlier label", excerpt(&label.id)));
    let named = !label.name.trim().is_empty() && label.name.chars().count() <= MAX_NAME;
    problems.unless(named, &at("name"), || format!("a name has 1 to {MAX_NAME} characters"));
    problems.unless(is_color(&label.color), &at("color"), || {
        format!("{:?} is not a colour like #56b4e9", excerpt(&label.color))
    });
    for (position, other) in label.connects_to.iter().enumerate() {
        let known = labels.iter().any(|label| label.id == *other);
        problems.unless(known, &at(&format!("connectsTo/{position}")), || {
            format!("no label has the id {:?}", excerpt(other))
        });
    }
}

fn check_rules(draft: &RuleSetDraft, problems: &mut Problems) {
    let rules = draft.cogency.as_deref().unwrap_or_default();
    problems
        .unless(rules.len() <= MAX_RULES, "/cogency", || format!("{} rules are more than {MAX_RULES}", rules.len()));
    for (index, rule) in rules.iter().enumerate().take(MAX_RULES) {
        for (position, id) in rule.when.iter().enumerate() {
            let known = id == CogencyRule::ANY || draft.knows(id);
            problems.unless(known, &format!("/cogency/{index}/when/{position}"), || {
                format!("no label has the id {:?}; * stands for any", excerpt(id))
            });
        }
    }
}

fn is_color(text: &str) -> bool {
    text.strip_prefix('#')
        .is_some_and(|digits| digits.len() == 6 && digits.bytes().all(|digit| digit.is_ascii_hexdigit()))
}

/// Collects what is wrong.
#[derive(Default)]
struct Problems(Vec<RuleSetProblem>);

impl Problems {
    fn unless(&mut self, holds: bool, pointer: &str, message: impl FnOnce() -> String) {
        if !holds {
            self.0.push(RuleSetProblem { pointer: pointer.to_owned(), message: message() });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::semantics::{Cogency, RuleSet};
    use expect_test::{Expect, expect};

    fn check(change: impl FnOnce(&mut RuleSetDraft), expected: &Expect) {
        let mut draft = RuleSet::warehouse().draft().clone();
        change(&mut draft);
        let problems = draft.check().err().unwrap_or_default();
        let lines: Vec<String> = problems.iter().map(ToString::to_string).collect();
        expected.assert_eq(&lines.join("\n"));
    }

    #[test]
    fn every_problem_is_named_with_its_pointer() {
        check(
            |draft| {
                draft.labels[0].id = "Corridor".into();
                draft.labels[1].id = "pc".into();
                draft.labels[1].name = " ".into();
                draft.labels[2].color = "green".into();
                draft.labels[3].color = "green".repeat(1_000);
                draft.labels[3].connects_to = vec!["pc".into(), "shelf".into()];
                draft.cogency = Some(vec![CogencyRule { when: ["*".into(), "bin".into()], then: Cogency::Cogent }]);
            },
            &expect![[r#"
                /labels/0/id: "Corridor" is not 1 to 32 characters of a-z, 0-9 and -
                /labels/0/connectsTo/0: no label has the id "co"
                /labels/0/connectsTo/1: no label has the id "ju"
                /labels/1/name: a name has 1 to 100 characters
                /labels/1/connectsTo/0: no label has the id "co"
                /labels/1/connectsTo/1: no label has the id "ju"
                /labels/2/id: "pc" is the id of an earlier label
                /labels/2/color: "green" is not a colour like #56b4e9
                /labels/2/connectsTo/0: no label has the id "co"
                /labels/3/color: "greengreengreengreengreengreengreengreen..." is not a colour like #56b4e9
                /labels/3/connectsTo/1: no label has the id "shelf"
                /cogency/0/when/1: no label has the id "bin"; * stands for any"#]],
        );
    }

    #[test]
    fn a_rule_behind_a_wider_one_never_applies() {
        let rule = |one: &str, other: &str| CogencyRule { when: [one.into(), other.into()], then: Cogency::Cogent };
        let unreachable = |rules: Vec<CogencyRule>| {
            let draft = RuleSetDraft { cogency: Some(rules), ..RuleSet::warehouse().draft().clone() };
            draft.unreachable_rules().iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
        };
        assert_eq!(unreachable(vec![rule("co", "pc"), rule("co", "*"), rule("ju", "pc"), rule("*", "*")]), "");
        expect!["/cogency/2: never applies: rule 0 comes first and matches whatever it matches"]
            .assert_eq(&unreachable(vec![rule("*", "pc"), rule("co", "ju"), rule("pc", "ju")]));
        expect!["/cogency/1: never applies: rule 0 comes first and matches whatever it matches"]
            .assert_eq(&unreachable(vec![rule("co", "pc"), rule("pc", "co")]));
    }

    #[test]
    fn a_label_without_functionality_is_needed() {
        check(
            |draft| draft.labels.truncate(3),
            &expect!["/labels: a label without functionality is needed for places that nobody named"],
        );
        check(
            |draft| draft.labels.clear(),
            &expect!["/labels: a label without functionality is needed for places that nobody named"],
        );
    }

    #[test]
    fn there_are_at_most_32_labels() {
        let grow = |draft: &mut RuleSetDraft, count: usize| {
            while draft.labels.len() < count {
                let id = format!("extra-{}", draft.labels.len());
                draft.labels.push(Label { id, ..draft.labels[3].clone() });
            }
        };
        check(|draft| grow(draft, 32), &expect![""]);
        check(|draft| grow(draft, 33), &expect!["/labels: 33 labels are more than 32"]);
    }

    #[test]
    fn names_may_be_written_in_any_script() {
        check(|draft| draft.labels[0].name = "通路".repeat(50), &expect![""]);
        check(
            |draft| draft.labels[0].name = "通路".repeat(51),
            &expect!["/labels/0/name: a name has 1 to 100 characters"],
        );
    }
}
