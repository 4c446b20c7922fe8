//! New codes for all places, because people wish another template, entrance or width of places.

use std::collections::BTreeSet;

use super::carry::{NumberedLocation, SURE_SHARE};
use super::entry::{PlaceState, Registry, RegistryEntry};
use super::next_code::unused;
use crate::compare::{Footprint, pairs};

impl Registry {
    /// The registry with the codes of a fresh numbering for the locations of the newest map; `numbering` says which
    /// ([`Registry::numbering`]).
    ///
    /// Places keep their keys, names, groups, and the codes that people gave. A location that is less than half of a place
    /// nobody named is a new place. Places that the map does not show keep their codes where no other has them now.
    #[must_use]
    pub fn renumbered(&self, locations: &[NumberedLocation], numbering: String) -> Self {
        let mut registry = Self { numbering, ..self.clone() };
        let known: Vec<Footprint> = self.entries.iter().map(RegistryEntry::footprint).collect();
        let found: Vec<Footprint> = locations.iter().map(|location| location.footprint.clone()).collect();
        let mut entry_of: Vec<Option<usize>> = vec![None; locations.len()];
        for pair in pairs(&known, &found) {
            let entry = &self.entries[pair.old];
            let is_named = entry.is_code_given || entry.name.is_some() || !entry.groups.is_empty();
            if pair.share >= SURE_SHARE || is_named {
                entry_of[pair.new] = Some(pair.old);
            }
        }
        let given = self.entries.iter().filter(|entry| entry.is_code_given);
        let mut used: BTreeSet<String> = given.map(|entry| entry.code.clone()).collect();
        let mut is_shown = vec![false; self.entries.len()];
        for index in NumberedLocation::in_order(locations) {
            let entry = entry_of[index];
            if let Some(entry) = entry {
                is_shown[entry] = true;
            }
            if entry.is_some_and(|entry| self.entries[entry].is_code_given) {
                continue;
            }
            let NumberedLocation { code, footprint } = &locations[index];
            let code = unused(code, &used);
            used.insert(code.clone());
            match entry {
                Some(entry) => registry.entries[entry].code = code,
                None => _ = registry.add(code, footprint, PlaceState::Current),
            }
        }
        let is_way = |&index: &usize| !is_shown[index] && !self.entries[index].is_code_given;
        let ways: Vec<usize> = (0..self.entries.len()).filter(is_way).collect();
        registry.make_way(&ways);
        registry
    }
}
