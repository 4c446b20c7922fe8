//! Several routes that differ.
//!
//! Method: what a route used costs more for the next one (the penalty method). Routes are told apart by the tiles that they
//! cross. Cost: that of some routes for each that is found.

use std::collections::BTreeSet;

use super::ends::Waypoint;
use super::ground_cost::GroundCost;
use super::no_route::NoRoute;
use super::route::{Preferences, Route};
use super::router::Router;
use crate::site_map::SiteMap;

/// Tries for each route: some only repeat others.
const TRIES: usize = 3;
/// Greatest share of the tiles of a route that another one may have in common with it.
const SHARED: f64 = 0.7;
/// Longest detour, as a multiple of the best route.
const LONGEST: f64 = 2.0;

impl Router {
    /// Finds up to `count` routes that differ, the best first.
    ///
    /// # Errors
    /// [`NoRoute`] when there is none at all.
    pub fn alternatives(
        &self,
        map: &SiteMap<'_>,
        from: &Waypoint<'_>,
        to: &Waypoint<'_>,
        preferences: &Preferences,
        count: usize,
    ) -> Result<Vec<Route>, NoRoute> {
        let [start, goal] = self.ends(map, from, to)?;
        let mut ground = GroundCost::new(map, preferences, self.radius());
        let mut found: Vec<(Route, BTreeSet<usize>)> = Vec::new();
        for _ in 0..count.max(1) * TRIES {
            let Some(way) = self.way(&start, &goal, &ground) else { break };
            let tiles: BTreeSet<usize> = way.passages.iter().map(|passage| passage.through).collect();
            ground.avoid(&tiles);
            let differs = found.iter().all(|(_, others)| {
                tiles.intersection(others).count() as f64 <= SHARED * tiles.len().min(others.len()) as f64
            });
            if found.is_empty() || differs {
                let route = self.finish(map, &way, &start, &goal, preferences.profile);
                if found.first().is_none_or(|(best, _)| route.length <= LONGEST * best.length) {
                    found.push((route, tiles));
                }
            }
            if found.len() >= count.max(1) {
                break;
            }
        }
        if found.is_empty() {
            return Err(self.why_not(map, &start, &goal));
        }
        let mut routes: Vec<Route> = found.into_iter().map(|(route, _)| route).collect();
        routes[1..].sort_by(|one, other| one.length.total_cmp(&other.length));
        Ok(routes)
    }
}
