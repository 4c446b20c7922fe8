//! How long a connection has been waiting for its client.

use std::sync::LazyLock;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use crate::pace::SLOWEST;

/// The time that the numbers below count from.
static BEGIN: LazyLock<Instant> = LazyLock::new(Instant::now);

/// What is stored while the service works: nobody waits for the client.
const WORKING: u64 = u64::MAX;

/// Since when a connection has been waiting for its client: for the next request, for its body, or until the answer is taken.
/// Bytes that come or go shorten the time as [`SLOWEST`] has it, so that a trickle hardly does.
#[derive(Debug)]
pub(super) struct Waiting(AtomicU64);

impl Waiting {
    /// From now on.
    pub(super) fn new() -> Self {
        Self(AtomicU64::new(now()))
    }

    /// The client has done all that it was waited for; the waiting for the next thing begins.
    pub(super) fn begin(&self) {
        self.0.store(now(), Ordering::Relaxed);
    }

    /// The service works for the client.
    pub(super) fn work(&self) {
        self.0.store(WORKING, Ordering::Relaxed);
    }

    /// Bytes came or went.
    pub(super) fn moved(&self, bytes: usize) {
        let credit = (bytes as f64 * 1e6 / SLOWEST) as u64;
        let since = self.0.load(Ordering::Relaxed);
        if since != WORKING {
            // Another thread changes it only when a request begins or ends, which counts more.
            let later = since.saturating_add(credit).min(now());
            let _ = self.0.compare_exchange(since, later, Ordering::Relaxed, Ordering::Relaxed);
        }
    }

    /// How long; `None` while the service works.
    pub(super) fn time(&self) -> Option<Duration> {
        let since = self.0.load(Ordering::Relaxed);
        (since != WORKING).then(|| Duration::from_micros(now().saturating_sub(since)))
    }
}

/// Microseconds since [`BEGIN`].
fn now() -> u64 {
    u64::try_from(BEGIN.elapsed().as_micros()).unwrap_or(WORKING - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_trickle_is_waited_for_and_a_flow_is_not() {
        let waiting = Waiting::new();
        std::thread::sleep(Duration::from_millis(20));
        waiting.moved(1);
        assert!(waiting.time().is_some_and(|time| time >= Duration::from_millis(19)));
        waiting.moved(1_000_000);
        assert!(waiting.time().is_some_and(|time| time < Duration::from_millis(19)));
        waiting.work();
        waiting.moved(1);
        assert_eq!(waiting.time(), None);
    }
}
