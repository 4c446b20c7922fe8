//! What fleet managers ask for: routes.

pub mod route;
