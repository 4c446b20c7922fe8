//! Labels with functionality and connect-ability, and the cogency read from them.
//!
//! Source: the paper, section II-C: Table II (warehouses), Table IV (offices) and the functions C(e), C(l).
//! Departure: the paper writes C(e) down for Table II only. Here it is derived from any table (see
//! [`RuleSet::cogency`]), and equals the paper's on every pair of labels of both tables. A rule set may also list
//! its cogency outright.
//! Cost: O(labels^2 x rules) once per rule set, O(1) per edge. Limits: 32 labels, 1,024 explicit rules.

use serde::{Deserialize, Serialize};

/// Index of a label in its rule set.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(transparent)]
pub struct LabelId(pub u8);

/// What a place is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Functionality {
    /// Robots may drive here.
    Drivable,
    /// Storage is reached from here.
    StorageAccess,
    /// Joins corridors.
    Connection,
    /// Rooms are reached from here.
    Access,
    /// Goods stand here.
    Storage,
    /// People work here.
    WorkPlace,
}

/// A label that a person may give to places. Table II writes it `co: corridor, drivable & storage access, co & ju &
/// pc`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "camelCase")]
pub struct Label {
    /// Short id, unique in its rule set: `co`, `ju`, `pc`, `un`.
    pub id: String,
    /// Name for people.
    pub name: String,
    /// `#rrggbb`.
    pub color: String,
    /// What such a place is for.
    #[serde(default)]
    pub functionality: Vec<Functionality>,
    /// Ids of the labels it may connect to.
    #[serde(default)]
    pub connects_to: Vec<String>,
}

impl Label {
    /// Whether such a place has a functionality.
    #[must_use]
    pub fn has(&self, functionality: Functionality) -> bool {
        self.functionality.contains(&functionality)
    }

    /// Whether robots may drive in such a place.
    #[must_use]
    pub fn is_drivable(&self) -> bool {
        self.has(Functionality::Drivable)
    }

    /// Whether goods stand in such a place.
    #[must_use]
    pub fn is_storage(&self) -> bool {
        self.has(Functionality::Storage)
    }
}

/// C(e): what an edge means to its two faces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Cogency {
    /// An obstruction.
    Cogent,
    /// Where storage is reached from a drivable face.
    StorageAccess,
    /// No obstruction: open access.
    Invalid,
}

/// C(l): what a link allows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Connectivity {
    /// Over a cogent edge.
    Disconnected,
    /// Over a storage-access edge.
    StorageAccess,
    /// Over an invalid edge.
    Connected,
}

impl From<Cogency> for Connectivity {
    fn from(cogency: Cogency) -> Self {
        match cogency {
            Cogency::Cogent => Self::Disconnected,
            Cogency::StorageAccess => Self::StorageAccess,
            Cogency::Invalid => Self::Connected,
        }
    }
}

/// One explicit rule: an edge between these labels (in either order; `*` for any) has this cogency.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "camelCase")]
pub struct CogencyRule {
    /// The two label ids, or `*`.
    pub when: [String; 2],
    /// The cogency of such an edge.
    pub then: Cogency,
}

/// A rule set as a person writes it, unchecked.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "camelCase")]
pub struct RuleSetDraft {
    /// The labels.
    pub labels: Vec<Label>,
    /// Explicit rules, first match wins; derived from the labels where absent or without a match.
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

/// A checked rule set: at least one label, unique ids, known references, and an unidentified label.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RuleSet {
    draft: RuleSetDraft,
    /// The label of what nobody named: the first label without functionality.
    unidentified: LabelId,
    /// C(e) of every ordered pair of labels, row-major.
    cogency: Vec<Cogency>,
}

impl RuleSet {
    /// Table II of the paper.
    #[must_use]
    pub fn warehouse() -> Self {
        use Functionality::{Connection, Drivable, Storage, StorageAccess};
        Self::built_in(vec![
            label("co", "corridor", BLUE, &[Drivable, StorageAccess], &["co", "ju", "pc"]),
            label("ju", "junction", YELLOW, &[Drivable, Connection], &["co", "ju"]),
            label("pc", "pallet cell", GREEN, &[Storage], &["co"]),
            label("un", "unidentified", GREY, &[], &[]),
        ])
    }

    /// Table IV of the paper. An office is a work place, not drivable: robots stop at its door.
    #[must_use]
    pub fn office() -> Self {
        use Functionality::{Access, Drivable, WorkPlace};
        Self::built_in(vec![
            label("co", "corridor", BLUE, &[Drivable, Access], &["co", "ju", "of"]),
            label("ju", "junction", YELLOW, &[Drivable, Access], &["co", "ju", "of"]),
            label("of", "office", ORANGE, &[WorkPlace], &["co", "ju", "of"]),
            label("un", "unidentified", GREY, &[], &[]),
        ])
    }

    fn built_in(labels: Vec<Label>) -> Self {
        RuleSetDraft { labels, cogency: None }.check().expect("the tables of the paper are valid")
    }

    /// Tabulates the cogency of a draft that was checked.
    pub(super) fn tabulate(draft: RuleSetDraft, unidentified: LabelId) -> Self {
        let labels = &draft.labels;
        let pairs = labels.iter().flat_map(|first| labels.iter().map(move |second| (first, second)));
        let nameless = &labels[unidentified.0 as usize];
        let cogency = pairs
            .map(|(first, second)| {
                let listed = draft.cogency.iter().flatten().find(|rule| rule.matches(first, second));
                listed.map_or_else(|| derived_cogency(first, second, nameless), |rule| rule.then)
            })
            .collect();
        Self { draft, unidentified, cogency }
    }

    /// The labels, by [`LabelId`].
    #[must_use]
    pub fn labels(&self) -> &[Label] {
        &self.draft.labels
    }

    /// The draft behind the rule set.
    #[must_use]
    pub const fn draft(&self) -> &RuleSetDraft {
        &self.draft
    }

    /// A label.
    #[must_use]
    pub fn label(&self, id: LabelId) -> &Label {
        &self.draft.labels[id.0 as usize]
    }

    /// The label with an id.
    #[must_use]
    pub fn find(&self, id: &str) -> Option<LabelId> {
        self.draft.labels.iter().position(|label| label.id == id).map(|index| LabelId(index as u8))
    }

    /// The label of what nobody named.
    #[must_use]
    pub const fn unidentified(&self) -> LabelId {
        self.unidentified
    }

    /// C(e) of an edge between faces of two labels, in either order.
    ///
    /// The first explicit rule that names the pair decides. Without one, it follows from the table of labels:
    /// 1. one of them is unidentified, or connects to nothing: cogent;
    /// 2. they differ and do not list each other: cogent;
    /// 3. one is drivable with storage access, the other is storage: storage access;
    /// 4. otherwise invalid.
    #[must_use]
    pub fn cogency(&self, first: LabelId, second: LabelId) -> Cogency {
        self.cogency[first.0 as usize * self.labels().len() + second.0 as usize]
    }
}

impl CogencyRule {
    /// Stands for any label.
    pub const ANY: &str = "*";

    fn matches(&self, first: &Label, second: &Label) -> bool {
        let names = |pattern: &String, label: &Label| pattern == Self::ANY || *pattern == label.id;
        let [one, other] = &self.when;
        (names(one, first) && names(other, second)) || (names(one, second) && names(other, first))
    }
}

fn derived_cogency(first: &Label, second: &Label, unidentified: &Label) -> Cogency {
    let is_nowhere = |label: &Label| label.id == unidentified.id || label.connects_to.is_empty();
    let lists = |one: &Label, other: &Label| one.connects_to.contains(&other.id);
    let gives_storage =
        |one: &Label, other: &Label| one.is_drivable() && one.has(Functionality::StorageAccess) && other.is_storage();
    let nowhere = is_nowhere(first) || is_nowhere(second);
    let apart = first.id != second.id && !(lists(first, second) && lists(second, first));
    if nowhere || apart {
        Cogency::Cogent
    } else if gives_storage(first, second) || gives_storage(second, first) {
        Cogency::StorageAccess
    } else {
        Cogency::Invalid
    }
}

// The colours of the paper's Fig. 9 and 10 (junctions yellow, pallet cells green, corridors blue), in tones that stay
// apart for readers who confuse red and green (Okabe and Ito 2008).
const BLUE: &str = "#56b4e9";
const YELLOW: &str = "#f0e442";
const GREEN: &str = "#009e73";
const ORANGE: &str = "#e69f00";
const GREY: &str = "#bdbdbd";

fn label(id: &str, name: &str, color: &str, functionality: &[Functionality], connects_to: &[&str]) -> Label {
    Label {
        id: id.to_owned(),
        name: name.to_owned(),
        color: color.to_owned(),
        functionality: functionality.to_vec(),
        connects_to: connects_to.iter().map(|&other| other.to_owned()).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use expect_test::{Expect, expect};

    /// The paper's C(e), section II-C, as it stands there.
    fn cogency_of_the_paper(first: &str, second: &str) -> Cogency {
        let is = |one: &str, other: &str| [(first, second), (second, first)].contains(&(one, other));
        match () {
            () if first == "un" || second == "un" => Cogency::Cogent,
            () if is("ju", "pc") => Cogency::Cogent,
            () if is("co", "pc") => Cogency::StorageAccess,
            () => Cogency::Invalid,
        }
    }

    fn check_against_the_paper(rules: &RuleSet, expected: &Expect) {
        let line = |first: &Label| {
            let entry = |second: &Label| {
                let cogency = rules.cogency(rules.find(&first.id).unwrap(), rules.find(&second.id).unwrap());
                assert_eq!(cogency, cogency_of_the_paper(&first.id, &second.id), "{} | {}", first.id, second.id);
                format!("{}|{} {:<13}", first.id, second.id, format!("{cogency:?}"))
            };
            rules.labels().iter().map(entry).collect::<Vec<_>>().join(" ").trim_end().to_owned()
        };
        expected.assert_eq(&rules.labels().iter().map(line).collect::<Vec<_>>().join("\n"));
    }

    #[test]
    fn table_two_gives_the_cogency_of_the_paper() {
        check_against_the_paper(
            &RuleSet::warehouse(),
            &expect![[r#"
                co|co Invalid       co|ju Invalid       co|pc StorageAccess co|un Cogent
                ju|co Invalid       ju|ju Invalid       ju|pc Cogent        ju|un Cogent
                pc|co StorageAccess pc|ju Cogent        pc|pc Invalid       pc|un Cogent
                un|co Cogent        un|ju Cogent        un|pc Cogent        un|un Cogent"#]],
        );
    }

    #[test]
    fn table_four_gives_the_cogency_of_the_paper() {
        check_against_the_paper(
            &RuleSet::office(),
            &expect![[r#"
                co|co Invalid       co|ju Invalid       co|of Invalid       co|un Cogent
                ju|co Invalid       ju|ju Invalid       ju|of Invalid       ju|un Cogent
                of|co Invalid       of|ju Invalid       of|of Invalid       of|un Cogent
                un|co Cogent        un|ju Cogent        un|of Cogent        un|un Cogent"#]],
        );
    }

    #[test]
    fn cogency_does_not_depend_on_the_order_of_the_faces() {
        let any_against_storage = CogencyRule { when: ["*".into(), "pc".into()], then: Cogency::Cogent };
        let listed = RuleSetDraft { cogency: Some(vec![any_against_storage]), ..RuleSet::warehouse().draft().clone() };
        for rules in [RuleSet::warehouse(), RuleSet::office(), listed.check().unwrap()] {
            let ids = || (0..rules.labels().len() as u8).map(LabelId);
            for (first, second) in ids().flat_map(|first| ids().map(move |second| (first, second))) {
                assert_eq!(rules.cogency(first, second), rules.cogency(second, first));
            }
        }
    }

    #[test]
    fn of_explicit_rules_the_first_match_wins_and_the_table_decides_the_rest() {
        let rule = |one: &str, other: &str, then| CogencyRule { when: [one.to_owned(), other.to_owned()], then };
        let draft = RuleSetDraft {
            cogency: Some(vec![rule("pc", "ju", Cogency::StorageAccess), rule("pc", "*", Cogency::Cogent)]),
            ..RuleSet::warehouse().draft().clone()
        };
        let rules = draft.check().unwrap();
        let [co, ju, pc, un] = ["co", "ju", "pc", "un"].map(|id| rules.find(id).unwrap());
        assert_eq!(rules.cogency(ju, pc), Cogency::StorageAccess);
        assert_eq!(rules.cogency(co, pc), Cogency::Cogent);
        assert_eq!(rules.cogency(pc, pc), Cogency::Cogent);
        assert_eq!(rules.cogency(co, ju), Cogency::Invalid);
        assert_eq!(rules.cogency(co, un), Cogency::Cogent);
    }
}
