//! Routes over drivable links, on free cells.
//!
//! Source: A* (Hart, Nilsson and Raphael 1968, doi 10.1109/TSSC.1968.300136) on the cells, then string pulling with
//! an exact line of sight (Amanatides and Woo 1987). What the paper adds is where a path may go at all: over links
//! that are connected, between drivable faces, so never through storage; a storage-access edge ends a route.
//! Method: the ends are looked up (`ends`); the face graph says at once when nothing joins them; cells are searched
//! under the rule of `passage` (`search`), and the path is pulled tight under the same rule (`sight`).
//! Cost: O(faces + edges + cells of the reachable faces). Memory: 5 bytes per cell of their bounding box.
//! Limits: the path is that of a point, it may touch obstacles. It is shortest among paths over the eight neighbours
//! of cells, then straightened; another side of an obstacle may be shorter by up to 8 %.

mod ends;
mod passage;
mod search;
mod sight;
#[cfg(test)]
mod tests;

use crate::analysis::Analysis;
use crate::annotation::CellFaces;
use crate::arrangement::{EdgeId, FaceId};
use crate::geometry::Point;
use crate::grid::{CellBounds, OccupancyGrid};
use crate::layout::Location;
use crate::semantics::SemanticMap;
use ends::End;
use passage::Passage;

/// Where a route begins or ends.
#[derive(Debug, Clone, PartialEq)]
pub enum Waypoint {
    /// A point, grid frame, metres.
    Point(Point),
    /// A drivable face (the point well inside it).
    Face(FaceId),
    /// A storage location: the route ends at its storage-access edge.
    Location(Location),
}

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

/// Which end of a route a problem is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RouteEnd {
    /// `from`.
    Start,
    /// `to`.
    Goal,
}

impl std::fmt::Display for RouteEnd {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(match self {
            Self::Start => "start",
            Self::Goal => "goal",
        })
    }
}

/// Why there is no route.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NoRoute {
    /// The end lies outside the decomposed part of the map.
    #[error("the {0} lies outside the map")]
    Outside(RouteEnd),
    /// The face there is not drivable.
    #[error("the {end} lies in face {face}, which is labelled {label} and not drivable")]
    NotDrivable {
        /// Which end.
        end: RouteEnd,
        /// The face there.
        face: FaceId,
        /// The name of its label.
        label: String,
    },
    /// The cell there is not free, or no cell of the face is.
    #[error("the {0} lies on a cell that is not free")]
    Blocked(RouteEnd),
    /// The location has no storage-access edge.
    #[error("location {code}, the {end}, has no storage-access edge")]
    NoAccess {
        /// Which end.
        end: RouteEnd,
        /// The location's code.
        code: String,
    },
    /// Both ends are fine, but no chain of drivable links joins them.
    #[error("no chain of drivable links joins face {from} and face {to}")]
    Disconnected {
        /// The face of the start.
        from: FaceId,
        /// The face of the goal.
        to: FaceId,
    },
    /// Drivable links join the ends, but obstacles close the way on the cells.
    #[error("drivable links join the ends, but no free path leads through them")]
    Obstructed,
}

/// Everything routing needs of a map.
#[derive(Debug, Clone, Copy)]
pub struct RoutingMap<'a> {
    /// The cells.
    pub grid: &'a OccupancyGrid,
    /// The face of every cell.
    pub cells: &'a CellFaces,
    /// The geometric level.
    pub analysis: &'a Analysis,
    /// The human level.
    pub semantic: &'a SemanticMap,
}

/// Finds the shortest way over drivable links, on free cells.
///
/// The path begins and ends exactly at points that are given, at a point well inside faces, and at the free cell next
/// to the access edge of locations. It has at least two points.
///
/// # Errors
/// [`NoRoute`] says why there is none.
pub fn route(map: RoutingMap<'_>, from: &Waypoint, to: &Waypoint) -> Result<Route, NoRoute> {
    let start = End::find(&map, from, RouteEnd::Start)?;
    let goal = End::find(&map, to, RouteEnd::Goal)?;
    let passage = Passage::new(map);
    let reachable = passage.reachable_faces(start.face);
    if !reachable[goal.face.index()] {
        return Err(NoRoute::Disconnected { from: start.face, to: goal.face });
    }
    let window = window_of(&map, &reachable);
    let cells = search::shortest(&passage, &window, start.cell, goal.cell).ok_or(NoRoute::Obstructed)?;

    let inner = cells.iter().skip(1).take(cells.len().saturating_sub(2));
    let mut points = vec![start.point];
    points.extend(inner.map(|&cell| passage.center(cell)));
    points.push(goal.point);
    let path = sight::pull_tight(&passage, &points);
    let (faces, crossed) = sight::faces_along(&passage, &path);
    let edges = start.access.into_iter().chain(crossed).chain(goal.access).collect();
    Ok(Route { length: sight::length(&path), path, faces, edges })
}

/// The cells that the faces of a set may hold.
fn window_of(map: &RoutingMap<'_>, members: &[bool]) -> CellBounds {
    let subdivision = &map.analysis.subdivision;
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for face in subdivision.faces().filter(|face| members[face.index()]) {
        for half in subdivision.boundary(face) {
            let position = subdivision.position(subdivision.half_edge(half).origin);
            for axis in 0..2 {
                low[axis] = low[axis].min(position[axis]);
                high[axis] = high[axis].max(position[axis]);
            }
        }
    }
    let cells = |axis: usize, count: usize| {
        // Casts of negative and infinite numbers saturate.
        let first = (low[axis] / map.grid.resolution()).floor() as usize;
        let end = (high[axis] / map.grid.resolution()).ceil() as usize;
        first.min(count)..end.min(count)
    };
    CellBounds { columns: cells(0, map.grid.width()), rows: cells(1, map.grid.height()) }
}
