//! How long a job waits after a fault of the infrastructure.

use std::time::Duration;

use uuid::Uuid;

/// The wait after the first attempt; it doubles with each further one.
const FIRST: Duration = Duration::from_secs(5);

/// The longest wait, before jitter.
const LONGEST: Duration = Duration::from_mins(10);

/// Largest departure from the plain wait, either way, so that jobs that failed together do not come back together.
const JITTER: f64 = 0.2;

/// The wait after attempt `attempt` (from 1) of a job: `min(5 s * 2^(attempt - 1), 10 min)`, give or take a fifth. The
/// jitter is a hash of job and attempt, so that a test can know it.
#[must_use]
pub fn backoff(job: Uuid, attempt: u32) -> Duration {
    let doublings = attempt.saturating_sub(1).min(30);
    let plain = FIRST.saturating_mul(1 << doublings).min(LONGEST);
    let mut hasher = blake3::Hasher::new();
    hasher.update(job.as_bytes()).update(&attempt.to_le_bytes());
    let share = f64::from(hasher.finalize().as_bytes()[0]) / 255.0;
    plain.mul_f64(1.0 + JITTER * (2.0 * share - 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_wait_doubles_up_to_ten_minutes_give_or_take_a_fifth() {
        for (attempt, plain) in [(1, 5.0), (2, 10.0), (3, 20.0), (8, 600.0), (u32::MAX, 600.0)] {
            for job in 0..100 {
                let wait = backoff(Uuid::from_u128(job), attempt).as_secs_f64();
                assert!((plain * 0.8..=plain * 1.2).contains(&wait), "{wait} s after attempt {attempt}");
            }
        }
        assert_ne!(backoff(Uuid::from_u128(1), 1), backoff(Uuid::from_u128(2), 1));
    }
}
