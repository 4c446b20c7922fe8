//! Labels with functionality and connect-ability (paper, Tables II and IV), and the rules read from them. (to be completed)

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

/// A label that a person may give to places. Table II writes it `co: corridor, drivable & storage access, co & ju & pc`.
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
}

impl RuleSet {
    /// Table II of the paper.
    #[must_use]
    pub fn warehouse() -> Self {
        todo!()
    }

    /// Table IV of the paper.
    #[must_use]
    pub fn office() -> Self {
        todo!()
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

    /// C(e) of an edge between faces of two labels.
    #[must_use]
    pub fn cogency(&self, first: LabelId, second: LabelId) -> Cogency {
        let _ = (first, second);
        todo!()
    }
}

impl RuleSetDraft {
    /// Checks a draft.
    ///
    /// # Errors
    /// Every problem of the draft.
    pub fn check(self) -> Result<RuleSet, Vec<RuleSetProblem>> {
        todo!()
    }
}
