//! Routes over drivable links, clear of obstacles.
//!
//! | module | what comes out |
//! | --- | --- |
//! | [`router`] | routes for vehicles of one radius |
//! | [`outline_route`], [`vehicle_outline`] | routes for vehicles that are longer than wide; the ground that such a one sweeps |
//! | [`alternatives`], [`matrix`] | routes that differ; lengths between many ends |
//! | [`mod@route`], [`no_route`] | a route, and what it should be like; why there is none |
//! | [`ends`], [`ways_out`] | where it begins and ends; how a vehicle gets there from beside drivable ground |
//! | [`face_steps`] | whether a path may lead from face to face |
//! | [`drive_grid`] | the cells that the vehicle may be on, and the steps between them |
//! | [`tiles`], [`tile_search`], [`tile_ways`], [`road_map`] | the portals between square tiles; ways within a tile; the ways between all portals |
//! | [`search`] | the cheapest way over portals |
//! | [`ground_cost`] | what a metre costs |
//! | [`sight`] | the path pulled tight, and the faces and edges that it crosses |
//! | [`guidance`] | instructions along a route, and its time |
//! | [`bottleneck`] | the narrowest point of the widest way |
//! | [`widest_ways`] | how wide a vehicle may be to get somewhere, and where it gets stuck |
//!
//! Source: hierarchical path finding (Botea, Müller and Schaeffer 2004) with landmarks (Goldberg and Harrelson 2005), then
//! string pulling with an exact line of sight (Amanatides and Woo 1987). The paper adds where a path may go at all: over
//! links that are connected, between drivable faces, so never through storage.
//!
//! Cost: O(cells) for each radius, then milliseconds for a route. Memory: some 4 bytes per cell for each radius. Limits: a
//! vehicle is a disc, or what [`OutlineRouters`] can do; paths are locally the shortest, the way around another side of an obstacle may be shorter by some
//! percent.

mod alternatives;
mod bottleneck;
mod drive_grid;
mod ends;
mod face_steps;
mod ground_cost;
mod guidance;
mod matrix;
mod no_route;
mod outline_route;
mod road_map;
mod route;
mod router;
mod search;
mod sight;
mod tile_search;
mod tile_ways;
mod tiles;
mod vehicle_outline;
mod ways_out;
mod widest_ways;

#[cfg(test)]
mod tests;

pub use ends::Waypoint;
pub use face_steps::Blocked;
pub use guidance::{Action, Instruction, SpeedProfile, instructions};
pub use no_route::{EndGround, NoRoute, RouteEnd};
pub use outline_route::OutlineRouters;
pub use route::{Preferences, Route, RouteProfile};
pub use router::Router;
pub use vehicle_outline::VehicleOutline;
pub use widest_ways::{NarrowestPlace, WidestWays};
