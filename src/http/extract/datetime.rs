//! Times and intervals as clients write them (OGC API Features part 1, 7.15.4).

use jiff::civil::Date;
use jiff::{SignedDuration, Timestamp, tz::TimeZone};
use serde::Deserialize;

/// A time or an interval as a parameter, both ends within it. A day lasts 24 hours.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(try_from = "String")]
pub struct Datetime {
    /// Where it begins; none where it is open.
    pub start: Option<Timestamp>,
    /// Where it ends; none where it is open.
    pub end: Option<Timestamp>,
}

impl TryFrom<String> for Datetime {
    type Error = &'static str;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        const FORMS: &str =
            "must be a time like 2026-01-31T12:00:00Z, a day, or an interval of two, either of which may be ..";
        let Some((start, end)) = text.split_once('/') else {
            let (start, end) = instant(&text).ok_or(FORMS)?;
            return Ok(Self { start: Some(start), end: Some(end) });
        };
        let side = |text: &str| match text {
            "" | ".." => Ok(None),
            time => instant(time).map(Some).ok_or(FORMS),
        };
        let (start, end) = (side(start)?.map(|(first, _)| first), side(end)?.map(|(_, last)| last));
        match (start, end) {
            (Some(start), Some(end)) if start > end => Err("is inverted: it ends before it begins"),
            _ => Ok(Self { start, end }),
        }
    }
}

/// First and last moment of a time with its offset (RFC 3339), or of a day in UTC.
fn instant(text: &str) -> Option<(Timestamp, Timestamp)> {
    if text.len() != "2026-01-31".len() {
        let time = text.parse().ok()?;
        return Some((time, time));
    }
    let day: Date = text.parse().ok()?;
    let begins = |day: Date| Some(day.to_zoned(TimeZone::UTC).ok()?.timestamp());
    let (first, next) = (begins(day)?, begins(day.tomorrow().ok()?)?);
    Some((first, next.checked_sub(SignedDuration::from_nanos(1)).ok()?))
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

    #[test]
    fn a_day_is_an_interval() {
        let day = Datetime::try_from("2026-01-31".to_owned()).expect("is a day");
        let bounds = [day.start, day.end].map(|end| end.map(|end| end.to_string()));
        assert_eq!(bounds, [Some("2026-01-31T00:00:00Z".into()), Some("2026-01-31T23:59:59.999999999Z".into())]);
    }
}
