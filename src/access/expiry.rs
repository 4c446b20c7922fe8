//! When a key ends, as people write it.

use std::str::FromStr;

use jiff::civil::Date;
use jiff::tz::TimeZone;
use jiff::{SignedDuration, Timestamp};

/// Hours of a day.
const HOURS_OF_DAY: i64 = 24;

/// When a key ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Expiry {
    /// It does not end by itself.
    Never,
    /// So long after it was made.
    After(SignedDuration),
    /// At this time.
    At(Timestamp),
}

impl Expiry {
    /// The time at which a key ends that is made now; `None` where it does not end, or later than times go.
    #[must_use]
    pub fn of_key_made(self, now: Timestamp) -> Option<Timestamp> {
        match self {
            Self::Never => None,
            Self::After(duration) => now.checked_add(duration).ok(),
            Self::At(time) => Some(time),
        }
    }
}

impl FromStr for Expiry {
    type Err = String;

    /// `90d`, `12h`, `2027-03-31` (the end of that day, UTC), a time of RFC 3339, or `never`.
    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || "write 90d, 12h, a day such as 2027-03-31, or never".to_owned();
        if text == "never" {
            return Ok(Self::Never);
        }
        for (unit, hours) in [('d', HOURS_OF_DAY), ('h', 1)] {
            if let Some(count) = text.strip_suffix(unit) {
                let count = count.parse::<u32>().ok().filter(|count| *count > 0).ok_or_else(wrong)?;
                return Ok(Self::After(SignedDuration::from_hours(i64::from(count) * hours)));
            }
        }
        if let Ok(time) = text.parse::<Timestamp>() {
            return Ok(Self::At(time));
        }
        let next = text.parse::<Date>().and_then(Date::tomorrow);
        let end = next.and_then(|day| day.to_zoned(TimeZone::UTC)).map_err(|_| wrong())?;
        Ok(Self::At(end.timestamp()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_key_ends_after_a_time_on_a_day_or_never() {
        let now: Timestamp = "2026-12-01T08:00:00Z".parse().expect("a time");
        let end = |text: &str| text.parse::<Expiry>().expect(text).of_key_made(now).map(|end| end.to_string());
        assert_eq!(end("90d").as_deref(), Some("2027-03-01T08:00:00Z"));
        assert_eq!(end("12h").as_deref(), Some("2026-12-01T20:00:00Z"));
        assert_eq!(end("2027-03-31").as_deref(), Some("2027-04-01T00:00:00Z"));
        assert_eq!(end("2027-03-31T12:00:00Z").as_deref(), Some("2027-03-31T12:00:00Z"));
        assert_eq!(end("never"), None);
        for text in ["", "d", "0d", "-1d", "90", "1.5h", "31.3.2027"] {
            assert!(text.parse::<Expiry>().is_err(), "{text}");
        }
    }
}
