//! The expressions of `cql2-json`.

use serde_json::{Map, Value};

use stillage_core::excerpt;

use super::geojson;
use crate::cql2::error::FilterError;
use crate::cql2::expression::Expression;
use crate::cql2::instant::{Instant, IntervalEnd};
use crate::cql2::limits::{MAX_DEPTH, check_length};
use crate::cql2::operator::Operator;
use crate::cql2::shape;

/// Reads a filter in `cql2-json`. O(length).
///
/// # Errors
/// The JSON pointer and what was expected there; when the filter is longer or deeper than the limits.
pub fn read(text: &str) -> Result<Expression, FilterError> {
    check_length(text)?;
    let value: Value = serde_json::from_str(text).map_err(|error| {
        // serde_json stops at 128 levels, and tells it by its message alone.
        let detail = if error.to_string().starts_with("recursion limit") {
            format!("there are more than {MAX_DEPTH} levels within one another")
        } else {
            format!("is not JSON from line {}, column {} on", error.line(), error.column())
        };
        FilterError::new(detail)
    })?;
    expression(&value, "", 1)
}

fn expression(value: &Value, pointer: &str, depth: usize) -> Result<Expression, FilterError> {
    if depth > MAX_DEPTH {
        return Err(FilterError::new(format!("there are more than {MAX_DEPTH} levels within one another")));
    }
    match value {
        Value::Bool(value) => Ok(Expression::Boolean(*value)),
        Value::Number(number) => number
            .as_f64()
            .filter(|number| number.is_finite())
            .map(Expression::Number)
            .ok_or_else(|| FilterError::at(pointer, "is too large a number")),
        Value::String(text) => Ok(Expression::Text(text.clone())),
        Value::Array(entries) => expressions(entries, pointer, depth).map(Expression::Array),
        Value::Object(object) => member(object, pointer, depth),
        Value::Null => Err(FilterError::at(pointer, "null is no value: the operator isNull tests for it")),
    }
}

fn expressions(entries: &[Value], pointer: &str, depth: usize) -> Result<Vec<Expression>, FilterError> {
    let entry = |(index, entry)| expression(entry, &format!("{pointer}/{index}"), depth + 1);
    entries.iter().enumerate().map(entry).collect()
}

/// An object: what it is follows from its members.
fn member(object: &Map<String, Value>, pointer: &str, depth: usize) -> Result<Expression, FilterError> {
    let text = |name: &str| {
        let text = object[name].as_str();
        text.ok_or_else(|| FilterError::at(&format!("{pointer}/{name}"), "must be a text"))
    };
    let instant = |name: &str, read: fn(&str) -> Result<Instant, &'static str>| {
        let text = text(name)?;
        let instant = read(text);
        instant.map(Expression::Instant).map_err(|detail| FilterError::at(&format!("{pointer}/{name}"), detail))
    };
    let has = |name: &str| object.contains_key(name);
    if has("op") {
        operation(text("op")?, object, pointer, depth)
    } else if has("property") {
        Ok(Expression::Property(text("property")?.to_owned()))
    } else if has("date") {
        instant("date", Instant::date)
    } else if has("timestamp") {
        instant("timestamp", Instant::timestamp)
    } else if has("interval") {
        interval(&object["interval"], &format!("{pointer}/interval"))
    } else if has("type") {
        geojson::read(object, pointer).map(Expression::Geometry)
    } else if has("bbox") {
        bbox(&object["bbox"], &format!("{pointer}/bbox"))
    } else {
        Err(FilterError::at(pointer, "must have op, property, date, timestamp, interval, type or bbox"))
    }
}

fn operation(name: &str, object: &Map<String, Value>, pointer: &str, depth: usize) -> Result<Expression, FilterError> {
    let place = format!("{pointer}/args");
    let entries = object.get("args").and_then(Value::as_array);
    let entries = entries.ok_or_else(|| FilterError::at(&place, "must be an array"))?;
    let Some(operator) = Operator::named(name) else {
        let arguments = expressions(entries, &place, depth)?;
        return Ok(Expression::Function { name: name.to_owned(), arguments });
    };
    let count = operator.arguments();
    if !count.contains(&entries.len()) {
        let detail = if count.start() == count.end() { String::new() } else { " or more".to_owned() };
        return Err(FilterError::at(&place, format!("{} takes {}{detail}", excerpt(name), count.start())));
    }
    let arguments = expressions(entries, &place, depth)?;
    match arguments.get(1) {
        Some(Expression::Array(_)) => {}
        Some(_) if operator == Operator::In => {
            return Err(FilterError::at(&format!("{place}/1"), "must be an array of values"));
        }
        _ => {}
    }
    Ok(Expression::call(operator, arguments))
}

fn interval(value: &Value, pointer: &str) -> Result<Expression, FilterError> {
    let Some([start, end]) = value.as_array().map(Vec::as_slice) else {
        return Err(FilterError::at(pointer, "must be an array of a start and an end"));
    };
    let end_of = |value: &Value, index: usize| {
        let property = value.get("property").and_then(Value::as_str);
        match (value.as_str(), property) {
            (_, Some(property)) => Ok(IntervalEnd::Property(property.to_owned())),
            (Some(text), _) => {
                IntervalEnd::read(text).map_err(|detail| FilterError::at(&format!("{pointer}/{index}"), detail))
            }
            _ => Err(FilterError::at(&format!("{pointer}/{index}"), "must be a text or a property")),
        }
    };
    Ok(Expression::Interval([end_of(start, 0)?, end_of(end, 1)?]))
}

fn bbox(value: &Value, pointer: &str) -> Result<Expression, FilterError> {
    let numbers: Option<Vec<f64>> = value.as_array().map(|all| all.iter().map_while(Value::as_f64).collect());
    let is_numbers = numbers.as_ref().map(Vec::len) == value.as_array().map(Vec::len);
    let numbers = numbers.filter(|_| is_numbers).unwrap_or_default();
    shape::bbox(&numbers).map(Expression::Bbox).map_err(|detail| FilterError::at(pointer, detail))
}
