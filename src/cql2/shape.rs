//! The shapes of filters from their positions, for both encodings.

use geo::{Coord, Geometry, LineString, MultiLineString, MultiPoint, MultiPolygon, Point, Polygon};

/// The types of shapes, in the words of GeoJSON.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ShapeType {
    Point,
    LineString,
    Polygon,
    MultiPoint,
    MultiLineString,
    MultiPolygon,
    GeometryCollection,
}

impl ShapeType {
    /// All of them, with their names in GeoJSON.
    pub const ALL: [(&'static str, Self); 7] = [
        ("Point", Self::Point),
        ("LineString", Self::LineString),
        ("Polygon", Self::Polygon),
        ("MultiPoint", Self::MultiPoint),
        ("MultiLineString", Self::MultiLineString),
        ("MultiPolygon", Self::MultiPolygon),
        ("GeometryCollection", Self::GeometryCollection),
    ];
}

/// A shape that is no collection, from the positions of its parts.
#[derive(Debug)]
pub(super) enum Positions {
    Point(Coord),
    Path(Vec<Coord>),
    Paths(Vec<Vec<Coord>>),
    Areas(Vec<Vec<Vec<Coord>>>),
}

/// The shape that these positions are, where they are as many and as deep as its type needs.
///
/// # Errors
/// When a path has fewer than two positions, or a ring fewer than four or does not end where it begins.
pub(super) fn shape(shape_type: ShapeType, positions: Positions) -> Result<Geometry, &'static str> {
    let wrong = "has positions of another type of geometry";
    Ok(match (shape_type, positions) {
        (ShapeType::Point, Positions::Point(position)) => Point(position).into(),
        (ShapeType::MultiPoint, Positions::Path(positions)) => {
            MultiPoint(positions.into_iter().map(Point).collect()).into()
        }
        (ShapeType::LineString, Positions::Path(positions)) => path(positions)?.into(),
        (ShapeType::MultiLineString, Positions::Paths(paths)) => {
            MultiLineString(paths.into_iter().map(path).collect::<Result<_, _>>()?).into()
        }
        (ShapeType::Polygon, Positions::Paths(rings)) => area(rings)?.into(),
        (ShapeType::MultiPolygon, Positions::Areas(areas)) => {
            MultiPolygon(areas.into_iter().map(area).collect::<Result<_, _>>()?).into()
        }
        _ => return Err(wrong),
    })
}

fn path(positions: Vec<Coord>) -> Result<LineString, &'static str> {
    if positions.len() < 2 { Err("a path needs two positions at least") } else { Ok(LineString(positions)) }
}

fn area(rings: Vec<Vec<Coord>>) -> Result<Polygon, &'static str> {
    let ring = |positions: Vec<Coord>| {
        if positions.len() < 4 || positions.first() != positions.last() {
            return Err("a ring needs four positions at least, and ends where it begins");
        }
        Ok(LineString(positions))
    };
    let mut rings = rings.into_iter().map(ring);
    let outer = rings.next().unwrap_or(Err("a polygon needs a ring"))?;
    Ok(Polygon::new(outer, rings.collect::<Result<_, _>>()?))
}

/// The box of four numbers, or of six with heights, which are left out.
///
/// # Errors
/// When it is none.
pub(super) fn bbox(numbers: &[f64]) -> Result<[f64; 4], &'static str> {
    match *numbers {
        [west, south, east, north] | [west, south, _, east, north, _] if south <= north => {
            Ok([west, south, east, north])
        }
        [_, _, _, _] | [_, _, _, _, _, _] => Err("is inverted: south lies above north"),
        _ => Err("needs four or six numbers: west, south, [low,] east, north[, high]"),
    }
}
