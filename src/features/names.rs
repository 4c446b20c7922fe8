//! What people call the things of a map.

use std::collections::BTreeMap;

use super::collection::Collection;

/// What people call one thing.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Naming {
    /// Its name.
    pub name: Option<String>,
    /// The groups it is in.
    pub groups: Vec<String>,
}

/// What people call the things of a map, by their indices in its layout and among its places. Lists that are shorter say
/// nothing of what they leave out.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct MapNames {
    /// Of its locations.
    pub locations: Vec<Naming>,
    /// Whether the code of a location waits for a person to confirm it.
    pub stale: Vec<bool>,
    /// Of its places.
    pub places: Vec<Naming>,
    /// Of its aisles.
    pub aisles: Vec<Naming>,
    /// Of its rows.
    pub rows: Vec<Naming>,
    /// The names that corrections give to faces, by number.
    pub faces: BTreeMap<u32, String>,
}

impl MapNames {
    /// The names of a map to which nobody gave any.
    #[must_use]
    pub fn none() -> &'static Self {
        static NONE: MapNames = MapNames {
            locations: Vec::new(),
            stale: Vec::new(),
            places: Vec::new(),
            aisles: Vec::new(),
            rows: Vec::new(),
            faces: BTreeMap::new(),
        };
        &NONE
    }

    /// What people call a location, by its index.
    #[must_use]
    pub fn location(&self, index: usize) -> Naming {
        self.locations.get(index).cloned().unwrap_or_default()
    }

    /// What people call a place, by its index.
    #[must_use]
    pub fn place(&self, index: usize) -> Naming {
        self.places.get(index).cloned().unwrap_or_default()
    }

    /// What people call an aisle, by its index.
    #[must_use]
    pub fn aisle(&self, index: usize) -> Naming {
        self.aisles.get(index).cloned().unwrap_or_default()
    }

    /// What people call a row, by its index.
    #[must_use]
    pub fn row(&self, index: usize) -> Naming {
        self.rows.get(index).cloned().unwrap_or_default()
    }

    /// Every list, each naming with its collection and index.
    pub fn all(&self) -> impl Iterator<Item = ((Collection, usize), &Naming)> {
        let lists = [
            (Collection::Locations, &self.locations),
            (Collection::Places, &self.places),
            (Collection::Aisles, &self.aisles),
            (Collection::Rows, &self.rows),
        ];
        lists.into_iter().flat_map(|(collection, list)| {
            list.iter().enumerate().map(move |(index, naming)| ((collection, index), naming))
        })
    }

    /// Whether the code of a location waits for a person to confirm it.
    pub(super) fn is_stale(&self, location: usize) -> bool {
        self.stale.get(location).copied().unwrap_or(false)
    }
}
