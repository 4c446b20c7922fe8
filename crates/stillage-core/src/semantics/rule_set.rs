//! Checked rule sets: the two tables of the paper, and both in one.
//!
//! Source: the paper, section II-C: Table II (warehouses), Table IV (offices) and the function C(e). A site is seldom
//! one of the two alone: halls have offices, and offices store rooms. So the default joins them.
//! Cost: O(labels^2 x rules) once per rule set, O(1) per edge. Limits: 32 labels, 1,024 explicit rules.

use super::cogency::{Cogency, derived_cogency};
use super::draft::{RuleSetDraft, RuleSetProblem};
use super::label::{Functionality, Label, LabelId};

/// A checked rule set: at least one label, unique ids, known references, and an unidentified label.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RuleSet {
    draft: RuleSetDraft,
    /// The label of places without another label: the first label without functionality.
    unidentified: LabelId,
    /// C(e) of every ordered pair of labels, row-major.
    cogency: Vec<Cogency>,
}

impl RuleSetDraft {
    /// Checks a draft.
    ///
    /// # Errors
    /// Every problem of the draft.
    pub fn check(self) -> Result<RuleSet, Vec<RuleSetProblem>> {
        let problems = self.problems();
        match self.unidentified() {
            Some(unidentified) if problems.is_empty() => Ok(RuleSet::tabulate(self, unidentified)),
            _ => Err(problems),
        }
    }
}

/// The rule set that is built in for sites of any kind.
impl Default for RuleSet {
    fn default() -> Self {
        Self::site()
    }
}

impl RuleSet {
    /// Id of the default among the rule sets that are built in.
    pub const DEFAULT_ID: &str = "site";

    /// The rule sets that are built in, with their ids: the default, Table II and Table IV of the paper.
    #[must_use]
    pub fn all_built_in() -> [(&'static str, Self); 3] {
        [(Self::DEFAULT_ID, Self::site()), ("warehouse", Self::warehouse()), ("office", Self::office())]
    }

    /// Tables II and IV of the paper joined: for sites of any kind. A room is a work place as an office is.
    #[must_use]
    pub fn site() -> Self {
        use Functionality::{Access, Connection, Drivable, Storage, StorageAccess, WorkPlace};
        Self::built_in(vec![
            label("co", "corridor", BLUE, &[Drivable, StorageAccess, Access], &["co", "ju", "pc", "ro"]),
            label("ju", "junction", YELLOW, &[Drivable, Connection], &["co", "ju", "ro"]),
            label("pc", "pallet cell", GREEN, &[Storage], &["co"]),
            label("ro", "room", ORANGE, &[WorkPlace], &["co", "ju", "ro"]),
            label("un", "unidentified", GREY, &[], &[]),
        ])
    }

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
        RuleSetDraft { labels, cogency: None }.check().expect("the built-in tables are valid")
    }

    /// Tabulates the cogency of a valid draft.
    fn tabulate(draft: RuleSetDraft, unidentified: LabelId) -> Self {
        let labels = &draft.labels;
        let pairs = labels.iter().flat_map(|first| labels.iter().map(move |second| (first, second)));
        let unidentified_label = &labels[unidentified.0 as usize];
        let cogency = pairs
            .map(|(first, second)| {
                let listed = draft.cogency.iter().flatten().find(|rule| rule.matches(first, second));
                listed.map_or_else(|| derived_cogency(first, second, unidentified_label), |rule| rule.then)
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

    /// The label of places without another label.
    #[must_use]
    pub const fn unidentified(&self) -> LabelId {
        self.unidentified
    }

    /// C(e) of an edge between faces of two labels, in either order.
    ///
    /// The first explicit rule that matches the pair applies. Without one, it follows from the table of labels:
    /// 1. one of them is unidentified, or connects to nothing: cogent;
    /// 2. they differ and do not list each other: cogent;
    /// 3. one is drivable with storage access, the other is storage: storage access;
    /// 4. otherwise invalid.
    #[must_use]
    pub fn cogency(&self, first: LabelId, second: LabelId) -> Cogency {
        self.cogency[first.0 as usize * self.labels().len() + second.0 as usize]
    }
}

// The colours of the paper's Fig. 9 and 10 (junctions yellow, pallet cells green, corridors blue), in the tones of M.
// Okabe and K. Ito (2008), which readers who confuse red and green can tell apart.
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
    use crate::semantics::CogencyRule;
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
    fn the_default_gives_both_tables_their_cogency() {
        let (site, twins) =
            (RuleSet::default(), [("warehouse", ["co", "ju", "pc", "un"]), ("office", ["co", "ju", "of", "un"])]);
        for (id, labels) in twins {
            let table = RuleSet::all_built_in().into_iter().find(|(built_in, _)| *built_in == id).unwrap().1;
            let in_site = |label: &str| site.find(if label == "of" { "ro" } else { label }).unwrap();
            for (first, second) in labels.iter().flat_map(|first| labels.map(|second| (*first, second))) {
                let expected = table.cogency(table.find(first).unwrap(), table.find(second).unwrap());
                assert_eq!(site.cogency(in_site(first), in_site(second)), expected, "{id}: {first} | {second}");
            }
        }
        let [pallet_cell, room] = ["pc", "ro"].map(|label| site.find(label).unwrap());
        assert_eq!(site.cogency(pallet_cell, room), Cogency::Cogent, "goods in a room are not reached from an aisle");
    }

    #[test]
    fn cogency_does_not_depend_on_the_order_of_the_faces() {
        let any_against_storage = CogencyRule { when: ["*".into(), "pc".into()], then: Cogency::Cogent };
        let listed = RuleSetDraft { cogency: Some(vec![any_against_storage]), ..RuleSet::warehouse().draft().clone() };
        for rules in [RuleSet::site(), RuleSet::warehouse(), RuleSet::office(), listed.check().unwrap()] {
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
