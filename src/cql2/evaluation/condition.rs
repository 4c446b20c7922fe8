//! Conditions whose names are looked up and whose types are right, and their truth for one thing.
//!
//! Truth has three values: `None` is neither true nor false, because a value is missing (SQL's NULL).

use std::borrow::Cow;

use super::folding::Folding;
use super::pattern::LikePattern;
use super::spatial::{LiteralShape, relates};
use crate::cql2::instant::{Instant, Period};
use crate::cql2::operator::{Arithmetic, ArrayRelation, Comparison, SpatialRelation, TemporalRelation};
use crate::cql2::value::{FilterValue, Filterable, is_among, is_subset};

/// A condition.
#[derive(Debug, Clone)]
pub enum Condition {
    /// All hold.
    All(Vec<Condition>),
    /// One holds at least.
    Any(Vec<Condition>),
    /// It does not hold.
    Not(Box<Condition>),
    /// The value is true.
    Is(Operand),
    /// There is no value.
    IsNull(Operand),
    /// Two scalars have this order.
    Compare(Comparison, [Operand; 2]),
    /// A text fits a pattern.
    Like(Operand, LikePattern),
    /// A number is neither below the second nor above the third.
    Between([Operand; 3]),
    /// A scalar is one of these.
    In(Operand, Vec<Operand>),
    /// Two shapes lie so to one another.
    Spatial(SpatialRelation, [Operand; 2]),
    /// Two stretches of time lie so to one another.
    Temporal(TemporalRelation, [Operand; 2]),
    /// Two arrays lie so to one another.
    Arrays(ArrayRelation, [Operand; 2]),
}

/// Something that has a value.
#[derive(Debug, Clone)]
pub enum Operand {
    /// True or false.
    Boolean(bool),
    /// A number.
    Number(f64),
    /// A text.
    Text(String),
    /// A day or a moment.
    Instant(Instant),
    /// A shape.
    Shape(Box<LiteralShape>),
    /// A queryable, by its place in the list.
    Property(usize),
    /// Whether a condition holds.
    Condition(Box<Condition>),
    /// A number from two others.
    Calculated(Arithmetic, Box<[Operand; 2]>),
    /// A text without its case or accents.
    Folded(Folding, Box<Operand>),
    /// A stretch of time; an end that is absent is open.
    Interval(Box<[Option<Operand>; 2]>),
    /// Several values.
    Array(Vec<Operand>),
}

impl Condition {
    /// Whether it holds for a thing; `None` where a value that it needs is missing.
    #[must_use]
    pub fn holds(&self, thing: &dyn Filterable) -> Option<bool> {
        match self {
            Self::All(conditions) => joined(conditions, thing, false),
            Self::Any(conditions) => joined(conditions, thing, true),
            Self::Not(condition) => condition.holds(thing).map(|holds| !holds),
            Self::Is(operand) => match operand.value(thing) {
                FilterValue::Boolean(value) => Some(value),
                _ => None,
            },
            Self::IsNull(operand) => Some(matches!(operand.value(thing), FilterValue::Null)),
            Self::Compare(comparison, [one, other]) => compare(*comparison, &one.value(thing), &other.value(thing)),
            Self::Like(text, pattern) => match text.value(thing) {
                FilterValue::Text(text) => Some(pattern.fits(&text)),
                _ => None,
            },
            Self::Between([value, low, high]) => {
                let [value, low, high] = [value, low, high].map(|operand| operand.value(thing));
                let is_above = compare(Comparison::GreaterOrEqual, &value, &low);
                let is_below = compare(Comparison::LessOrEqual, &value, &high);
                and(is_above, is_below)
            }
            Self::In(value, list) => {
                let value = value.value(thing);
                let equal = |entry: &Operand| value.equals(&entry.value(thing));
                any(list.iter().map(equal))
            }
            Self::Spatial(relation, [one, other]) => match (one.value(thing), other.value(thing)) {
                (FilterValue::Geometry(one), FilterValue::Geometry(other)) => Some(relates(*relation, one, other)),
                _ => None,
            },
            Self::Temporal(relation, [one, other]) => {
                let (one, other) = (one.period(thing)?, other.period(thing)?);
                Some(one.relates(*relation, &other))
            }
            Self::Arrays(relation, [one, other]) => match (one.value(thing), other.value(thing)) {
                (FilterValue::Array(one), FilterValue::Array(other)) => Some(match relation {
                    ArrayRelation::ContainedBy => is_subset(&one, &other),
                    ArrayRelation::Contains => is_subset(&other, &one),
                    ArrayRelation::Equals => is_subset(&one, &other) && is_subset(&other, &one),
                    ArrayRelation::Overlaps => one.iter().any(|value| is_among(value, &other)),
                }),
                _ => None,
            },
        }
    }
}

/// AND (`decisive` false) or OR (`decisive` true): one decisive condition decides, whatever is missing elsewhere.
fn joined(conditions: &[Condition], thing: &dyn Filterable, decisive: bool) -> Option<bool> {
    let mut result = Some(!decisive);
    for condition in conditions {
        match condition.holds(thing) {
            Some(holds) if holds == decisive => return Some(decisive),
            Some(_) => {}
            None => result = None,
        }
    }
    result
}

fn and(one: Option<bool>, other: Option<bool>) -> Option<bool> {
    match (one, other) {
        (Some(false), _) | (_, Some(false)) => Some(false),
        (Some(true), Some(true)) => Some(true),
        _ => None,
    }
}

fn any(mut each: impl Iterator<Item = Option<bool>>) -> Option<bool> {
    let mut result = Some(false);
    // Stops at the first that is true.
    let found = each.any(|equal| {
        if equal.is_none() {
            result = None;
        }
        equal == Some(true)
    });
    if found { Some(true) } else { result }
}

fn compare(comparison: Comparison, one: &FilterValue<'_>, other: &FilterValue<'_>) -> Option<bool> {
    let order = one.compare(other)?;
    Some(match comparison {
        Comparison::Equal => order.is_eq(),
        Comparison::NotEqual => order.is_ne(),
        Comparison::Less => order.is_lt(),
        Comparison::Greater => order.is_gt(),
        Comparison::LessOrEqual => order.is_le(),
        Comparison::GreaterOrEqual => order.is_ge(),
    })
}

impl Operand {
    /// Its value for a thing.
    #[must_use]
    pub fn value<'a>(&'a self, thing: &'a dyn Filterable) -> FilterValue<'a> {
        match self {
            Self::Boolean(value) => FilterValue::Boolean(*value),
            Self::Number(number) => FilterValue::Number(*number),
            Self::Text(text) => FilterValue::Text(Cow::Borrowed(text)),
            Self::Instant(instant) => FilterValue::Instant(*instant),
            Self::Shape(shape) => FilterValue::Geometry(&**shape),
            Self::Property(index) => thing.value(*index),
            Self::Condition(condition) => condition.holds(thing).map_or(FilterValue::Null, FilterValue::Boolean),
            Self::Calculated(arithmetic, operands) => match operands.each_ref().map(|operand| operand.value(thing)) {
                [FilterValue::Number(one), FilterValue::Number(other)] => calculated(*arithmetic, one, other),
                _ => FilterValue::Null,
            },
            Self::Folded(folding, operand) => match operand.value(thing) {
                FilterValue::Text(text) => FilterValue::Text(Cow::Owned(folding.fold(&text))),
                _ => FilterValue::Null,
            },
            Self::Interval(_) => self.period(thing).map_or(FilterValue::Null, FilterValue::Interval),
            Self::Array(values) => FilterValue::Array(values.iter().map(|value| value.value(thing)).collect()),
        }
    }

    /// Its value as a stretch of time.
    fn period(&self, thing: &dyn Filterable) -> Option<Period> {
        let Self::Interval(ends) = self else {
            return match self.value(thing) {
                FilterValue::Instant(instant) => Some(Period::from(instant)),
                FilterValue::Interval(period) => Some(period),
                _ => None,
            };
        };
        let end = |end: &Option<Self>| match end.as_ref().map(|end| end.value(thing)) {
            None => Some(None),
            Some(FilterValue::Instant(instant)) => Some(Some(instant)),
            Some(_) => None,
        };
        Some(Period { start: end(&ends[0])?, end: end(&ends[1])? })
    }
}

/// What two numbers make; nothing where it is no number (a division by zero) or too large for one.
fn calculated(arithmetic: Arithmetic, one: f64, other: f64) -> FilterValue<'static> {
    let result = match arithmetic {
        Arithmetic::Add => one + other,
        Arithmetic::Subtract => one - other,
        Arithmetic::Multiply => one * other,
        Arithmetic::Divide => one / other,
        Arithmetic::Remainder => one % other,
        Arithmetic::WholeDivide => (one / other).trunc(),
        Arithmetic::Power => one.powf(other),
    };
    if result.is_finite() { FilterValue::Number(result) } else { FilterValue::Null }
}
