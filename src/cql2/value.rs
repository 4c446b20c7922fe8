//! What a filter reads of the things it selects.

use std::borrow::Cow;
use std::fmt::Debug;

use geo::{Geometry, Rect};

use super::instant::{Instant, Period};

/// Something that a filter may select.
pub trait Filterable {
    /// The value of a queryable, by its place in the list that the filter was bound to.
    fn value(&self, queryable: usize) -> FilterValue<'_>;
}

/// A shape. What costs time is asked for only when the box around it is not enough.
pub trait Located: Debug {
    /// The box around it.
    fn bounds(&self) -> Rect;

    /// The shape itself.
    fn shape(&self) -> Cow<'_, Geometry>;
}

/// A property that filters may use.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Queryable<'a> {
    /// Its name.
    pub name: &'a str,
    /// What its values are.
    pub value_type: ValueType,
}

/// What a value is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs, reason = "each is a value of its name")]
pub enum ValueType {
    Boolean,
    Number,
    Text,
    Instant,
    Interval,
    Geometry,
    Array,
    /// Of parts with names: nothing but `IS NULL` can be asked of it.
    Object,
}

impl ValueType {
    /// Its name in a sentence.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Boolean => "true or false",
            Self::Number => "a number",
            Self::Text => "a text",
            Self::Instant => "a date or time",
            Self::Interval => "an interval",
            Self::Geometry => "a geometry",
            Self::Array => "an array",
            Self::Object => "an object",
        }
    }
}

/// A value.
#[derive(Debug, Clone)]
pub enum FilterValue<'a> {
    /// There is none: what is compared with it is neither true nor false.
    Null,
    /// True or false.
    Boolean(bool),
    /// A number.
    Number(f64),
    /// A text.
    Text(Cow<'a, str>),
    /// A day or a moment.
    Instant(Instant),
    /// From one instant to another.
    Interval(Period),
    /// A shape.
    Geometry(&'a dyn Located),
    /// Several values.
    Array(Vec<FilterValue<'a>>),
    /// Something that filters cannot look into.
    Object,
}

impl FilterValue<'_> {
    /// Whether two values of one type are the same; `None` where one of them is missing or they cannot be compared.
    #[must_use]
    pub fn equals(&self, other: &Self) -> Option<bool> {
        match (self, other) {
            (Self::Array(values), Self::Array(others)) => Some(same_sets(values, others)),
            _ => self.compare(other).map(std::cmp::Ordering::is_eq),
        }
    }

    /// The order of two scalars of one type: numbers by size, false before true, texts by their code points, and a day
    /// is equal to every moment of it. `None` where one of them is missing or they have no order.
    #[must_use]
    pub fn compare(&self, other: &Self) -> Option<std::cmp::Ordering> {
        use super::operator::TemporalRelation::{After, Before};
        match (self, other) {
            (Self::Boolean(one), Self::Boolean(other)) => Some(one.cmp(other)),
            (Self::Number(one), Self::Number(other)) => one.partial_cmp(other),
            (Self::Text(one), Self::Text(other)) => Some(one.cmp(other)),
            (Self::Instant(one), Self::Instant(other)) => {
                let (one, other) = (Period::from(*one), Period::from(*other));
                let is_before = one.relates(Before, &other);
                Some(one.relates(After, &other).cmp(&is_before))
            }
            _ => None,
        }
    }
}

/// Whether each value of one array is in the other one.
fn same_sets(values: &[FilterValue<'_>], others: &[FilterValue<'_>]) -> bool {
    is_subset(values, others) && is_subset(others, values)
}

/// Whether each value of an array is among others.
pub(super) fn is_subset(values: &[FilterValue<'_>], others: &[FilterValue<'_>]) -> bool {
    values.iter().all(|value| is_among(value, others))
}

/// Whether a value is among others.
pub(super) fn is_among(value: &FilterValue<'_>, others: &[FilterValue<'_>]) -> bool {
    others.iter().any(|other| value.equals(other) == Some(true))
}
