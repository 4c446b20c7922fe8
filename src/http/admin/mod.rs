//! What is about the service itself: health, who changed what, and the sessions of browsers.

pub mod audit;
pub mod health;
pub mod session;
