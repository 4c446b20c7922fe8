//! Days, moments and intervals in `cql2-text`.

use stillage_core::excerpt;

use super::cursor::Cursor;
use super::token::Word;
use crate::cql2::error::FilterError;
use crate::cql2::expression::Expression;
use crate::cql2::instant::{Instant, IntervalEnd};

/// `DATE('2026-01-31')` or `TIMESTAMP('2026-01-31T12:30:00Z')`, at its name.
///
/// # Errors
/// Where something else comes.
pub fn instant(
    cursor: &mut Cursor<'_>,
    read: fn(&str) -> Result<Instant, &'static str>,
) -> Result<Expression, FilterError> {
    cursor.next();
    cursor.expect_sign("(")?;
    let instant = literal(cursor, read)?;
    cursor.expect_sign(")")?;
    Ok(Expression::Instant(instant))
}

/// `INTERVAL('2026-01-31', '..')`, at its name.
///
/// # Errors
/// Where something else comes.
pub fn interval(cursor: &mut Cursor<'_>) -> Result<Expression, FilterError> {
    cursor.next();
    cursor.expect_sign("(")?;
    let start = interval_end(cursor)?;
    cursor.expect_sign(",")?;
    let end = interval_end(cursor)?;
    cursor.expect_sign(")")?;
    Ok(Expression::Interval([start, end]))
}

fn interval_end(cursor: &mut Cursor<'_>) -> Result<IntervalEnd, FilterError> {
    match cursor.peek().clone() {
        Word::Name(name) | Word::Quoted(name) => {
            cursor.next();
            Ok(IntervalEnd::Property(name))
        }
        _ => literal(cursor, IntervalEnd::read),
    }
}

/// A text that is read as something.
fn literal<T>(cursor: &mut Cursor<'_>, read: impl Fn(&str) -> Result<T, &'static str>) -> Result<T, FilterError> {
    let Word::Text(text) = cursor.peek() else { return Err(cursor.expected("a text in single quotes")) };
    let value = read(text).map_err(|detail| cursor.wrong(format!("'{}' {detail}", excerpt(text))))?;
    cursor.next();
    Ok(value)
}
