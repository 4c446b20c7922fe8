//! From an expression to a filter: names are looked up, types checked, shapes put into the coordinates of the data.

use geo::{CoordsIter as _, MapCoords as _};

use stillage_core::excerpt;

use super::error::FilterError;
use super::evaluation::condition::{Condition, Operand};
use super::evaluation::folding::Folding;
use super::evaluation::pattern::LikePattern;
use super::evaluation::spatial::{LiteralShape, box_across_antimeridian, box_shape};
use super::expression::Expression;
use super::instant::{Instant, IntervalEnd};
use super::limits::{MAX_POSITIONS, MAX_SPATIAL};
use super::operator::Operator;
use super::value::{FilterValue, Queryable, ValueType};
use crate::did_you_mean::did_you_mean;

/// The coordinates of the shapes of a filter.
#[derive(Clone, Copy)]
#[allow(missing_debug_implementations, reason = "a function has nothing to show")]
pub struct FilterCoordinates<'a> {
    /// Whether they are degrees, so that a box may cross the antimeridian.
    pub are_degrees: bool,
    /// Leads to the coordinates of the data.
    pub to_data: &'a dyn Fn([f64; 2]) -> [f64; 2],
}

/// Binds an expression to the things it is asked of.
pub(super) struct Binder<'a> {
    pub queryables: &'a [Queryable<'a>],
    pub coordinates: FilterCoordinates<'a>,
    /// What is left of the limits.
    pub positions: usize,
    pub spatial: usize,
}

impl<'a> Binder<'a> {
    pub const fn new(queryables: &'a [Queryable<'a>], coordinates: FilterCoordinates<'a>) -> Self {
        Self { queryables, coordinates, positions: MAX_POSITIONS, spatial: MAX_SPATIAL }
    }

    /// What is true or false.
    pub fn condition(&mut self, expression: &Expression) -> Result<Condition, FilterError> {
        let Expression::Call { operator, arguments } = expression else {
            return self.typed(expression, &[ValueType::Boolean], "a condition").map(Condition::Is);
        };
        Ok(match operator {
            Operator::And => Condition::All(self.conditions(arguments)?),
            Operator::Or => Condition::Any(self.conditions(arguments)?),
            Operator::Not => Condition::Not(Box::new(self.condition(&arguments[0])?)),
            Operator::IsNull => Condition::IsNull(self.operand(&arguments[0])?.0),
            Operator::Comparison(comparison) => {
                let (one, value_type) = self.scalar(&arguments[0])?;
                Condition::Compare(*comparison, [one, self.alike(&arguments[0], value_type, &arguments[1])?])
            }
            Operator::Like => {
                let text = self.typed(&arguments[0], &[ValueType::Text], "a text for LIKE")?;
                let Operand::Text(pattern) = self.typed(&arguments[1], &[ValueType::Text], "a pattern for LIKE")?
                else {
                    return Err(FilterError::new("the pattern of LIKE must be a text in single quotes"));
                };
                Condition::Like(text, LikePattern::new(&pattern))
            }
            Operator::Between => {
                let mut number =
                    |index: usize| self.typed(&arguments[index], &[ValueType::Number], "a number for BETWEEN");
                Condition::Between([number(0)?, number(1)?, number(2)?])
            }
            Operator::In => {
                let (value, value_type) = self.scalar(&arguments[0])?;
                let Expression::Array(list) = &arguments[1] else {
                    return Err(FilterError::new("IN needs a list of values"));
                };
                let list = list.iter().map(|entry| self.alike(&arguments[0], value_type, entry));
                Condition::In(value, list.collect::<Result<_, _>>()?)
            }
            Operator::Spatial(relation) => {
                self.spatial = self
                    .spatial
                    .checked_sub(1)
                    .ok_or_else(|| FilterError::new(format!("there are more than {MAX_SPATIAL} spatial functions")))?;
                Condition::Spatial(*relation, self.pair(*operator, arguments, &[ValueType::Geometry], "a geometry")?)
            }
            Operator::Temporal(relation) => {
                let times = [ValueType::Instant, ValueType::Interval];
                Condition::Temporal(*relation, self.pair(*operator, arguments, &times, "a date, time or interval")?)
            }
            Operator::Array(relation) => {
                Condition::Arrays(*relation, self.pair(*operator, arguments, &[ValueType::Array], "an array")?)
            }
            Operator::CaseI | Operator::AccentI | Operator::Arithmetic(_) => {
                return self.typed(expression, &[ValueType::Boolean], "a condition").map(Condition::Is);
            }
        })
    }

    fn conditions(&mut self, expressions: &[Expression]) -> Result<Vec<Condition>, FilterError> {
        expressions.iter().map(|expression| self.condition(expression)).collect()
    }

    fn pair(
        &mut self,
        operator: Operator,
        arguments: &[Expression],
        types: &[ValueType],
        what: &str,
    ) -> Result<[Operand; 2], FilterError> {
        let what = format!("{what} for {}", operator.name().to_uppercase());
        Ok([self.typed(&arguments[0], types, &what)?, self.typed(&arguments[1], types, &what)?])
    }

    /// A value of one of these types.
    fn typed(&mut self, expression: &Expression, types: &[ValueType], what: &str) -> Result<Operand, FilterError> {
        let (operand, value_type) = self.operand(expression)?;
        if types.contains(&value_type) {
            return Ok(operand);
        }
        Err(FilterError::new(format!("expected {what}, found {}", described(expression, value_type))))
    }

    /// A value that has an order.
    fn scalar(&mut self, expression: &Expression) -> Result<(Operand, ValueType), FilterError> {
        let (operand, value_type) = self.operand(expression)?;
        match value_type {
            ValueType::Boolean | ValueType::Number | ValueType::Text | ValueType::Instant => Ok((operand, value_type)),
            _ => Err(FilterError::new(format!("{} cannot be compared", described(expression, value_type)))),
        }
    }

    /// A value that is compared with another one and must be of its type.
    fn alike(
        &mut self,
        first: &Expression,
        first_type: ValueType,
        expression: &Expression,
    ) -> Result<Operand, FilterError> {
        let (operand, value_type) = self.operand(expression)?;
        if value_type == first_type {
            return Ok(operand);
        }
        let [one, other] = [described(first, first_type), described(expression, value_type)];
        Err(FilterError::new(format!("{one} cannot be compared with {other}")))
    }

    /// A value with its type.
    fn operand(&mut self, expression: &Expression) -> Result<(Operand, ValueType), FilterError> {
        Ok(match expression {
            Expression::Boolean(value) => (Operand::Boolean(*value), ValueType::Boolean),
            Expression::Number(number) => (Operand::Number(*number), ValueType::Number),
            Expression::Text(text) => (Operand::Text(text.clone()), ValueType::Text),
            Expression::Instant(instant) => (Operand::Instant(*instant), ValueType::Instant),
            Expression::Interval(ends) => (self.interval(ends)?, ValueType::Interval),
            Expression::Geometry(geometry) => (self.shape(geometry)?, ValueType::Geometry),
            Expression::Bbox(bbox) => (self.bbox(*bbox)?, ValueType::Geometry),
            Expression::Property(name) => self.property(name)?,
            Expression::Array(values) => {
                let values = values.iter().map(|value| self.operand(value).map(|(operand, _)| operand));
                (Operand::Array(values.collect::<Result<_, _>>()?), ValueType::Array)
            }
            Expression::Function { name, .. } => {
                return Err(FilterError::new(format!("there is no function {}", excerpt(name))));
            }
            Expression::Call { operator: Operator::Arithmetic(arithmetic), arguments } => {
                let mut number = |index: usize| self.typed(&arguments[index], &[ValueType::Number], "a number");
                let calculated = Operand::Calculated(*arithmetic, Box::new([number(0)?, number(1)?]));
                (calculated, ValueType::Number)
            }
            Expression::Call { operator: Operator::CaseI, arguments } => self.folded(Folding::Case, &arguments[0])?,
            Expression::Call { operator: Operator::AccentI, arguments } => {
                self.folded(Folding::Accents, &arguments[0])?
            }
            Expression::Call { .. } => (Operand::Condition(Box::new(self.condition(expression)?)), ValueType::Boolean),
        })
    }

    /// A text without its case or accents; one of the filter itself is folded at once.
    fn folded(&mut self, folding: Folding, expression: &Expression) -> Result<(Operand, ValueType), FilterError> {
        let operand = match self.typed(expression, &[ValueType::Text], "a text for CASEI or ACCENTI")? {
            Operand::Text(text) => Operand::Text(folding.fold(&text)),
            other => Operand::Folded(folding, Box::new(other)),
        };
        Ok((operand, ValueType::Text))
    }

    fn property(&self, name: &str) -> Result<(Operand, ValueType), FilterError> {
        let found = self.queryables.iter().position(|queryable| queryable.name == name);
        let index = found.ok_or_else(|| {
            let near = did_you_mean(&excerpt(name), self.queryables.iter().map(|queryable| queryable.name));
            let near = near.map(|near| format!("; did you mean {near}?")).unwrap_or_default();
            let name = excerpt(name);
            FilterError::new(format!("there is no property {name}, and a text stands in single quotes{near}"))
        })?;
        Ok((Operand::Property(index), self.queryables[index].value_type))
    }

    fn interval(&self, ends: &[IntervalEnd; 2]) -> Result<Operand, FilterError> {
        if let [IntervalEnd::Instant(start), IntervalEnd::Instant(end)] = ends
            && FilterValue::Instant(*start).compare(&FilterValue::Instant(*end)) == Some(std::cmp::Ordering::Greater)
        {
            return Err(FilterError::new("an interval ends before it begins"));
        }
        let end = |end: &IntervalEnd| match end {
            IntervalEnd::Open => Ok(None),
            IntervalEnd::Instant(instant) => Ok(Some(Operand::Instant(*instant))),
            IntervalEnd::Property(name) => match self.property(name)? {
                (operand, ValueType::Instant) => Ok(Some(operand)),
                (_, other) => Err(FilterError::new(format!(
                    "expected a date or time for INTERVAL, found {} ({})",
                    excerpt(name),
                    other.name()
                ))),
            },
        };
        Ok(Operand::Interval(Box::new([end(&ends[0])?, end(&ends[1])?])))
    }

    fn bbox(&mut self, bbox: [f64; 4]) -> Result<Operand, FilterError> {
        let [west, _, east, _] = bbox;
        match (west <= east, self.coordinates.are_degrees) {
            (true, _) => self.shape(&box_shape(bbox)),
            (false, true) => self.shape(&box_across_antimeridian(bbox)),
            (false, false) => Err(FilterError::new("the box is inverted: west lies right of east")),
        }
    }

    fn shape(&mut self, geometry: &geo::Geometry) -> Result<Operand, FilterError> {
        self.positions = self.positions.checked_sub(geometry.coords_count()).ok_or_else(|| {
            FilterError::new(format!("the geometries have more than {MAX_POSITIONS} positions: simplify them"))
        })?;
        let to_data = self.coordinates.to_data;
        let moved = geometry.map_coords(|position| to_data([position.x, position.y]).into());
        LiteralShape::new(moved).map(|shape| Operand::Shape(Box::new(shape))).map_err(FilterError::new)
    }
}

/// A value as an error names it.
fn described(expression: &Expression, value_type: ValueType) -> String {
    match expression {
        Expression::Property(name) => format!("{} ({})", excerpt(name), value_type.name()),
        Expression::Text(text) => format!("the text '{}'", excerpt(text)),
        Expression::Number(number) => format!("the number {number}"),
        Expression::Instant(Instant::Date(date)) => format!("the day {date}"),
        Expression::Call { operator, .. } if value_type == ValueType::Boolean => {
            format!("a condition with {}", operator.name().to_uppercase())
        }
        _ => value_type.name().to_owned(),
    }
}
