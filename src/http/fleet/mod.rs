//! What fleet managers ask for: routes, the ways between many ends, and files for other programs.

pub mod distance_matrix;
pub mod exports;
mod no_route;
pub mod route;
mod vehicle;
mod waypoint;
