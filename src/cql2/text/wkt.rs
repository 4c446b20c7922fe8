//! Shapes in `cql2-text`: Well-Known Text, and `BBOX`.

use geo::{Coord, Geometry, GeometryCollection};

use super::cursor::Cursor;
use super::token::Word;
use crate::cql2::error::FilterError;
use crate::cql2::expression::Expression;
use crate::cql2::shape::{self, Positions, ShapeType};

/// The shape that comes next; `None` where none begins. A name is a type only before a parenthesis: `point` may be a
/// property as well.
///
/// # Errors
/// Where the shape is broken.
pub fn read(cursor: &mut Cursor<'_>) -> Result<Option<Expression>, FilterError> {
    if cursor.peek().is_keyword("BBOX") && *cursor.peek_after(1) == Word::Sign("(") {
        return bbox(cursor).map(Some);
    }
    let Some(shape_type) = shape_type(cursor) else { return Ok(None) };
    let geometry =
        if shape_type == ShapeType::GeometryCollection { collection(cursor) } else { tagged(cursor, shape_type) };
    geometry.map(|geometry| Some(Expression::Geometry(geometry)))
}

fn shape_type(cursor: &Cursor<'_>) -> Option<ShapeType> {
    let has_heights = usize::from(cursor.peek_after(1).is_keyword("Z"));
    let is_followed = *cursor.peek_after(1 + has_heights) == Word::Sign("(");
    let known = ShapeType::ALL.iter().find(|(name, _)| cursor.peek().is_keyword(name));
    known.filter(|_| is_followed).map(|&(_, shape_type)| shape_type)
}

fn collection(cursor: &mut Cursor<'_>) -> Result<Geometry, FilterError> {
    cursor.next();
    cursor.take_keyword("Z");
    let member = |cursor: &mut Cursor<'_>| match shape_type(cursor) {
        None | Some(ShapeType::GeometryCollection) => {
            Err(cursor.expected("a POINT, LINESTRING, POLYGON, MULTIPOINT, MULTILINESTRING or MULTIPOLYGON"))
        }
        Some(shape_type) => tagged(cursor, shape_type),
    };
    Ok(Geometry::GeometryCollection(GeometryCollection(list(cursor, member)?)))
}

/// The name of a type and the positions after it.
fn tagged(cursor: &mut Cursor<'_>, shape_type: ShapeType) -> Result<Geometry, FilterError> {
    let start = cursor.start();
    cursor.next();
    cursor.take_keyword("Z");
    let positions = match shape_type {
        ShapeType::Point => {
            cursor.expect_sign("(")?;
            let point = position(cursor)?;
            cursor.expect_sign(")")?;
            Positions::Point(point)
        }
        ShapeType::MultiPoint => Positions::Path(list(cursor, point)?),
        ShapeType::LineString => Positions::Path(list(cursor, position)?),
        ShapeType::Polygon | ShapeType::MultiLineString => Positions::Paths(list(cursor, path)?),
        ShapeType::MultiPolygon | ShapeType::GeometryCollection => {
            Positions::Areas(list(cursor, |cursor| list(cursor, path))?)
        }
    };
    shape::shape(shape_type, positions).map_err(|detail| cursor.wrong_at(start, detail))
}

/// Things between parentheses, with commas between them.
fn list<'a, T>(
    cursor: &mut Cursor<'a>,
    mut entry: impl FnMut(&mut Cursor<'a>) -> Result<T, FilterError>,
) -> Result<Vec<T>, FilterError> {
    cursor.expect_sign("(")?;
    let mut entries = vec![entry(cursor)?];
    while cursor.take_sign(",") {
        entries.push(entry(cursor)?);
    }
    if cursor.take_sign(")") { Ok(entries) } else { Err(cursor.expected(", or )")) }
}

fn path(cursor: &mut Cursor<'_>) -> Result<Vec<Coord>, FilterError> {
    list(cursor, position)
}

/// A point of several, which some programs write without parentheses.
fn point(cursor: &mut Cursor<'_>) -> Result<Coord, FilterError> {
    let is_enclosed = cursor.take_sign("(");
    let point = position(cursor)?;
    if is_enclosed {
        cursor.expect_sign(")")?;
    }
    Ok(point)
}

/// Two numbers; a third one is a height, which is left out.
fn position(cursor: &mut Cursor<'_>) -> Result<Coord, FilterError> {
    let (x, y) = (cursor.expect_number()?, cursor.expect_number()?);
    if !matches!(cursor.peek(), Word::Sign("," | ")")) {
        cursor.expect_number()?;
    }
    Ok(Coord { x, y })
}

fn bbox(cursor: &mut Cursor<'_>) -> Result<Expression, FilterError> {
    let start = cursor.start();
    cursor.next();
    let numbers = list(cursor, Cursor::expect_number)?;
    let bbox = shape::bbox(&numbers).map_err(|detail| cursor.wrong_at(start, format!("the box {detail}")))?;
    Ok(Expression::Bbox(bbox))
}
