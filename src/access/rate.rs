//! How fast somebody may ask: a bucket of tokens for each, which fills evenly.

use std::collections::HashMap;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// The time that a limit is told for.
pub const WINDOW: Duration = Duration::from_mins(1);

/// Buckets that are kept. Those that are full again say nothing, and go first; then the one that is next to full.
const MOST_BUCKETS: usize = 10_000;

/// Limits requests of many by the same rule.
#[derive(Debug)]
pub struct RateLimiter {
    per_window: u32,
    buckets: Mutex<HashMap<String, Bucket>>,
}

/// The tokens that somebody had at a time.
#[derive(Debug, Clone, Copy)]
struct Bucket {
    tokens: f64,
    at: Instant,
}

/// What a request may do, and what is left after it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Allowance {
    /// Whether it may be answered.
    pub is_allowed: bool,
    /// Requests that may follow at once.
    pub remaining: u32,
    /// Seconds until as many may follow as ever, or where none may, until one may.
    pub reset_s: u32,
}

impl RateLimiter {
    /// So many requests in a [`WINDOW`], all at once or evenly.
    #[must_use]
    pub fn new(per_window: u32) -> Self {
        Self { per_window: per_window.max(1), buckets: Mutex::default() }
    }

    /// Requests in a [`WINDOW`].
    #[must_use]
    pub const fn per_window(&self) -> u32 {
        self.per_window
    }

    /// Takes a token for a request that somebody sends now.
    #[must_use]
    pub fn take(&self, who: &str, now: Instant) -> Allowance {
        let most = f64::from(self.per_window);
        let per_second = most / WINDOW.as_secs_f64();
        let mut buckets = self.buckets();
        let tokens = |bucket: &Bucket| {
            (bucket.tokens + now.saturating_duration_since(bucket.at).as_secs_f64() * per_second).min(most)
        };
        if buckets.len() >= MOST_BUCKETS && !buckets.contains_key(who) {
            buckets.retain(|_, bucket| tokens(bucket) < most);
            let fullest = buckets.iter().max_by(|one, other| tokens(one.1).total_cmp(&tokens(other.1)));
            if buckets.len() >= MOST_BUCKETS
                && let Some(fullest) = fullest.map(|(who, _)| who.clone())
            {
                buckets.remove(&fullest);
            }
        }
        let before = buckets.get(who).map_or(most, tokens);
        let is_allowed = before >= 1.0;
        let after = if is_allowed { before - 1.0 } else { before };
        buckets.insert(who.to_owned(), Bucket { tokens: after, at: now });
        let missing = if is_allowed { most - after } else { 1.0 - after };
        Allowance { is_allowed, remaining: after as u32, reset_s: (missing / per_second).ceil() as u32 }
    }

    fn buckets(&self) -> MutexGuard<'_, HashMap<String, Bucket>> {
        // Every statement above leaves it whole.
        self.buckets.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_burst_is_answered_then_as_many_as_fill_up_and_others_do_not_notice() {
        let (limiter, begin) = (RateLimiter::new(60), Instant::now());
        let take = |who: &str, second: u64| limiter.take(who, begin + Duration::from_secs(second));
        for sent in 1..=60 {
            assert_eq!(take("one", 0), Allowance { is_allowed: true, remaining: 60 - sent, reset_s: sent });
        }
        assert_eq!(take("one", 0), Allowance { is_allowed: false, remaining: 0, reset_s: 1 });
        assert!(take("other", 0).is_allowed);
        assert!(take("one", 1).is_allowed && !take("one", 1).is_allowed);
        assert_eq!(take("one", 120).remaining, 59);
    }

    #[test]
    fn however_many_ask_the_memory_is_bounded() {
        let (limiter, begin) = (RateLimiter::new(60), Instant::now());
        for who in 0..=MOST_BUCKETS {
            assert!(limiter.take(&who.to_string(), begin).is_allowed);
        }
        assert_eq!(limiter.buckets().len(), MOST_BUCKETS);
        assert!(limiter.take("late", begin + WINDOW).is_allowed);
        assert_eq!(limiter.buckets().len(), 1, "the others are full again");
    }
}
