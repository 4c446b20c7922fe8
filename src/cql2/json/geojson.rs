//! Shapes in `cql2-json`: GeoJSON geometries (RFC 7946).

use geo::{Coord, Geometry, GeometryCollection};
use serde_json::{Map, Value};

use stillage_core::excerpt;

use crate::cql2::error::FilterError;
use crate::cql2::shape::{self, Positions, ShapeType};

/// Reads a geometry.
///
/// # Errors
/// With the JSON pointer of what is wrong.
pub fn read(object: &Map<String, Value>, pointer: &str) -> Result<Geometry, FilterError> {
    match shape_type(object, pointer)? {
        ShapeType::GeometryCollection => collection(object, pointer),
        shape_type => plain(shape_type, object, pointer),
    }
}

fn collection(object: &Map<String, Value>, pointer: &str) -> Result<Geometry, FilterError> {
    let pointer = format!("{pointer}/geometries");
    let member = |(index, member): (usize, &Value)| {
        let pointer = format!("{pointer}/{index}");
        let object = member.as_object().ok_or_else(|| FilterError::at(&pointer, "must be a GeoJSON geometry"))?;
        match shape_type(object, &pointer)? {
            ShapeType::GeometryCollection => Err(FilterError::at(&pointer, "a collection in a collection is not read")),
            shape_type => plain(shape_type, object, &pointer),
        }
    };
    let members = object.get("geometries").and_then(Value::as_array).filter(|members| !members.is_empty());
    let members = members.ok_or_else(|| FilterError::at(&pointer, "must be an array of geometries"))?;
    let members = members.iter().enumerate().map(member).collect::<Result<_, _>>()?;
    Ok(Geometry::GeometryCollection(GeometryCollection(members)))
}

fn shape_type(object: &Map<String, Value>, pointer: &str) -> Result<ShapeType, FilterError> {
    let name = object.get("type").and_then(Value::as_str).unwrap_or_default();
    let known = ShapeType::ALL.iter().find(|(known, _)| *known == name).map(|&(_, shape_type)| shape_type);
    known.ok_or_else(|| {
        let names = ShapeType::ALL.map(|(name, _)| name).join(", ");
        FilterError::at(&format!("{pointer}/type"), format!("{:?} is none of {names}", excerpt(name)))
    })
}

/// A geometry that is no collection.
fn plain(shape_type: ShapeType, object: &Map<String, Value>, pointer: &str) -> Result<Geometry, FilterError> {
    let nothing = Value::Null;
    let coordinates = object.get("coordinates").unwrap_or(&nothing);
    let place = format!("{pointer}/coordinates");
    let positions = match shape_type {
        ShapeType::Point => Positions::Point(position(coordinates, &place)?),
        ShapeType::MultiPoint | ShapeType::LineString => Positions::Path(path(coordinates, &place)?),
        ShapeType::Polygon | ShapeType::MultiLineString => Positions::Paths(list(coordinates, &place, path)?),
        ShapeType::MultiPolygon | ShapeType::GeometryCollection => {
            Positions::Areas(list(coordinates, &place, |rings, place| list(rings, place, path))?)
        }
    };
    shape::shape(shape_type, positions).map_err(|detail| FilterError::at(pointer, detail))
}

fn list<T>(
    value: &Value,
    pointer: &str,
    entry: impl Fn(&Value, &str) -> Result<T, FilterError>,
) -> Result<Vec<T>, FilterError> {
    let entries = value.as_array().ok_or_else(|| FilterError::at(pointer, "must be an array"))?;
    entries.iter().enumerate().map(|(index, value)| entry(value, &format!("{pointer}/{index}"))).collect()
}

fn path(value: &Value, pointer: &str) -> Result<Vec<Coord>, FilterError> {
    list(value, pointer, position)
}

/// Two numbers; what comes after them is left out.
fn position(value: &Value, pointer: &str) -> Result<Coord, FilterError> {
    let numbers: Vec<f64> = value.as_array().into_iter().flatten().filter_map(Value::as_f64).collect();
    match numbers.as_slice() {
        &[x, y, ..] => Ok(Coord { x, y }),
        _ => Err(FilterError::at(pointer, "must be a position: an array of two numbers")),
    }
}
