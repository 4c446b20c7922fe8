//! What fleet managers ask for: routes, and the ways between many ends.

pub mod distance_matrix;
mod no_route;
pub mod route;
mod vehicle;
mod waypoint;
