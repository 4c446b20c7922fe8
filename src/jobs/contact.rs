//! Since when this process has been in touch with the database without a break.

use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use jiff::{SignedDuration, Timestamp};

/// A process that saw the database all the time in which another one did not renew its claim knows that this one alone was gone.
/// One that started meanwhile, slept, or did not see the database either does not know that.
#[derive(Debug)]
pub(super) struct Contact {
    /// A longer time without an answer is a break.
    longest_pause: SignedDuration,
    /// The time of the first answer after the last break, and of the last answer.
    span: Mutex<Option<(Timestamp, Timestamp)>>,
}

impl Contact {
    pub(super) fn new(longest_pause: Duration) -> Self {
        let longest_pause = SignedDuration::try_from(longest_pause).unwrap_or(SignedDuration::MAX);
        Self { longest_pause, span: Mutex::new(None) }
    }

    /// The database answered with this time. Answers since when it has done so without a break.
    pub(super) fn answered(&self, now: Timestamp) -> Timestamp {
        let mut span = self.span.lock().unwrap_or_else(PoisonError::into_inner);
        let (since, last) =
            span.filter(|(_, last)| now.duration_since(*last).abs() <= self.longest_pause).unwrap_or((now, now));
        *span = Some((since, last.max(now)));
        since
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_pause_or_a_clock_that_was_set_breaks_the_contact() {
        let contact = Contact::new(Duration::from_secs(15));
        let at = |second| Timestamp::from_second(second).expect("a time");
        assert_eq!([100, 110, 109, 124].map(|second| contact.answered(at(second))), [at(100); 4]);
        assert_eq!(contact.answered(at(140)), at(140), "16 s without an answer");
        assert_eq!(contact.answered(at(150)), at(140));
        assert_eq!(contact.answered(at(50)), at(50), "the clock was set back");
    }
}
