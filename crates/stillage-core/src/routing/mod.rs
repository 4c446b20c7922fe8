//! Routes over drivable links, on free cells.
//!
//! | module | what comes out |
//! | --- | --- |
//! | [`mod@route`] | the route between two waypoints |
//! | [`ends`] | the free cells at which it begins and ends |
//! | [`step_rule`] | whether a path may lead from one cell to the next; which faces are reachable at all |
//! | [`search`] | the shortest path over the eight neighbours of cells |
//! | [`sight`] | the path pulled tight, and the faces and edges that it crosses |
//! | [`no_route`] | why there is none |
//! | [`window`] | the cells around some faces |
//!
//! Source: A* (Hart, Nilsson and Raphael 1968, doi 10.1109/TSSC.1968.300136) on the cells, then string pulling with an
//! exact line of sight (Amanatides and Woo 1987). The paper adds where a path may go at all: over links that are
//! connected, between drivable faces, so never through storage; a storage-access edge ends a route.
//!
//! Cost: O(faces + edges + cells of the reachable faces). Memory: 5 bytes per cell of their bounding box. Limits: the
//! path is that of a point, it may touch obstacles. It is the shortest over the eight neighbours of cells, then
//! straightened; the way around another side of an obstacle may be shorter by up to 8 %.

mod ends;
mod no_route;
mod route;
mod search;
mod sight;
mod step_rule;
mod window;

#[cfg(test)]
mod tests;

pub use ends::Waypoint;
pub use no_route::{NoRoute, RouteEnd};
pub use route::{Route, route};
