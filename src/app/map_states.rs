//! The states of maps, as long as nothing is written.

use std::collections::HashMap;
use std::sync::{Mutex, MutexGuard, PoisonError};

use uuid::Uuid;

use crate::records::Tenant;
use crate::store::MapState;

/// What was read since the last write. It saves each question a look into the database: without it, the look takes longer
/// than all else about an answer from memory.
#[derive(Debug, Default)]
pub(super) struct MapStates(Mutex<Read>);

/// The states read after some number of writes.
#[derive(Debug, Default)]
struct Read {
    writes: u64,
    states: HashMap<Uuid, (Tenant, MapState)>,
}

impl MapStates {
    /// The state of a tenant's map, if it was read after this number of writes.
    pub(super) fn get(&self, writes: u64, tenant: &Tenant, map: Uuid) -> Option<MapState> {
        let read = self.read();
        let (owner, state) = read.states.get(&map).filter(|_| read.writes == writes)?;
        (owner == tenant).then_some(*state)
    }

    /// Keeps a state that was read after this number of writes. Those read before a later one are forgotten.
    pub(super) fn put(&self, writes: u64, tenant: &Tenant, map: Uuid, state: MapState) {
        let mut read = self.read();
        if writes > read.writes {
            read.states.clear();
            read.writes = writes;
        }
        if writes == read.writes {
            read.states.insert(map, (tenant.clone(), state));
        }
    }

    fn read(&self) -> MutexGuard<'_, Read> {
        // Every statement above leaves it whole.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_write_makes_every_state_unknown() {
        let (states, map, tenant) = (MapStates::default(), Uuid::now_v7(), Tenant::local());
        let state = |version| MapState { version, analysis: None, semantics: 0 };
        states.put(4, &tenant, map, state(1));
        assert_eq!(states.get(4, &tenant, map), Some(state(1)));
        assert_eq!(states.get(5, &tenant, map), None);
        states.put(5, &tenant, map, state(2));
        states.put(4, &tenant, map, state(1));
        assert_eq!(states.get(5, &tenant, map), Some(state(2)), "an earlier reading comes too late");
    }

    #[test]
    fn a_tenant_does_not_see_the_state_of_another_ones_map() {
        let (states, map) = (MapStates::default(), Uuid::now_v7());
        states.put(0, &Tenant::local(), map, MapState { version: 1, analysis: None, semantics: 0 });
        assert_eq!(states.get(0, &Tenant::new("other"), map), None);
    }
}
