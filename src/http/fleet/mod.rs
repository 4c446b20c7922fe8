//! What fleet managers ask for: routes, the ways between many ends, a report on the navigation graph, and files for other
//! programs.

pub mod at;
pub mod distance_matrix;
pub mod exports;
pub mod graph_report;
mod no_route;
mod other_crs;
pub mod route;
mod vehicle;
mod waypoint;
