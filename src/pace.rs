//! How slow a client may be that sends or takes bytes.

use std::time::Duration;

use tokio::time::Instant;

/// How long a client may stand still.
pub const STANDSTILL: Duration = Duration::from_secs(15);

/// The slowest pace, bytes per second: a mobile link of the slow kind.
pub const SLOWEST: f64 = 16_384.0;

/// How slow a client may be.
#[derive(Debug, Clone, Copy)]
pub struct PaceLimits {
    /// How long it may stand still.
    pub standstill: Duration,
    /// How many bytes it has to send or take in a second, while it is waited for.
    pub bytes_per_second: f64,
}

impl Default for PaceLimits {
    fn default() -> Self {
        Self { standstill: STANDSTILL, bytes_per_second: SLOWEST }
    }
}

/// The time by which a client must have sent or taken more.
///
/// Each byte moves it, and never farther than the standstill from now: who was fast before may not stand still longer.
#[derive(Debug, Clone, Copy)]
pub struct Pace {
    limits: PaceLimits,
    deadline: Instant,
}

impl Pace {
    /// The pace of a client that begins now.
    #[must_use]
    pub fn new(limits: PaceLimits, now: Instant) -> Self {
        Self { limits, deadline: now + limits.standstill }
    }

    /// Bytes came or went.
    pub fn moved(&mut self, bytes: usize, now: Instant) {
        let credit = Duration::from_secs_f64(bytes as f64 / self.limits.bytes_per_second);
        self.deadline = (self.deadline + credit).min(now + self.limits.standstill);
    }

    /// When it is too slow.
    #[must_use]
    pub const fn deadline(&self) -> Instant {
        self.deadline
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fast_client_may_stand_still_no_longer_than_any_other() {
        let begin = Instant::now();
        let mut pace = Pace::new(PaceLimits::default(), begin);
        let later = begin + Duration::from_secs(5);
        pace.moved(3_000_000, later);
        assert_eq!(pace.deadline(), later + STANDSTILL);
    }

    #[test]
    fn a_trickle_comes_to_its_end() {
        let begin = Instant::now();
        let mut pace = Pace::new(PaceLimits::default(), begin);
        for second in 1..=15 {
            pace.moved(1, begin + Duration::from_secs(second));
        }
        assert!(pace.deadline() < begin + STANDSTILL + Duration::from_millis(10));
    }
}
