//! How many files and connections the process may have open.

use rustix::process::{Resource, Rlimit, getrlimit, setrlimit};

/// Files that are open beside the connections: the database, blobs, uploads, threads of the runtime.
const OTHERS: u64 = 256;

/// Raises the soft limit of the process to what connections and files need, as far as the hard limit lets it. A login shell has
/// 1,024 by default, and where they have run out nobody is served any more. Answers the connections that there can be.
#[must_use]
pub fn make_room(connections: usize) -> usize {
    let needed = connections as u64 + OTHERS;
    let Rlimit { current, maximum } = getrlimit(Resource::Nofile);
    if current.is_none_or(|current| current >= needed) {
        return connections;
    }
    let raised = maximum.map_or(needed, |maximum| needed.min(maximum));
    let limit = Rlimit { current: Some(raised), maximum };
    let allowed = if setrlimit(Resource::Nofile, limit).is_ok() { raised } else { current.unwrap_or(raised) };
    let possible = usize::try_from(allowed.saturating_sub(OTHERS)).unwrap_or(usize::MAX).clamp(1, connections);
    if possible < connections {
        tracing::warn!(possible, "the limit of open files (ulimit -n) allows fewer connections than --max-connections");
    }
    possible
}
