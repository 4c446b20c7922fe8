//! The analysed maps in memory.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use tokio::sync::OnceCell;
use uuid::Uuid;

use super::map_context::MapContext;
use crate::store::MapState;

/// The contexts in memory, those used last first.
#[derive(Debug)]
pub(super) struct ContextCache {
    capacity: usize,
    entries: Mutex<Vec<Arc<Entry>>>,
}

/// A context that is there or being built.
#[derive(Debug)]
pub(super) struct Entry {
    map: Uuid,
    state: MapState,
    pub(super) context: OnceCell<Arc<MapContext>>,
    /// What was known before the last change: its geometry need not be read again. Forgotten when the context is built.
    previous: Mutex<Option<Arc<MapContext>>>,
}

impl Entry {
    /// What was known before the last change.
    pub(super) fn previous(&self) -> Option<Arc<MapContext>> {
        self.lock_previous().clone()
    }

    fn lock_previous(&self) -> MutexGuard<'_, Option<Arc<MapContext>>> {
        self.previous.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl ContextCache {
    pub(super) const fn new(capacity: usize) -> Self {
        Self { capacity, entries: Mutex::new(Vec::new()) }
    }

    /// Forgets a map.
    pub(super) fn remove(&self, map: Uuid) {
        self.entries().retain(|entry| entry.map != map);
    }

    /// The entry of a map in this state, moved to the front. One of an earlier state gives way to a new one, which keeps
    /// what was built before: whoever is still building it answers those who asked before the change, and nobody else.
    pub(super) fn entry(&self, map: Uuid, state: MapState) -> Arc<Entry> {
        let mut entries = self.entries();
        let found = entries.iter().position(|entry| entry.map == map).map(|index| entries.remove(index));
        let entry = match found {
            Some(entry) if entry.state == state => entry,
            earlier => {
                let previous = earlier.and_then(|stale| stale.context.get().cloned().or_else(|| stale.previous()));
                Arc::new(Entry { map, state, context: OnceCell::new(), previous: Mutex::new(previous) })
            }
        };
        entries.insert(0, Arc::clone(&entry));
        entry
    }

    /// Keeps an entry that holds something, and as many others as fit; drops one that came to nothing, so that questions
    /// about maps that do not exist push nothing out.
    pub(super) fn settle(&self, settled: &Arc<Entry>, is_built: bool) {
        let mut entries = self.entries();
        if !is_built {
            entries.retain(|entry| !Arc::ptr_eq(entry, settled));
            return;
        }
        *settled.lock_previous() = None;
        let mut kept = 0;
        entries.retain(|entry| {
            let is_kept = entry.context.initialized() || entry.lock_previous().is_some();
            kept += usize::from(is_kept);
            // One that nobody builds any more was given up by whoever asked.
            if is_kept { kept <= self.capacity.max(1) } else { Arc::strong_count(entry) > 1 }
        });
    }

    fn entries(&self) -> MutexGuard<'_, Vec<Arc<Entry>>> {
        // Every statement above leaves the list whole.
        self.entries.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
