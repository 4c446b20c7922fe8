//! What operators ask for: health.

pub mod health;
