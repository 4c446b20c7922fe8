//! The value of a property of a feature.

use std::cmp::Ordering;

use serde::{Serialize, Serializer};

/// A value, borrowed from its row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Value<'a> {
    /// There is none.
    Null,
    /// True or false.
    Boolean(bool),
    /// A whole number from 0.
    Integer(u64),
    /// A number.
    Number(f64),
    /// Text.
    Text(&'a str),
    /// Whole numbers.
    Integers(&'a [u32]),
    /// Numbers.
    Numbers(&'a [f64]),
    /// Texts.
    Texts(&'a [String]),
    /// Words.
    Words(&'a [&'static str]),
    /// x and y, map frame, metres.
    Position([f64; 2]),
    /// A position and a heading.
    Pose(Pose),
    /// A box of any direction.
    Box(BoxValue),
}

/// Where a robot stands and looks, map frame.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Pose {
    /// x, metres.
    pub x: f64,
    /// y, metres.
    pub y: f64,
    /// Degrees counter-clockwise from the x axis, `[-180, 180)`.
    pub heading_deg: f64,
}

/// A box of any direction, map frame.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct BoxValue {
    /// x and y of its centre, metres.
    pub center: [f64; 2],
    /// Extent along its direction, metres.
    pub length_m: f64,
    /// Extent across it, metres.
    pub width_m: f64,
    /// Degrees counter-clockwise from the x axis, `[-90, 90)`.
    pub orientation: f64,
}

impl Value<'_> {
    /// Whether there is no value.
    #[must_use]
    pub const fn is_null(&self) -> bool {
        matches!(self, Self::Null)
    }

    /// The order of two values of one scalar property: no value comes last, false before true, text by its bytes.
    /// Values without an order are equal.
    #[must_use]
    pub fn compare(&self, other: &Self) -> Ordering {
        match (self, other) {
            (Self::Boolean(first), Self::Boolean(second)) => first.cmp(second),
            (Self::Integer(first), Self::Integer(second)) => first.cmp(second),
            (Self::Number(first), Self::Number(second)) => first.total_cmp(second),
            (Self::Text(first), Self::Text(second)) => first.cmp(second),
            _ => self.is_null().cmp(&other.is_null()),
        }
    }
}

impl Serialize for Value<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Null => serializer.serialize_unit(),
            Self::Boolean(value) => value.serialize(serializer),
            Self::Integer(value) => value.serialize(serializer),
            Self::Number(value) => value.serialize(serializer),
            Self::Text(value) => value.serialize(serializer),
            Self::Integers(value) => value.serialize(serializer),
            Self::Numbers(value) => value.serialize(serializer),
            Self::Texts(value) => value.serialize(serializer),
            Self::Words(value) => value.serialize(serializer),
            Self::Position(value) => value.serialize(serializer),
            Self::Pose(value) => value.serialize(serializer),
            Self::Box(value) => value.serialize(serializer),
        }
    }
}

impl From<bool> for Value<'_> {
    fn from(value: bool) -> Self {
        Self::Boolean(value)
    }
}

impl From<u8> for Value<'_> {
    fn from(value: u8) -> Self {
        Self::Integer(value.into())
    }
}

impl From<u32> for Value<'_> {
    fn from(value: u32) -> Self {
        Self::Integer(value.into())
    }
}

impl From<f64> for Value<'_> {
    fn from(value: f64) -> Self {
        Self::Number(value)
    }
}

impl From<[f64; 2]> for Value<'_> {
    fn from(value: [f64; 2]) -> Self {
        Self::Position(value)
    }
}

impl From<Pose> for Value<'_> {
    fn from(value: Pose) -> Self {
        Self::Pose(value)
    }
}

impl From<BoxValue> for Value<'_> {
    fn from(value: BoxValue) -> Self {
        Self::Box(value)
    }
}

impl<'a> From<&'a str> for Value<'a> {
    fn from(value: &'a str) -> Self {
        Self::Text(value)
    }
}

impl<'a> From<&'a [u32]> for Value<'a> {
    fn from(value: &'a [u32]) -> Self {
        Self::Integers(value)
    }
}

impl<'a> From<&'a [f64]> for Value<'a> {
    fn from(value: &'a [f64]) -> Self {
        Self::Numbers(value)
    }
}

impl<'a> From<&'a [String]> for Value<'a> {
    fn from(value: &'a [String]) -> Self {
        Self::Texts(value)
    }
}

impl<'a> From<&'a [&'static str]> for Value<'a> {
    fn from(value: &'a [&'static str]) -> Self {
        Self::Words(value)
    }
}

impl<'a, T: Into<Value<'a>>> From<Option<T>> for Value<'a> {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::Null, Into::into)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_missing_comes_last() {
        let mut values = [Value::Null, 2.5.into(), (-1.0).into()];
        values.sort_by(Value::compare);
        assert_eq!(values, [(-1.0).into(), 2.5.into(), Value::Null]);
    }
}
