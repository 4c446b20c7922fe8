//! Times and intervals as clients write them (OGC API Features part 1, 7.15.4).

use jiff::civil::Date;
use jiff::{Timestamp, tz::TimeZone};
use serde::Deserialize;

/// A time or an interval as a parameter. No feature has a time, so every feature is selected by any.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(try_from = "String")]
pub struct Datetime;

impl TryFrom<String> for Datetime {
    type Error = &'static str;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        const FORMS: &str =
            "must be a time like 2026-01-31T12:00:00Z, a day, or an interval of two, either of which may be ..";
        let end = |text: &str| match text {
            "" | ".." => Some(None),
            time => instant(time).map(Some),
        };
        match text.split_once('/') {
            None => instant(&text).map(|_| Self).ok_or(FORMS),
            Some((start, stop)) => match (end(start), end(stop)) {
                (Some(Some(start)), Some(Some(stop))) if start > stop => Err("is inverted: it ends before it begins"),
                (Some(_), Some(_)) => Ok(Self),
                _ => Err(FORMS),
            },
        }
    }
}

/// A time with its offset (RFC 3339), or the beginning of a day.
fn instant(text: &str) -> Option<Timestamp> {
    let day = || text.parse::<Date>().ok()?.to_zoned(TimeZone::UTC).ok().map(|day| day.timestamp());
    if text.len() == "2026-01-31".len() { day() } else { text.parse().ok() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_and_intervals_are_read() {
        let read = |text: &str| Datetime::try_from(text.to_owned()).is_ok();
        for right in ["2026-01-31", "2026-01-31T12:00:00Z", "2026-01-31T12:00:00.5+01:00", "../..", "2026-01-31/.."] {
            assert!(read(right), "{right}");
        }
        for right in ["../2026-01-31T00:00:00Z", "2026-01-30T23:00:00Z/2026-01-31", "/2026-01-31", "2026-01-31/"] {
            assert!(read(right), "{right}");
        }
        for wrong in
            ["", "..", "today", "2026", "2026-13-01", "2026-01-31T12:00:00", "2026-02-01/2026-01-31", "a/b", "../../.."]
        {
            assert!(!read(wrong), "{wrong}");
        }
    }
}
