//! What operators are told in figures, in the text format of Prometheus.
//!
//! `list` names every metric with its unit and meaning; what happens is counted where it happens, on the [`Measures`] of the
//! service. Not a global: several services may live in a process, as they do in tests. `process` reads what the system knows of
//! the whole process.

mod list;
mod process;
mod recorder;

pub use list::*;
pub use process::{cpu_time, peak_rss_mib};
pub use recorder::{Measures, Present};
