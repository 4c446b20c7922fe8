//! The routers and navigation graphs of a map: made when they are first asked for, the latest kept.

use std::sync::Arc;

use stillage_core::SiteMap;
use stillage_core::graph::{NavigationGraph, navigation_graph};
use stillage_core::lane_rule::LaneRule;
use stillage_core::layout::Layout;
use stillage_core::routing::{Blocked, Router};

use super::latest::Latest;

/// Routers kept for a map: each has some 4 bytes per cell, and a fleet has few kinds of vehicles.
const KEPT: usize = 4;

/// What a router is made for: the bits of its radius, and what is blocked.
type RouterKey = (u64, Blocked);

/// The routers of a map, and the graph of each kind of vehicle by the bits of its radius.
#[derive(Debug, Default)]
pub struct RouterCache {
    routers: Latest<RouterKey, Router, KEPT>,
    graphs: Latest<u64, NavigationGraph, KEPT>,
}

impl RouterCache {
    /// The router for vehicles of a radius in metres around what is blocked. The first call makes it: O(cells).
    pub(super) fn router(&self, map: &SiteMap<'_>, radius: f64, blocked: Blocked) -> Arc<Router> {
        self.routers.get_or_make((radius.to_bits(), blocked), |(_, blocked)| {
            if blocked.is_empty() {
                Router::new(map, radius)
            } else {
                self.router(map, radius, Blocked::default()).around(map, blocked.clone())
            }
        })
    }

    /// The navigation graph for vehicles of a radius in metres, under rules in the grid frame. The first call makes it.
    pub(super) fn graph(
        &self,
        map: &SiteMap<'_>,
        layout: &Layout,
        rules: &[LaneRule],
        radius: f64,
    ) -> Arc<NavigationGraph> {
        self.graphs.get_or_make(radius.to_bits(), |_| {
            navigation_graph(map, layout, &self.router(map, radius, Blocked::default())).ruled(rules)
        })
    }
}
