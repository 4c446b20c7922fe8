//! Routes of vehicles that are longer than wide: through aisles in which they cannot turn.
//!
//! Method: a vehicle passes where the largest circle within its outline fits, and turns where the circle around it fits. A
//! route for either circle is found; those of the small one turn at the nearest ground that is wide enough, and count if the
//! ground that the outline sweeps is clear. The shortest is answered. Cost: three routes and the cells that they sweep.
//! Limits: a way may be missed that needs turns elsewhere; the vehicle drives forwards only.

use super::ends::Waypoint;
use super::no_route::NoRoute;
use super::route::{Preferences, Route, RouteProfile};
use super::router::Router;
use super::vehicle_outline::VehicleOutline;
use crate::geometry::{Point, Vector};
use crate::site_map::SiteMap;

/// How far a turn is moved at most, as a multiple of the turning radius: beyond the corner of an aisle.
const FARTHEST_TURN: f64 = 2.0;

/// The routers of a vehicle with an outline.
#[derive(Debug, Clone, Copy)]
pub struct OutlineRouters<'a> {
    /// For [`VehicleOutline::turning_radius`].
    pub turning: &'a Router,
    /// For [`VehicleOutline::passing_radius`].
    pub passing: &'a Router,
}

impl OutlineRouters<'_> {
    /// Finds the shortest route on which the outline touches nothing. At a location where the vehicle cannot turn to look at
    /// it, the route has no heading at its goal.
    ///
    /// # Errors
    /// [`NoRoute`] says why there is none, where, and what would do.
    pub fn route(
        &self,
        map: &SiteMap<'_>,
        outline: &VehicleOutline,
        from: &Waypoint<'_>,
        to: &Waypoint<'_>,
        preferences: &Preferences,
    ) -> Result<Route, NoRoute> {
        let mut best = self.turning.route(map, from, to, preferences);
        for profile in [preferences.profile, RouteProfile::Clearance] {
            let preferences = Preferences { profile, ..preferences.clone() };
            let route = match self.passing.route(map, from, to, &preferences) {
                Ok(route) => self.turned_where_wide(map, &route),
                Err(reason) => return best.map_err(|_| reason),
            };
            let is_shorter = best.as_ref().map_or(true, |best| route.length < best.length);
            match first_touch(map, outline, &route.path) {
                None if is_shorter => best = Ok(looking_where_possible(map, outline, route)),
                Some(at) if best.is_err() => {
                    best = Err(NoRoute::CannotTurn { at, clearance: map.clearance.at(at) });
                }
                _ => {}
            }
        }
        best
    }

    /// The route with each turn moved to the nearest ground on which the vehicle turns freely, where that can be seen.
    fn turned_where_wide(&self, map: &SiteMap<'_>, route: &Route) -> Route {
        let radius = self.turning.radius();
        let mut path = route.path.clone();
        for turn in 1..path.len().saturating_sub(1) {
            let (before, at, after) = (path[turn - 1], path[turn], path[turn + 1]);
            if map.clearance.at(at) >= radius {
                continue;
            }
            let is_seen = |&spot: &Point| self.passing.sees(before, spot) && self.passing.sees(spot, after);
            if let Some(spot) = wide_spots(map, at, radius).into_iter().find(is_seen) {
                path[turn] = spot;
            }
        }
        self.passing.described(map, path, route.goal_heading)
    }
}

/// The middles of cells near a point that are as far from obstacles as a radius, nearest first.
fn wide_spots(map: &SiteMap<'_>, around: Point, radius: f64) -> Vec<Point> {
    let Some((column, row)) = map.grid.cell_at(around) else { return Vec::new() };
    let farthest = FARTHEST_TURN * radius;
    let reach = (farthest / map.grid.resolution()).ceil() as usize;
    let range = |place: usize, count: usize| place.saturating_sub(reach)..(place + reach + 1).min(count);
    let cells =
        range(row, map.grid.height()).flat_map(|row| range(column, map.grid.width()).map(move |column| (column, row)));
    let distance = |spot: &Point| (spot - around).norm_squared();
    let mut spots: Vec<Point> = cells
        .map(|(column, row)| map.grid.center(column, row))
        .filter(|spot| map.clearance.at(*spot) >= radius && distance(spot) <= farthest * farthest)
        .collect();
    spots.sort_by(|one, other| distance(one).total_cmp(&distance(other)));
    spots
}

/// Where an outline first touches something on a path.
fn first_touch(map: &SiteMap<'_>, outline: &VehicleOutline, path: &[Point]) -> Option<Point> {
    let angle = |way: Vector| way.y.atan2(way.x);
    let ways: Vec<[Point; 2]> =
        path.windows(2).map(|pair| [pair[0], pair[1]]).filter(|[start, end]| start != end).collect();
    let turns = ways.windows(2).find(|pair| {
        let angles = [angle(pair[0][1] - pair[0][0]), angle(pair[1][1] - pair[1][0])];
        outline.touches_turning(map.grid, pair[1][0], angles)
    });
    let turned = turns.map(|pair| pair[1][0]);
    turned.or_else(|| ways.iter().find_map(|&way| outline.touches_along(map.grid, way)))
}

/// The route without the heading at its goal where the vehicle cannot turn to it.
fn looking_where_possible(map: &SiteMap<'_>, outline: &VehicleOutline, route: Route) -> Route {
    let last = route.path.windows(2).rev().map(|pair| pair[1] - pair[0]).find(|way| *way != Vector::zeros());
    let goal_heading = route.goal_heading.filter(|&heading| {
        let goal = route.path[route.path.len() - 1];
        let from = last.map_or(heading, |way| way.y.atan2(way.x));
        !outline.touches_turning(map.grid, goal, [from, heading])
    });
    Route { goal_heading, ..route }
}
