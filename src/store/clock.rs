//! The clock of this machine.

use jiff::Timestamp;

/// The time, to the microsecond that databases keep.
#[must_use]
pub fn now() -> Timestamp {
    let now = Timestamp::now();
    Timestamp::from_microsecond(now.as_microsecond()).unwrap_or(now)
}
