//! Places at which a debug build can be made to die as if the power had been cut.
//!
//! `STILLAGE_FAIL_POINT=after-claim stillage serve` kills its own process with SIGKILL when it passes the point of that
//! name: no destructor, no rollback, no goodbye. `tests/crash` then asks whether the next process finds everything in
//! order. A release build has no fail points.

/// Dies here when this point is named by the environment.
#[cfg(debug_assertions)]
pub fn pass(name: &str) {
    use rustix::process::{Signal, getpid, kill_process};
    use std::sync::OnceLock;

    static ARMED: OnceLock<Option<String>> = OnceLock::new();
    let armed = ARMED.get_or_init(|| std::env::var("STILLAGE_FAIL_POINT").ok());
    if armed.as_deref() == Some(name) {
        // A process may always signal itself; were it refused, living on is all that is left to do.
        let _ = kill_process(getpid(), Signal::KILL);
    }
}

/// Nothing in a release build.
#[cfg(not(debug_assertions))]
pub const fn pass(_name: &str) {}
