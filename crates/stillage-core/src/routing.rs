//! Routes over drivable links, on free cells. (to be written)
use crate::analysis::Analysis;
use crate::annotation::CellFaces;
use crate::arrangement::{EdgeId, FaceId};
use crate::geometry::Point;
use crate::grid::OccupancyGrid;
use crate::layout::Location;
use crate::semantics::SemanticMap;

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

/// Why there is no route.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NoRoute {
    /// The end lies outside the decomposed part of the map.
    #[error("the {0:?} lies outside the map")]
    Outside(RouteEnd),
    /// The face there is not drivable.
    #[error("the {end:?} lies in face {face}, which is labelled {label} and not drivable")]
    NotDrivable { end: RouteEnd, face: FaceId, label: String },
    /// The cell there is not free.
    #[error("the {0:?} lies on a cell that is not free")]
    Blocked(RouteEnd),
    /// The location has no storage-access edge.
    #[error("location {code} has no storage-access edge")]
    NoAccess { end: RouteEnd, code: String },
    /// Both ends are fine, but no chain of drivable links joins them.
    #[error("no chain of drivable links joins face {from} and face {to}")]
    Disconnected { from: FaceId, to: FaceId },
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
/// # Errors
/// [`NoRoute`] says why there is none.
pub fn route(map: RoutingMap<'_>, from: &Waypoint, to: &Waypoint) -> Result<Route, NoRoute> {
    let _ = (map, from, to);
    todo!()
}
