//! Cogency of edges, connectivity of links, and the rules behind them.
//!
//! Source: the paper, section II-C: the functions C(e) and C(l). Departure: the paper writes C(e) down for Table II
//! only. Here it is derived from any table of labels, and equals the paper's on every pair of labels of Tables II and
//! IV.

use serde::{Deserialize, Serialize};

use super::label::{Functionality, Label};

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

impl CogencyRule {
    /// The pattern that matches any label.
    pub const ANY: &str = "*";

    /// Whether it matches every pair of labels that another rule matches.
    pub(super) fn covers(&self, other: &Self) -> bool {
        let covers = |pattern: &String, id: &String| pattern == Self::ANY || pattern == id;
        let ([first, second], [one, two]) = (&self.when, &other.when);
        (covers(first, one) && covers(second, two)) || (covers(first, two) && covers(second, one))
    }

    pub(super) fn matches(&self, first: &Label, second: &Label) -> bool {
        let names = |pattern: &String, label: &Label| pattern == Self::ANY || *pattern == label.id;
        let [one, other] = &self.when;
        (names(one, first) && names(other, second)) || (names(one, second) && names(other, first))
    }
}

/// Cogency by the labels alone, where no explicit rule matches: see `RuleSet::cogency`.
pub(super) fn derived_cogency(first: &Label, second: &Label, unidentified: &Label) -> Cogency {
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
