//! Lengths of ways between many ends.
//!
//! Method: one search over the portals from each start to all goals; its ways are a tree, which is pulled tight from the
//! start outwards, each stretch once for all goals behind it. Cost: O(portals) for each start and a sight for each portal of
//! the tree; starts in parallel.

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::ends::{End, Waypoint};
use super::no_route::RouteEnd;
use super::router::Router;
use super::search::{self, Passage, Reached};
use super::sight::{self, Sight};
use super::tile_search::TileSearch;
use super::tile_ways::PortalId;
use crate::geometry::Point;
use crate::site_map::SiteMap;

impl Router {
    /// Lengths of the shortest routes from each of some waypoints to each of others, metres; rows are starts.
    ///
    /// They are those of [`Self::route`] to within three percent: pulled tight at the portals only. `None` where no route
    /// leads; [`Self::route`] says why.
    #[must_use]
    pub fn matrix(&self, map: &SiteMap<'_>, from: &[Waypoint<'_>], to: &[Waypoint<'_>]) -> Vec<Vec<Option<f64>>> {
        let end = |waypoint: &Waypoint<'_>, end| self.finder(map).find(waypoint, end).ok();
        let goal = |search: &mut TileSearch, waypoint: &Waypoint<'_>| {
            end(waypoint, RouteEnd::Goal).map(|goal| MatrixEnd::new(self, goal, search))
        };
        let goals: Vec<Option<MatrixEnd>> = to.par_iter().map_init(TileSearch::new, goal).collect();
        let reached: Vec<&[Reached]> =
            goals.iter().map(|goal| goal.as_ref().map_or(&[][..], |goal| &goal.reached)).collect();
        let row = |search: &mut TileSearch, waypoint: &Waypoint<'_>| {
            let Some(start) = end(waypoint, RouteEnd::Start) else { return vec![None; to.len()] };
            self.row(&start, &goals, &reached, search)
        };
        from.par_iter().map_init(TileSearch::new, row).collect()
    }

    /// Lengths from one start to all goals.
    fn row(
        &self,
        start: &End,
        goals: &[Option<MatrixEnd>],
        reached: &[&[Reached]],
        search: &mut TileSearch,
    ) -> Vec<Option<f64>> {
        let tiles = &self.roads.tiles;
        let start = MatrixEnd::new(self, start.clone(), search);
        let tile = tiles.of_cell(start.end.cell);
        let ways = search::to_many(&self.roads, &start.reached, tile, reached);
        let mut tree = PulledTree { router: self, start: &start, pulled: BTreeMap::new() };
        let length = |(goal, way): (&Option<MatrixEnd>, Option<(Vec<Passage>, f32)>)| {
            let goal = goal.as_ref()?;
            if start.end.lead[0] == goal.end.lead[0] {
                return Some(0.0);
            }
            let is_beside = tiles.of_cell(goal.end.cell) == tile;
            let direct = if is_beside { search.length_to(goal.end.cell) } else { None };
            let direct = direct.map(|cells| cells * self.grid.resolution);
            let pulled = match (direct, way) {
                (Some(direct), way) if way.as_ref().is_none_or(|way| direct <= f64::from(way.1)) => {
                    let mut pulled = Pulled::at(self.grid.center(start.end.cell));
                    for cell in search.path_to(goal.end.cell) {
                        pulled.go(self.grid.center(cell), tree.sight());
                    }
                    pulled
                }
                (_, Some((passages, _))) => tree.along(&passages, goal),
                (_, None) => return None,
            };
            Some(sight::length(&start.end.lead) + pulled.length() + sight::length(&goal.end.lead))
        };
        goals.iter().zip(ways).map(length).collect()
    }
}

/// An end of the ways of a matrix, with its ways to the portals of its tile.
struct MatrixEnd {
    end: End,
    reached: Vec<Reached>,
    /// The points between the end and a portal, both excluded, where the way bends; by portal.
    ways: BTreeMap<PortalId, Vec<Point>>,
}

impl MatrixEnd {
    /// Leaves the search as it is after a run from the cell of the end.
    fn new(router: &Router, end: End, search: &mut TileSearch) -> Self {
        let reached = router.reach(end.cell, search);
        let sight = Sight { grid: &router.grid, clearance: &[], preferred: 0 };
        let portals = &router.roads.ways(router.roads.tiles.of_cell(end.cell)).portals;
        let way = |cell: usize| {
            let path = search.path_to(cell);
            let points: Vec<Point> =
                std::iter::once(&end.cell).chain(&path).map(|&cell| router.grid.center(cell)).collect();
            let mut pulled = sight.pull(&points);
            pulled.truncate(pulled.len().saturating_sub(1));
            pulled.into_iter().skip(1).collect()
        };
        let is_reached = |portal: PortalId| reached.iter().any(|&(other, _)| other == portal);
        let ways = portals.iter().filter(|portal| is_reached(portal.id)).map(|portal| (portal.id, way(portal.cell)));
        let ways = ways.collect();
        Self { end, reached, ways }
    }
}

/// A path that is pulled tight while it grows.
#[derive(Debug, Clone, Copy)]
struct Pulled {
    /// The last point that is kept, and the length up to it, metres.
    kept: Point,
    length: f64,
    /// Its end, in sight of the point that is kept.
    last: Point,
}

impl Pulled {
    fn at(point: Point) -> Self {
        Self { kept: point, length: 0.0, last: point }
    }

    /// Goes on to a point that can be reached from the last one.
    fn go(&mut self, point: Point, sight: Sight<'_>) {
        if point != self.last && !sight.sees(self.kept, point) {
            self.length += (self.last - self.kept).norm();
            self.kept = self.last;
        }
        self.last = point;
    }

    fn length(&self) -> f64 {
        self.length + (self.last - self.kept).norm()
    }
}

/// The ways from one start, pulled tight up to each portal that one of them enters.
struct PulledTree<'a> {
    router: &'a Router,
    start: &'a MatrixEnd,
    pulled: BTreeMap<PortalId, Pulled>,
}

impl PulledTree<'_> {
    fn sight(&self) -> Sight<'_> {
        Sight { grid: &self.router.grid, clearance: &[], preferred: 0 }
    }

    /// A way over portals to a goal.
    fn along(&mut self, passages: &[Passage], goal: &MatrixEnd) -> Pulled {
        let (router, start) = (self.router, self.start);
        let center = |cell: usize| router.grid.center(cell);
        let goal_tile = router.roads.tiles.of_cell(goal.end.cell);
        let nexts = passages.iter().skip(1).map(|next| next.through).chain([goal_tile]);
        let mut pulled = Pulled::at(center(start.end.cell));
        let mut before = None;
        for (&Passage { portal, through }, next) in passages.iter().zip(nexts) {
            let [enter, leave] = router.cells_through(portal, through);
            if let Some(&known) = self.pulled.get(&portal) {
                pulled = known;
            } else {
                let mut bends = Vec::new();
                match before {
                    Some(before) => router.bend(through, [before, portal], &mut bends),
                    None => bends.extend(start.ways.get(&portal).into_iter().flatten()),
                }
                bends.push(center(enter));
                for point in bends {
                    pulled.go(point, self.sight());
                }
                self.pulled.insert(portal, pulled);
            }
            // A way may go back into the tile that it comes from.
            if next != through {
                pulled.go(center(leave), self.sight());
            }
            before = Some(portal);
        }
        let rest = before.and_then(|portal| goal.ways.get(&portal)).into_iter().flatten().rev().copied();
        for point in rest.chain([center(goal.end.cell)]) {
            pulled.go(point, self.sight());
        }
        pulled
    }
}
