//! Lengths of ways between many ends.
//!
//! Method: one search over the portals from each start to all goals, then each way is pulled tight at its portals. Cost:
//! O(portals) for each start and some sights for each pair; starts in parallel.

use rayon::prelude::*;

use super::ends::{End, Waypoint};
use super::no_route::RouteEnd;
use super::router::Router;
use super::search::{self, Passage, Reached};
use super::sight::{self, Sight};
use super::tile_search::TileSearch;
use crate::geometry::Point;
use crate::site_map::SiteMap;

impl Router {
    /// Lengths of the shortest routes from each of some waypoints to each of others, metres; rows are starts.
    ///
    /// They are those of [`Self::route`] to within two percent: pulled tight at the portals only. `None` where no route
    /// leads; [`Self::route`] says why.
    #[must_use]
    pub fn matrix(&self, map: &SiteMap<'_>, from: &[Waypoint<'_>], to: &[Waypoint<'_>]) -> Vec<Vec<Option<f64>>> {
        let find = |waypoint: &Waypoint<'_>, end| self.finder(map).find(waypoint, end);
        let goals: Vec<Option<End>> = to.par_iter().map(|waypoint| find(waypoint, RouteEnd::Goal).ok()).collect();
        let reached: Vec<Vec<Reached>> = goals
            .par_iter()
            .map_init(TileSearch::new, |search, goal| {
                goal.as_ref().map(|goal| self.reach(goal.cell, search)).unwrap_or_default()
            })
            .collect();
        let row = |search: &mut TileSearch, waypoint: &Waypoint<'_>| {
            let Ok(start) = find(waypoint, RouteEnd::Start) else { return vec![None; to.len()] };
            let tile = self.roads.tiles.of_cell(start.cell);
            let ways = search::to_many(&self.roads, &self.reach(start.cell, search), tile, &reached);
            let ends = goals.iter().zip(ways);
            ends.map(|(goal, way)| self.pulled_length(&start, goal.as_ref()?, way, search)).collect()
        };
        from.par_iter().map_init(TileSearch::new, row).collect()
    }

    fn pulled_length(
        &self,
        start: &End,
        goal: &End,
        way: Option<(Vec<Passage>, f32)>,
        search: &mut TileSearch,
    ) -> Option<f64> {
        let tiles = &self.roads.tiles;
        let sight = Sight { grid: &self.grid, clearance: &[], preferred: 0 };
        if start.lead[0] == goal.lead[0] {
            return Some(0.0);
        }
        let (passages, cost) = way.unzip();
        if tiles.of_cell(start.cell) == tiles.of_cell(goal.cell) {
            search.run(&self.grid, tiles.window(tiles.of_cell(start.cell)), start.cell);
            if let Some(cells) = search.length_to(goal.cell) {
                let direct = cells * self.grid.resolution;
                if cost.is_none_or(|cost| direct <= f64::from(cost)) {
                    let points = self.points(start.cell, goal.cell, &[], search);
                    return Some(whole_length(start, goal, &sight.pull(&points)));
                }
            }
        }
        let points = self.points(start.cell, goal.cell, &passages?, search);
        Some(whole_length(start, goal, &sight.pull(&points)))
    }
}

/// Length of a path and of the leads at its ends, metres.
fn whole_length(start: &End, goal: &End, path: &[Point]) -> f64 {
    sight::length(&start.lead) + sight::length(path) + sight::length(&goal.lead)
}
