//! Labels of places: what a place is for, and which labels it may connect to.
//!
//! Source: the paper, section II-C, Table II (warehouses) and Table IV (offices).

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
