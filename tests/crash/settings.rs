//! What the servers are started with, and how long a test waits.

use std::time::Duration;

/// Long enough for a debug build on a busy machine.
pub const PATIENCE: Duration = Duration::from_mins(2);

/// Leases of shared deployments last two seconds here, and the wait after the first attempt five.
pub const LONGER_THAN_A_LEASE: Duration = Duration::from_secs(8);

/// Kills are no fault of the jobs here, so they may happen to one of them as often as they like.
pub const PATIENT: [&str; 4] = ["--max-attempts", "1000000", "--max-queued-jobs", "1000000"];

/// Deleted maps are not kept.
pub const AT_ONCE: [&str; 2] = ["--keep-deleted-minutes", "0"];

/// A number that the environment may give.
pub fn setting(name: &str, default: u64) -> u64 {
    std::env::var(name).ok().and_then(|value| value.parse().ok()).unwrap_or(default)
}
