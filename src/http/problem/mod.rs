//! Every refusal of the service is a problem detail (RFC 9457).
//!
//! A [`Problem`] travels in the extensions of its response; [`render()`] writes the body once, at the outside, where the
//! path of the request is known. It also gives a body to the bare refusals of the framework (405, 413 ...), so that
//! every error has the same shape.

mod access;
mod detail;
mod render;
mod types;

pub use detail::{Problem, ProblemDocument};
pub use render::{PROBLEM_JSON, of_panic, render};
pub use types::ProblemType;
