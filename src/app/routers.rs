//! The routers of a map: made when they are first asked for, the latest kept.

use std::sync::{Arc, Mutex, PoisonError};

use stillage_core::SiteMap;
use stillage_core::routing::{Blocked, Router};

/// Routers kept for a map: each has some 4 bytes per cell, and a fleet has few kinds of vehicles.
const KEPT: usize = 4;

/// What a router is made for: the bits of its radius, and what is blocked.
type RouterKey = (u64, Blocked);

/// The routers of a map, the latest last.
#[derive(Debug, Default)]
pub struct RouterCache(Mutex<Vec<(RouterKey, Arc<Router>)>>);

impl RouterCache {
    /// The router for vehicles of a radius in metres around what is blocked. The first call makes it: O(cells).
    pub(super) fn router(&self, map: &SiteMap<'_>, radius: f64, blocked: Blocked) -> Arc<Router> {
        let key = (radius.to_bits(), blocked);
        if let Some(router) = self.find(&key) {
            return router;
        }
        let router = if key.1.is_empty() {
            Router::new(map, radius)
        } else {
            self.router(map, radius, Blocked::default()).around(map, key.1.clone())
        };
        let router = Arc::new(router);
        // Two that ask at once make it twice; a panic elsewhere leaves whole entries.
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        kept.push((key, Arc::clone(&router)));
        if kept.len() > KEPT {
            kept.remove(0);
        }
        router
    }

    fn find(&self, key: &RouterKey) -> Option<Arc<Router>> {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let place = kept.iter().position(|(other, _)| other == key)?;
        let found = kept.remove(place);
        let router = Arc::clone(&found.1);
        kept.push(found);
        Some(router)
    }
}
