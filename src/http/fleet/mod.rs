//! What fleet managers ask for: where a pose is and what is near, routes, the ways between many ends, a report on the navigation graph, and files for other
//! programs.

pub mod at;
pub mod distance_matrix;
pub mod exports;
pub mod graph_report;
pub mod nearest;
mod no_route;
mod outside;
pub mod route;
mod vehicle;
mod waypoint;
