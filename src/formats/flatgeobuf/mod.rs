//! Features -> `FlatGeobuf` 3, the binary format that GIS read at once.
//!
//! Source: github.com/flatgeobuf/flatgeobuf, `header.fbs` and `feature.fbs`. Method: magic bytes, a header with the columns
//! of the collection, then a buffer for each feature. Numbers, truths and texts are columns of their own type, lists and
//! poses are JSON; what is missing is left out. Collections of areas or of paths are written as several areas or paths
//! each, so that a file has one type of shape. Coordinates are those of the transform; degrees are told as EPSG:4326 with
//! the longitude first, as this format has it. Cost: O(corners + values). Limits: no spatial index, so that features stay
//! in the order of their ids.

mod flat_buffer;
#[cfg(test)]
mod tests;

use stillage_core::Point;
use stillage_core::geometry::Bounds;

use crate::coordinates::{Crs, Transform};
use crate::features::query::PropertySelection;
use crate::features::{CollectionSchema, Feature, Geometry, GeometryType, Kind, Property, Value};

use flat_buffer::{Field, FlatTable, buffer};

/// `fgb`, major version 3, `fgb`, patch 0.
const MAGIC: [u8; 8] = *b"fgb\x03fgb\x00";

/// Types of columns.
const BOOLEAN: u8 = 2;
const LONG: u8 = 7;
const DOUBLE: u8 = 10;
const STRING: u8 = 11;
const JSON: u8 = 12;

/// Features of a collection with some of their properties as a file.
#[must_use]
pub fn collection<'a>(
    properties: &PropertySelection,
    features: impl IntoIterator<Item = &'a Feature>,
    transform: &Transform,
) -> Vec<u8> {
    let collection = properties.collection();
    let schema = CollectionSchema::of(collection);
    let shape = FileShape::of(schema.geometry);
    let mut bodies = Vec::new();
    let (mut count, mut bounds) = (0, Bounds::EMPTY);
    for feature in features {
        let corners: Vec<Point> =
            feature.geometry.points().map(|&point| Point::from(transform.forward(point))).collect();
        let own = Bounds::around(&corners);
        bounds = Bounds { low: bounds.low.inf(&own.low), high: bounds.high.sup(&own.high) };
        bodies.extend(buffer(&body(feature, shape, properties, transform)));
        count += 1;
    }
    let mut header = FlatTable(vec![
        (0, Field::Text(collection.id())),
        (2, Field::Byte(shape as u8)),
        (7, Field::Tables(properties.properties().map(|property| column(property, schema)).collect())),
        (8, Field::Long(count)),
        // No index.
        (9, Field::Short(0)),
        (10, Field::Table(crs(transform.crs()))),
        (11, Field::Text(schema.title)),
        (12, Field::Text(schema.description)),
    ]);
    if !bounds.is_empty() {
        header.0.push((1, Field::Doubles(vec![bounds.low.x, bounds.low.y, bounds.high.x, bounds.high.y])));
    }
    [MAGIC.to_vec(), buffer(&header), bodies].concat()
}

/// What shapes a file has, by their number in the format.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum FileShape {
    Point = 1,
    LineString = 2,
    Polygon = 3,
    MultiLineString = 5,
    MultiPolygon = 6,
}

impl FileShape {
    /// The one type that takes all of these.
    fn of(types: &[GeometryType]) -> Self {
        match types.last() {
            None | Some(GeometryType::Point) => Self::Point,
            Some(GeometryType::LineString) => Self::LineString,
            Some(GeometryType::Polygon) => Self::Polygon,
            Some(GeometryType::MultiLineString) => Self::MultiLineString,
            Some(GeometryType::MultiPolygon) => Self::MultiPolygon,
        }
    }
}

fn crs(crs: Crs) -> FlatTable<'static> {
    // Degrees are those of EPSG:4326: this format has the longitude first, whatever the registry says.
    let code = crs.epsg().unwrap_or(4326);
    FlatTable(vec![(0, Field::Text("EPSG")), (1, Field::Int(code as i32))])
}

fn column(property: &Property, schema: &CollectionSchema) -> FlatTable<'static> {
    let Property { name, title, description, kind, nullable, .. } = *property;
    let r#type = match kind {
        Kind::Boolean => BOOLEAN,
        Kind::Integer => LONG,
        Kind::Number => DOUBLE,
        Kind::Text | Kind::Word(_) => STRING,
        _ => JSON,
    };
    FlatTable(vec![
        (0, Field::Text(name)),
        (1, Field::Byte(r#type)),
        (2, Field::Text(title)),
        (3, Field::Text(description)),
        (7, Field::Byte(u8::from(nullable))),
        (8, Field::Byte(u8::from(property.name == schema.properties[0].name))),
    ])
}

fn body(
    feature: &Feature,
    shape: FileShape,
    properties: &PropertySelection,
    transform: &Transform,
) -> FlatTable<'static> {
    let mut table = FlatTable(vec![(1, Field::Bytes(values(feature, properties)))]);
    if feature.geometry.points().next().is_some() {
        table.0.push((0, Field::Table(geometry(&feature.geometry, shape, transform))));
    }
    table
}

/// The values of a feature: number of the column and value.
fn values(feature: &Feature, properties: &PropertySelection) -> Vec<u8> {
    let mut out = Vec::new();
    for (index, (property, value)) in properties.values(feature).enumerate() {
        if value.is_null() {
            continue;
        }
        out.extend((index as u16).to_le_bytes());
        match (property.kind, value) {
            (_, Value::Boolean(truth)) => out.push(u8::from(truth)),
            (Kind::Integer, Value::Integer(number)) => out.extend(number.to_le_bytes()),
            (_, Value::Number(number)) => out.extend(number.to_le_bytes()),
            (_, Value::Text(words)) => text(words, &mut out),
            (_, other) => {
                let json = serde_json::to_string(&other).expect("values are texts and finite numbers");
                text(&json, &mut out);
            }
        }
    }
    out
}

fn text(text: &str, out: &mut Vec<u8>) {
    out.extend((text.len() as u32).to_le_bytes());
    out.extend(text.bytes());
}

fn geometry(geometry: &Geometry, shape: FileShape, transform: &Transform) -> FlatTable<'static> {
    let positions = |points: &mut dyn Iterator<Item = &Point>| -> Vec<f64> {
        points.flat_map(|&point| transform.forward(point)).collect()
    };
    let mut table = match geometry {
        Geometry::Point(point) => FlatTable(vec![(1, Field::Doubles(positions(&mut std::iter::once(point))))]),
        Geometry::LineString(path) => paths(std::slice::from_ref(path), false, transform),
        Geometry::MultiLineString(all) => paths(all, false, transform),
        Geometry::Polygon(rings) if shape == FileShape::MultiPolygon => several(std::slice::from_ref(rings), transform),
        Geometry::Polygon(rings) => paths(rings, true, transform),
        Geometry::MultiPolygon(polygons) => several(polygons, transform),
    };
    table.0.push((6, Field::Byte(shape as u8)));
    table
}

fn several(polygons: &[Vec<Vec<Point>>], transform: &Transform) -> FlatTable<'static> {
    let part = |rings: &Vec<Vec<Point>>| {
        let mut part = paths(rings, true, transform);
        part.0.push((6, Field::Byte(FileShape::Polygon as u8)));
        part
    };
    FlatTable(vec![(7, Field::Tables(polygons.iter().map(part).collect()))])
}

/// Paths, or rings that end where they begin: where each ends, counted in positions, and all positions.
fn paths(paths: &[Vec<Point>], is_closed: bool, transform: &Transform) -> FlatTable<'static> {
    let (mut ends, mut positions) = (Vec::new(), Vec::new());
    for path in paths {
        let last = path.first().filter(|_| is_closed);
        positions.extend(path.iter().chain(last).flat_map(|&point| transform.forward(point)));
        ends.push((positions.len() / 2) as u32);
    }
    FlatTable(vec![(0, Field::Uints(ends)), (1, Field::Doubles(positions))])
}
