//! The shortest route between two waypoints.

use super::ends::{End, Waypoint};
use super::no_route::{NoRoute, RouteEnd};
use super::step_rule::StepRule;
use super::window::window_of;
use super::{search, sight};
use crate::arrangement::{EdgeId, FaceId};
use crate::geometry::Point;
use crate::site_map::SiteMap;

/// A way through the map.
#[derive(Debug, Clone, PartialEq)]
pub struct Route {
    /// The path, grid frame, metres.
    pub path: Vec<Point>,
    /// Length of the path, metres.
    pub length: f64,
    /// Faces crossed, in order.
    pub faces: Vec<FaceId>,
    /// Edges crossed between them (and the storage-access edge at an end), in order.
    pub edges: Vec<EdgeId>,
}

/// Finds the shortest route over drivable links, on free cells.
///
/// The path begins and ends exactly at points that are given, at a point well inside faces, and at the free cell next
/// to the access edge of locations. It has at least two points.
///
/// # Errors
/// [`NoRoute`] says why there is none.
pub fn route(map: SiteMap<'_>, from: &Waypoint, to: &Waypoint) -> Result<Route, NoRoute> {
    let start = End::find(&map, from, RouteEnd::Start)?;
    let goal = End::find(&map, to, RouteEnd::Goal)?;
    let rule = StepRule::new(map);
    let reachable = rule.reachable_faces(start.face);
    if !reachable[goal.face.index()] {
        return Err(NoRoute::Disconnected { from: start.face, to: goal.face });
    }
    let window = window_of(&map, &reachable);
    let cells = search::shortest(&rule, &window, start.cell, goal.cell).ok_or(NoRoute::Obstructed)?;

    let inner = cells.iter().skip(1).take(cells.len().saturating_sub(2));
    let mut points = vec![start.point];
    points.extend(inner.map(|&cell| rule.center(cell)));
    points.push(goal.point);
    let path = sight::pull_tight(&rule, &points);
    let (faces, crossed) = sight::faces_along(&rule, &path);
    let edges = start.access.into_iter().chain(crossed).chain(goal.access).collect();
    Ok(Route { length: sight::length(&path), path, faces, edges })
}
