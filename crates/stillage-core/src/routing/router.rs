//! Routes for vehicles of one radius.
//!
//! Cost: O(cells) to make one; then a route costs what its search sees, milliseconds on the largest maps.

use std::collections::BTreeSet;
use std::sync::Arc;

use super::bottleneck::bottleneck;
use super::drive_grid::{DriveGrid, window_of};
use super::ends::{End, EndFinder, Waypoint};
use super::face_steps::{Blocked, FaceSteps};
use super::ground_cost::GroundCost;
use super::no_route::{NoRoute, RouteEnd};
use super::road_map::RoadMap;
use super::route::{Preferences, Route, RouteProfile};
use super::search::{self, Landmarks, Passage, Reached};
use super::sight::{self, Sight};
use super::tile_search::TileSearch;
use super::tile_ways::PortalId;
use super::ways_out::WaysOut;
use crate::arrangement::FaceId;
use crate::geometry::Point;
use crate::site_map::SiteMap;

/// Finds routes for vehicles of one radius, around what is blocked.
#[derive(Debug, Clone)]
pub struct Router {
    radius: f64,
    steps: FaceSteps,
    pub(super) grid: DriveGrid,
    /// All floor on which the vehicle fits, whatever its label.
    floor: DriveGrid,
    ways_out: WaysOut,
    pub(super) roads: RoadMap,
    landmarks: Landmarks,
    blocked: Blocked,
    /// The router without what is blocked.
    open: Option<Arc<Self>>,
}

/// A way before it is pulled tight.
pub(super) struct Way {
    points: Vec<Point>,
    pub passages: Vec<Passage>,
}

impl Router {
    /// Prepares routes for vehicles of a radius in metres; 0 is a point.
    #[must_use]
    pub fn new(map: &SiteMap<'_>, radius: f64) -> Self {
        let blocked = Blocked::default();
        let steps = FaceSteps::new(map, &blocked);
        let grid = DriveGrid::new(map, &steps, radius);
        let floor = DriveGrid::new(map, &FaceSteps::over_all_floor(map, &blocked), radius);
        let ways_out = WaysOut::new(&grid, &floor);
        let roads = RoadMap::new(&grid);
        let landmarks = Landmarks::new(&roads);
        Self { radius, steps, grid, floor, ways_out, roads, landmarks, blocked, open: None }
    }

    /// The same without some faces and edges. O(cells) to copy, and the tiles around them anew.
    #[must_use]
    pub fn around(self: &Arc<Self>, map: &SiteMap<'_>, blocked: Blocked) -> Self {
        let subdivision = &map.analysis.subdivision;
        let beside = blocked.edges.iter().flat_map(|&edge| subdivision.sides(edge));
        let faces: Vec<FaceId> =
            beside.chain(blocked.faces.iter().copied()).filter(|&face| face != FaceId::OUTER).collect();
        let [_, rows] = window_of(map, &faces);
        let steps = FaceSteps::new(map, &blocked);
        let grid = self.grid.without(map, &steps, rows.clone());
        let floor = self.floor.without(map, &FaceSteps::over_all_floor(map, &blocked), rows.clone());
        let members: BTreeSet<FaceId> = faces.into_iter().collect();
        let cells = rows.start * grid.width..rows.end * grid.width;
        let changed: BTreeSet<usize> = cells
            .filter(|&cell| members.contains(&map.cells.of_cell(cell)))
            .map(|cell| self.roads.tiles.of_cell(cell))
            .collect();
        let roads = self.roads.renewed(&grid, &changed);
        // Ways only get longer, so the bounds of the landmarks still hold, except those of portals that moved.
        let landmarks = if blocked.is_empty() { self.landmarks.clone() } else { Landmarks::default() };
        let ways_out = WaysOut::new(&grid, &floor);
        Self {
            radius: self.radius,
            steps,
            grid,
            floor,
            ways_out,
            roads,
            landmarks,
            blocked,
            open: Some(Arc::clone(self)),
        }
    }

    /// The radius of the vehicles, metres.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Whether a vehicle drives straight from one point to another.
    #[must_use]
    pub fn sees(&self, from: Point, to: Point) -> bool {
        let are_inside = [from, to].iter().all(|&point| self.can_begin(point));
        are_inside && Sight { grid: &self.grid, clearance: &[], preferred: 0 }.sees(from, to)
    }

    /// The least clearance of the cells that a path crosses, metres.
    #[must_use]
    pub fn clearance_along(&self, map: &SiteMap<'_>, path: &[Point]) -> f64 {
        sight::clearance_along(&self.grid, path, |cell| map.clearance.of_cell(cell))
    }

    /// The shortest route between two points; `None` where none leads, without asking why.
    #[must_use]
    pub fn shortest(&self, map: &SiteMap<'_>, from: Point, to: Point) -> Option<Route> {
        let preferences = Preferences::default();
        let [start, goal] = self.ends(map, &Waypoint::Point(from), &Waypoint::Point(to)).ok()?;
        let way = self.way(&start, &goal, &GroundCost::new(map, &preferences, self.radius))?;
        Some(self.finish(map, &way, &start, &goal, preferences.profile))
    }

    /// Finds the best route.
    ///
    /// The path begins and ends at the points that are given (where the vehicle fits on the middle of their cell alone, on
    /// that), at a point well inside faces, and at the approach pose of locations.
    ///
    /// # Errors
    /// [`NoRoute`] says why there is none, where, and what would do.
    pub fn route(
        &self,
        map: &SiteMap<'_>,
        from: &Waypoint<'_>,
        to: &Waypoint<'_>,
        preferences: &Preferences,
    ) -> Result<Route, NoRoute> {
        let [start, goal] = self.ends(map, from, to)?;
        let ground = GroundCost::new(map, preferences, self.radius);
        let way = self.way(&start, &goal, &ground).ok_or_else(|| self.why_not(map, &start, &goal))?;
        Ok(self.finish(map, &way, &start, &goal, preferences.profile))
    }

    pub(super) fn finder<'a>(&'a self, map: &'a SiteMap<'a>) -> EndFinder<'a> {
        let Self { grid, floor, ways_out, blocked, radius, .. } = self;
        EndFinder { map, grid, floor, ways_out, radius: *radius, blocked }
    }

    pub(super) fn ends(&self, map: &SiteMap<'_>, from: &Waypoint<'_>, to: &Waypoint<'_>) -> Result<[End; 2], NoRoute> {
        let finder = self.finder(map);
        Ok([finder.find(from, RouteEnd::Start)?, finder.find(to, RouteEnd::Goal)?])
    }

    /// The portals of its tile that a cell reaches.
    pub(super) fn reach(&self, cell: usize, search: &mut TileSearch) -> Vec<Reached> {
        let tile = self.roads.tiles.of_cell(cell);
        search.run(&self.grid, self.roads.tiles.window(tile), cell);
        let half = 0.5 * self.grid.resolution;
        let length = |cell: usize| search.length_to(cell).map(|cells| (cells * self.grid.resolution + half) as f32);
        let portals = self.roads.ways(tile).portals.iter();
        portals.filter_map(|portal| Some((portal.id, length(portal.cell)?))).collect()
    }

    pub(super) fn way(&self, start: &End, goal: &End, ground: &GroundCost<'_>) -> Option<Way> {
        let mut search = TileSearch::new();
        let tiles = &self.roads.tiles;
        let to = self.reach(goal.cell, &mut search);
        let from = self.reach(start.cell, &mut search);
        let direct = (tiles.of_cell(start.cell) == tiles.of_cell(goal.cell))
            .then(|| search.length_to(goal.cell))
            .flatten()
            .map(|cells| (cells * self.grid.resolution) as f32);
        let component = |&(portal, _): &Reached| self.roads.component(portal);
        if direct.is_none() && !from.iter().any(|one| to.iter().any(|other| component(one) == component(other))) {
            return None;
        }
        let goal_point = self.grid.center(goal.cell);
        let start_tile = tiles.of_cell(start.cell);
        let ends = [from.as_slice(), to.as_slice()];
        let around = search::cheapest(&self.roads, &self.landmarks, &self.grid, ground, ends, start_tile, goal_point);
        let passages = match (direct, around) {
            (Some(direct), Some((_, cost))) if direct <= cost => Vec::new(),
            (_, Some((passages, _))) => passages,
            (Some(_), None) => Vec::new(),
            (None, None) => return None,
        };
        let points = self.points(start.cell, goal.cell, &passages, &mut search);
        Some(Way { points, passages })
    }

    /// The points of a way over portals; each can be reached from the one before.
    fn points(&self, start: usize, goal: usize, passages: &[Passage], search: &mut TileSearch) -> Vec<Point> {
        let tiles = &self.roads.tiles;
        let center = |cell: usize| self.grid.center(cell);
        let mut points = vec![center(start)];
        // The portal from which the way comes, in its tile.
        let mut last: Option<(PortalId, usize)> = None;
        let nexts = passages.iter().skip(1).map(|next| next.through).chain([tiles.of_cell(goal)]);
        for (passage, next) in passages.iter().zip(nexts) {
            let [enter, leave] = self.cells_through(passage.portal, passage.through);
            match last {
                Some((from, _)) => self.bend(passage.through, [from, passage.portal], &mut points),
                None => self.drive(start, enter, search, &mut points),
            }
            points.push(center(enter));
            // A way may go back into the tile that it comes from.
            let is_crossed = next != passage.through;
            if is_crossed {
                points.push(center(leave));
            }
            last = Some((passage.portal, if is_crossed { leave } else { enter }));
        }
        self.drive(last.map_or(start, |(_, cell)| cell), goal, search, &mut points);
        points.push(center(goal));
        points
    }

    /// The cells of a portal as a way comes to it through a tile: in that tile, and beyond.
    pub(super) fn cells_through(&self, portal: PortalId, tile: usize) -> [usize; 2] {
        let [one, other] = self.roads.cells(portal);
        if self.roads.tiles.of_cell(one) == tile { [one, other] } else { [other, one] }
    }

    /// Adds the points where the way between two portals of a tile bends.
    pub(super) fn bend(&self, tile: usize, portals: [PortalId; 2], points: &mut Vec<Point>) {
        let ways = self.roads.ways(tile);
        let [Some(from), Some(to)] = portals.map(|portal| ways.place_of(portal)) else { return };
        let bends = ways.bends(from, to).map(|cell| self.grid.center(cell));
        if from < to { points.extend(bends) } else { points.extend(bends.rev()) }
    }

    /// Adds the points between two cells of a tile.
    fn drive(&self, from: usize, to: usize, search: &mut TileSearch, points: &mut Vec<Point>) {
        let sight = Sight { grid: &self.grid, clearance: &[], preferred: 0 };
        if sight.sees(self.grid.center(from), self.grid.center(to)) {
            return;
        }
        search.run(&self.grid, self.roads.tiles.window(self.roads.tiles.of_cell(from)), from);
        let path = search.path_to(to);
        points.extend(path.iter().take(path.len().saturating_sub(1)).map(|&cell| self.grid.center(cell)));
    }

    /// Whether a point lies on a cell that routes lead over.
    fn can_begin(&self, point: Point) -> bool {
        self.grid.cell_at(point).is_some_and(|cell| self.grid.fits(cell))
    }

    /// Pulls a way tight and says what there is to say of it.
    pub(super) fn finish(&self, map: &SiteMap<'_>, way: &Way, start: &End, goal: &End, profile: RouteProfile) -> Route {
        let clearance = map.clearance.steps();
        let preferred = match profile {
            RouteProfile::Shortest => 0,
            RouteProfile::Clearance => map.clearance.threshold(GroundCost::preferred_clearance(self.radius)),
        };
        let sight = Sight { grid: &self.grid, clearance, preferred };
        if start.lead[0] == goal.lead[0] {
            return standing(map, start.lead[0], goal.heading);
        }
        // Leads over other ground are tight; the last point of one near an end may move.
        let [mut before, mut after] = [start, goal].map(|end| end.lead.clone());
        let is_short = |lead: &[Point]| lead.len() <= 2 && lead.iter().all(|&point| self.can_begin(point));
        let mut points = if is_short(&before) { std::mem::take(&mut before) } else { Vec::new() };
        points.extend(&way.points);
        if is_short(&after) {
            points.extend(std::mem::take(&mut after).iter().rev());
        }
        points.dedup();
        let mut path = before;
        path.extend(sight.pull_tight(&points));
        path.extend(after.iter().rev());
        path.dedup();
        if path.len() == 1 {
            path.push(path[0]);
        }
        self.described(map, path, goal.heading)
    }

    /// A path with all that there is to say of it.
    pub(super) fn described(&self, map: &SiteMap<'_>, path: Vec<Point>, goal_heading: Option<f64>) -> Route {
        let (faces, edges) = sight::faces_along(&self.grid, map, &self.steps, &path);
        let clearance = self.clearance_along(map, &path);
        Route { length: sight::length(&path), path, faces, edges, clearance, goal_heading }
    }

    /// Why two ends are not joined.
    pub(super) fn why_not(&self, map: &SiteMap<'_>, start: &End, goal: &End) -> NoRoute {
        let plain = GroundCost::new(map, &Preferences::default(), self.radius);
        if self.open.as_ref().is_some_and(|open| open.way(start, goal, &plain).is_some()) {
            return NoRoute::CutOff;
        }
        let open = self.open.as_deref().unwrap_or(self);
        let [from, to] = [start, goal].map(|end| map.cells.of_cell(end.cell));
        // Most faces are told apart without looking at cells.
        let is_hub = |cell: usize| open.roads.is_hub(cell);
        let narrowest = || bottleneck(map, &open.steps, is_hub, [start.cell, goal.cell]);
        match open.steps.are_connected(from, to).then(narrowest).flatten() {
            Some(cell) => NoRoute::TooNarrow { clearance: map.clearance.of_cell(cell), at: self.grid.center(cell) },
            None => NoRoute::Disconnected { from, to },
        }
    }
}

/// The route of a vehicle that is there already.
fn standing(map: &SiteMap<'_>, point: Point, goal_heading: Option<f64>) -> Route {
    let clearance = map.clearance.at(point);
    let faces = vec![map.face_at(point)];
    Route { path: vec![point; 2], length: 0.0, faces, edges: Vec::new(), clearance, goal_heading }
}
