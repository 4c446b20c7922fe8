//! The worker behind the durable queue of [`crate::store::queue`].
//!
//! Each slot takes one job at a time: claim, read the upload, let the process of the job compute on a rayon pool of its
//! own, store the result. While it computes, a heartbeat renews the lease, writes how far it is, and reads whether the
//! job is to be cancelled.
//!
//! - Nothing computes on the threads of the async runtime or on rayon's global pool.
//! - A panic in a job is that job's failure. So is a map that cannot be read. Neither is tried again: the same code on
//!   the same bytes does the same.
//! - A fault of the infrastructure (disk, database) is tried again after a wait, a few times.
//! - A request to stop lets running jobs go on for the grace period, then puts them back without counting the attempt.

mod compute;
mod contact;
mod housekeeping;
mod job_counts;
pub mod processes;
mod retry;
mod running;
mod shared;
mod signals;
#[cfg(test)]
mod tests;
mod worker;

pub use housekeeping::{delete_hidden, forget_old_entries, kept_since, measure_old_blobs};
pub use retry::backoff;
pub use signals::Signals;
pub use worker::Worker;
