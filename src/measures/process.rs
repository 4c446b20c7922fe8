//! What the system knows of this process. Where it does not tell (`/proc` does on Linux), there is no figure.

use std::fs;
use std::time::Duration;

use rustix::time::{ClockId, clock_gettime};

/// CPU time of the process so far, all threads.
#[must_use]
pub fn cpu_time() -> Duration {
    Duration::try_from(clock_gettime(ClockId::ProcessCPUTime)).unwrap_or_default()
}

/// Most memory the process ever held, MiB.
#[must_use]
pub fn peak_rss_mib() -> Option<f64> {
    Some(kibibytes("VmHWM:")? / 1024.0)
}

/// Memory that the process holds, bytes.
pub(super) fn resident_bytes() -> Option<f64> {
    Some(kibibytes("VmRSS:")? * 1024.0)
}

/// Files and connections that are open.
pub(super) fn open_files() -> Option<usize> {
    // The look itself has one open.
    Some(fs::read_dir("/proc/self/fd").ok()?.count().saturating_sub(1))
}

fn kibibytes(field: &str) -> Option<f64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix(field))?;
    line.trim().strip_suffix("kB")?.trim().parse().ok()
}
