//! What people call the things of a map.

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
        };
        &NONE
    }

    /// The naming at an index of one of the lists.
    pub(super) fn at(list: &[Naming], index: usize) -> Naming {
        list.get(index).cloned().unwrap_or_default()
    }

    /// Whether the code of a location waits for a person to confirm it.
    pub(super) fn is_stale(&self, location: usize) -> bool {
        self.stale.get(location).copied().unwrap_or(false)
    }
}
