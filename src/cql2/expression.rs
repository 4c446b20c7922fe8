//! A filter as it was written, whatever the encoding: the text and the JSON of one filter give the same expression.

use geo::Geometry;

use super::instant::{Instant, IntervalEnd};
use super::operator::Operator;

/// An expression. Types are not checked yet: `3 AND 4` is an expression.
#[derive(Debug, Clone, PartialEq)]
pub enum Expression {
    /// True or false.
    Boolean(bool),
    /// A number.
    Number(f64),
    /// A text.
    Text(String),
    /// A day or a moment.
    Instant(Instant),
    /// From one instant to another.
    Interval([IntervalEnd; 2]),
    /// A shape in the coordinates of the filter; heights are left out.
    Geometry(Geometry),
    /// A box in the coordinates of the filter: west, south, east, north. Its west lies east of its east where it crosses
    /// the antimeridian.
    Bbox([f64; 4]),
    /// A property by name.
    Property(String),
    /// Several values.
    Array(Vec<Expression>),
    /// What the standard defines.
    Call {
        /// What is done.
        operator: Operator,
        /// With what.
        arguments: Vec<Expression>,
    },
    /// A function that the standard does not define.
    Function {
        /// Its name.
        name: String,
        /// Its arguments.
        arguments: Vec<Expression>,
    },
}

impl Expression {
    /// An operator with its arguments.
    #[must_use]
    pub const fn call(operator: Operator, arguments: Vec<Self>) -> Self {
        Self::Call { operator, arguments }
    }

    /// The opposite of a condition.
    #[must_use]
    pub fn negated(self) -> Self {
        Self::call(Operator::Not, vec![self])
    }
}
