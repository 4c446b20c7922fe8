//! The codes of a registry, carried to the locations of a map.

use std::collections::BTreeSet;

use super::entry::{PlaceState, Registry, RegistryEntry};
use super::next_code::unused;
use crate::compare::{Footprint, pairs};

/// Least share of common ground for a place that is surely the same: above a half, no other place has as much.
pub(super) const SURE_SHARE: f64 = 0.5;

/// A location of a map as a numbering found it.
#[derive(Debug, Clone, PartialEq)]
pub struct NumberedLocation {
    /// The code that the numbering proposes, unique among the locations.
    pub code: String,
    /// Its ground in the frame of the site.
    pub footprint: Footprint,
}

impl NumberedLocation {
    /// The indices of locations in the order of their proposed codes, then of where they lie.
    pub(super) fn in_order(locations: &[Self]) -> Vec<usize> {
        let mut order: Vec<usize> = (0..locations.len()).collect();
        order.sort_by(|&one, &other| {
            let (one, other) = (&locations[one], &locations[other]);
            let (here, there) = (one.footprint.center, other.footprint.center);
            one.code.cmp(&other.code).then(here.x.total_cmp(&there.x)).then(here.y.total_cmp(&there.y))
        });
        order
    }
}

/// How far a map may speak for the site.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Trust {
    /// It is the newest map, and surely aligned: what it does not show is lost.
    Newest,
    /// It is the newest map, but its alignment is in doubt: every place that it shows is stale.
    Doubtful,
    /// A newer map tells which places there are; this one only has codes.
    Earlier,
}

/// The code of one location, and what people call it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct GivenCode {
    /// Key of its place in the registry.
    pub key: u32,
    /// Its code.
    pub code: String,
    /// Its name.
    pub name: Option<String>,
    /// Its groups.
    pub groups: Vec<String>,
    /// Whether a person should confirm that it is the right one.
    pub is_stale: bool,
}

/// A registry after a map was read with it.
#[derive(Debug, Clone, PartialEq)]
pub struct Carried {
    /// The registry with what is new, and the states of all places.
    pub registry: Registry,
    /// The codes, in the order of the locations.
    pub codes: Vec<GivenCode>,
}

impl Registry {
    /// Gives every location of a map its code. `scan` is the id under which places of this map are confirmed.
    #[must_use]
    pub fn carry(&self, locations: &[NumberedLocation], trust: Trust, scan: &str) -> Carried {
        let mut registry = self.clone();
        let known: Vec<Footprint> = self.entries.iter().map(RegistryEntry::footprint).collect();
        let found: Vec<Footprint> = locations.iter().map(|location| location.footprint.clone()).collect();
        let mut entry_of: Vec<Option<usize>> = vec![None; locations.len()];
        let mut is_seen = vec![false; known.len()];
        for pair in pairs(&known, &found) {
            let is_confirmed = self.entries[pair.old].confirmed_in.as_deref() == Some(scan);
            let is_sure = pair.share >= SURE_SHARE && !pair.has_rival && (trust != Trust::Doubtful || is_confirmed);
            (entry_of[pair.new], is_seen[pair.old]) = (Some(pair.old), true);
            if trust != Trust::Earlier {
                registry.entries[pair.old].see(&found[pair.new], is_sure);
            }
        }
        if trust != Trust::Earlier {
            for (entry, _) in registry.entries.iter_mut().zip(&is_seen).filter(|(_, seen)| !**seen) {
                entry.lose();
            }
        }
        let codes = registry.completed(locations, &entry_of, trust).into_iter().map(|entry| {
            let RegistryEntry { key, code, name, groups, state, .. } = registry.entries[entry].clone();
            GivenCode { key, code, name, groups, is_stale: state == PlaceState::Stale }
        });
        let codes = codes.collect();
        Carried { registry, codes }
    }

    /// Adds the locations without an entry, in the order of their proposed codes; the entries of all.
    fn completed(&mut self, locations: &[NumberedLocation], entry_of: &[Option<usize>], trust: Trust) -> Vec<usize> {
        let new = NumberedLocation::in_order(locations).into_iter().filter(|&index| entry_of[index].is_none());
        let mut used: BTreeSet<String> = self.entries.iter().map(|entry| entry.code.clone()).collect();
        let state = match trust {
            Trust::Newest => PlaceState::Current,
            Trust::Doubtful => PlaceState::Stale,
            Trust::Earlier => PlaceState::Lost,
        };
        // What has no entry gets its own below.
        let mut entries: Vec<usize> = entry_of.iter().map(|entry| entry.unwrap_or_default()).collect();
        for index in new {
            let NumberedLocation { code, footprint } = &locations[index];
            let code = unused(code, &used);
            used.insert(code.clone());
            entries[index] = self.add(code, footprint, state);
        }
        entries
    }
}

impl RegistryEntry {
    /// Takes note of ground that is, or may be, this place.
    fn see(&mut self, footprint: &Footprint, is_sure: bool) {
        // What was in doubt stays so until a person confirms it.
        if is_sure && self.state != PlaceState::Stale {
            self.state = PlaceState::Current;
        } else {
            self.state = PlaceState::Stale;
            self.seen = Some((footprint.outline.clone(), footprint.center));
        }
    }

    fn lose(&mut self) {
        self.state = PlaceState::Lost;
        self.seen = None;
    }
}
