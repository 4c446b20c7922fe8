//! Days, moments and the time between them.

use jiff::civil::Date;
use jiff::tz::TimeZone;
use jiff::{Timestamp, ToSpan as _};

use super::operator::TemporalRelation;

/// A point in time of one of two precisions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Instant {
    /// A day.
    Date(Date),
    /// A moment.
    Timestamp(Timestamp),
}

/// Where an interval begins or ends.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum IntervalEnd {
    /// Never: `'..'`.
    Open,
    /// At an instant.
    Instant(Instant),
    /// At the value of a property.
    Property(String),
}

impl Instant {
    /// Reads `2026-01-31`.
    ///
    /// # Errors
    /// What it must look like.
    pub fn date(text: &str) -> Result<Self, &'static str> {
        let is_plain = text.len() == "2026-01-31".len();
        let date = text.parse().ok().filter(|_| is_plain);
        date.map(Self::Date).ok_or("is not a day such as 2026-01-31")
    }

    /// Reads `2026-01-31T12:30:00Z` (RFC 3339).
    ///
    /// # Errors
    /// What it must look like.
    pub fn timestamp(text: &str) -> Result<Self, &'static str> {
        text.parse().map(Self::Timestamp).map_err(|_| "is not a time such as 2026-01-31T12:30:00Z")
    }
}

impl IntervalEnd {
    /// Reads a day, a time or `..`.
    ///
    /// # Errors
    /// What it must look like.
    pub fn read(text: &str) -> Result<Self, &'static str> {
        if text == ".." {
            return Ok(Self::Open);
        }
        let instant = Instant::date(text).or_else(|_| Instant::timestamp(text));
        instant
            .map(Self::Instant)
            .map_err(|_| "is not a day such as 2026-01-31, a time such as 2026-01-31T12:30:00Z or ..")
    }
}

/// A stretch of time. Without a start or an end it is open there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Period {
    /// When it begins.
    pub start: Option<Instant>,
    /// When it ends.
    pub end: Option<Instant>,
}

impl From<Instant> for Period {
    fn from(instant: Instant) -> Self {
        Self { start: Some(instant), end: Some(instant) }
    }
}

impl Period {
    /// Whether two periods lie as the relation says. A day is its whole 24 hours (UTC), and one instant where it is
    /// compared with days only, so that a period meets another that begins on its last day.
    #[must_use]
    pub fn relates(&self, relation: TemporalRelation, other: &Self) -> bool {
        let is_day = |end: &Option<Instant>| matches!(end, None | Some(Instant::Date(_)));
        let only_days = [self, other].iter().all(|period| is_day(&period.start) && is_day(&period.end));
        let [(start, end), (other_start, other_end)] = [self, other].map(|period| period.moments(only_days));
        match relation {
            TemporalRelation::After => start > other_end,
            TemporalRelation::Before => end < other_start,
            TemporalRelation::Disjoint => start > other_end || end < other_start,
            TemporalRelation::Intersects => start <= other_end && end >= other_start,
            TemporalRelation::Equals => start == other_start && end == other_end,
            TemporalRelation::Contains => start < other_start && end > other_end,
            TemporalRelation::During => start > other_start && end < other_end,
            TemporalRelation::Finishes => start > other_start && end == other_end,
            TemporalRelation::FinishedBy => start < other_start && end == other_end,
            TemporalRelation::Meets => end == other_start,
            TemporalRelation::MetBy => start == other_end,
            TemporalRelation::Overlaps => start < other_start && end > other_start && end < other_end,
            TemporalRelation::OverlappedBy => start > other_start && start < other_end && end > other_end,
            TemporalRelation::Starts => start == other_start && end < other_end,
            TemporalRelation::StartedBy => start == other_start && end > other_end,
        }
    }

    /// Its first and last moment.
    fn moments(&self, only_days: bool) -> (Timestamp, Timestamp) {
        let midnight = |date: Date| date.to_zoned(TimeZone::UTC).map(|zoned| zoned.timestamp());
        let start = match self.start {
            None => Timestamp::MIN,
            Some(Instant::Timestamp(timestamp)) => timestamp,
            Some(Instant::Date(date)) => midnight(date).unwrap_or(Timestamp::MIN),
        };
        let end = match self.end {
            None => Timestamp::MAX,
            Some(Instant::Timestamp(timestamp)) => timestamp,
            Some(Instant::Date(date)) if only_days => midnight(date).unwrap_or(Timestamp::MAX),
            Some(Instant::Date(date)) => {
                let next = date.checked_add(1.day()).and_then(midnight);
                next.and_then(|next| next.checked_sub(1.nanosecond())).unwrap_or(Timestamp::MAX)
            }
        };
        (start, end)
    }
}
