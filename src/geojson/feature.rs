//! Features, and how they are written as JSON bytes.
//!
//! Coordinates are written with a fixed number of decimals and without trailing zeros, straight into the buffer: a
//! layer of 7,000 faces is some 100,000 numbers.

use serde::Serialize;
use serde_json::{Map, Value};
use stillage_core::Point;

use super::transform::Transform;

/// A feature in map-frame metres.
#[derive(Debug, Clone, PartialEq)]
pub struct Feature {
    /// Unique in its collection.
    pub id: FeatureId,
    /// Smallest x and y, largest x and y, map frame, metres.
    pub bbox: [f64; 4],
    /// Its shape, map frame, metres.
    pub geometry: Geometry,
    /// Its properties, in the order of the documentation.
    pub properties: Map<String, Value>,
}

/// The id of a feature.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
#[serde(untagged)]
pub enum FeatureId {
    /// Faces, edges and all else.
    Number(u64),
    /// The code of a location.
    Text(String),
}

impl std::fmt::Display for FeatureId {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Number(number) => number.fmt(formatter),
            Self::Text(text) => text.fmt(formatter),
        }
    }
}

/// A ring of a polygon; the first point is not repeated.
pub type Ring = Vec<Point>;

/// A shape in map-frame metres. Polygons: the outer ring counter-clockwise, then holes clockwise (RFC 7946).
#[derive(Debug, Clone, PartialEq)]
pub enum Geometry {
    /// A position.
    Point(Point),
    /// A path.
    LineString(Vec<Point>),
    /// Several paths.
    MultiLineString(Vec<Vec<Point>>),
    /// An area.
    Polygon(Vec<Ring>),
    /// Several areas.
    MultiPolygon(Vec<Vec<Ring>>),
}

impl Geometry {
    /// One area or several, as it comes.
    #[must_use]
    pub(super) fn area(mut polygons: Vec<Vec<Ring>>) -> Self {
        match polygons.len() {
            0 => Self::Polygon(Vec::new()),
            1 => Self::Polygon(polygons.remove(0)),
            _ => Self::MultiPolygon(polygons),
        }
    }

    /// Every position of the shape.
    pub fn points(&self) -> impl Iterator<Item = Point> {
        let paths: Vec<&[Point]> = match self {
            Self::Point(point) => vec![std::slice::from_ref(point)],
            Self::LineString(path) => vec![path],
            Self::MultiLineString(paths) | Self::Polygon(paths) => paths.iter().map(Vec::as_slice).collect(),
            Self::MultiPolygon(polygons) => polygons.iter().flatten().map(Vec::as_slice).collect(),
        };
        paths.into_iter().flatten().copied()
    }

    /// The name of its type in GeoJSON.
    #[must_use]
    pub const fn type_name(&self) -> &'static str {
        match self {
            Self::Point(_) => "Point",
            Self::LineString(_) => "LineString",
            Self::MultiLineString(_) => "MultiLineString",
            Self::Polygon(_) => "Polygon",
            Self::MultiPolygon(_) => "MultiPolygon",
        }
    }

    /// Writes the shape as a GeoJSON geometry object.
    pub fn write(&self, transform: &Transform, out: &mut Vec<u8>) {
        out.extend_from_slice(b"{\"type\":\"");
        out.extend_from_slice(self.type_name().as_bytes());
        out.extend_from_slice(b"\",\"coordinates\":");
        match self {
            Self::Point(point) => write_position(*point, transform, out),
            Self::LineString(path) => write_path(path, false, transform, out),
            Self::MultiLineString(paths) => {
                write_list(paths, out, |path, out| write_path(path, false, transform, out));
            }
            Self::Polygon(rings) => write_list(rings, out, |ring, out| write_path(ring, true, transform, out)),
            Self::MultiPolygon(polygons) => write_list(polygons, out, |rings, out| {
                write_list(rings, out, |ring, out| write_path(ring, true, transform, out));
            }),
        }
        out.push(b'}');
    }
}

impl Feature {
    /// A feature with its bounds.
    pub(super) fn new(id: FeatureId, geometry: Geometry, properties: Map<String, Value>) -> Self {
        Self { id, bbox: bounds(geometry.points()), geometry, properties }
    }

    /// Writes the feature as a GeoJSON object.
    pub fn write(&self, transform: &Transform, out: &mut Vec<u8>) {
        self.write_with(transform, |_, _| true, out);
    }

    /// Writes the feature with the properties that `keep` wants.
    pub fn write_with(&self, transform: &Transform, keep: impl Fn(&str, &Value) -> bool, out: &mut Vec<u8>) {
        out.extend_from_slice(b"{\"type\":\"Feature\",\"id\":");
        write_json(&self.id, out);
        out.extend_from_slice(b",\"geometry\":");
        self.geometry.write(transform, out);
        out.extend_from_slice(b",\"properties\":{");
        let mut first = true;
        for (name, value) in self.properties.iter().filter(|(name, value)| keep(name, value)) {
            if !std::mem::take(&mut first) {
                out.push(b',');
            }
            write_json(name, out);
            out.push(b':');
            write_json(value, out);
        }
        out.extend_from_slice(b"}}");
    }
}

/// A whole `FeatureCollection`. In metres it names its coordinates by the `crs` member of GeoJSON 2008, which RFC 7946
/// dropped and GIS tools still read.
#[must_use]
pub fn feature_collection(features: &[Feature], transform: &Transform) -> Vec<u8> {
    let mut out = b"{\"type\":\"FeatureCollection\",".to_vec();
    if let Some(name) = transform.crs_name() {
        out.extend_from_slice(b"\"crs\":{\"type\":\"name\",\"properties\":{\"name\":");
        write_json(&name, &mut out);
        out.extend_from_slice(b"}},");
    }
    out.extend_from_slice(b"\"features\":");
    // A feature a line: readable, and small differences stay small.
    write_list(features, &mut out, |feature, out| {
        out.push(b'\n');
        feature.write(transform, out);
    });
    out.extend_from_slice(b"}\n");
    out
}

/// Smallest and largest x and y.
fn bounds(points: impl Iterator<Item = Point>) -> [f64; 4] {
    let empty = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
    points.fold(empty, |[west, south, east, north], point| {
        [west.min(point.x), south.min(point.y), east.max(point.x), north.max(point.y)]
    })
}

fn write_json(value: &impl Serialize, out: &mut Vec<u8>) {
    serde_json::to_writer(out, value).expect("text, numbers and values always serialize into memory");
}

fn write_list<T>(items: &[T], out: &mut Vec<u8>, write: impl Fn(&T, &mut Vec<u8>)) {
    out.push(b'[');
    for (index, item) in items.iter().enumerate() {
        if index > 0 {
            out.push(b',');
        }
        write(item, out);
    }
    out.push(b']');
}

/// Positions of a path; a ring ends with its first one.
fn write_path(path: &[Point], closed: bool, transform: &Transform, out: &mut Vec<u8>) {
    out.push(b'[');
    let last = if closed { path.first() } else { None };
    for (index, point) in path.iter().chain(last).enumerate() {
        if index > 0 {
            out.push(b',');
        }
        write_position(*point, transform, out);
    }
    out.push(b']');
}

fn write_position(point: Point, transform: &Transform, out: &mut Vec<u8>) {
    let [x, y] = transform.forward(point);
    out.push(b'[');
    write_decimal(x, transform.decimals(), out);
    out.push(b',');
    write_decimal(y, transform.decimals(), out);
    out.push(b']');
}

/// Writes a number rounded to some decimals, without trailing zeros and without -0.
fn write_decimal(value: f64, decimals: u32, out: &mut Vec<u8>) {
    let unit = 10_u64.pow(decimals);
    // Degrees with nine decimals and metres of the world with four stay far below 2^53.
    let scaled = (value * unit as f64).round() as i64;
    if scaled < 0 {
        out.push(b'-');
    }
    let (whole, mut fraction) = (scaled.unsigned_abs() / unit, scaled.unsigned_abs() % unit);
    write_digits(whole, 1, out);
    if fraction > 0 {
        let mut digits = decimals as usize;
        while fraction.is_multiple_of(10) {
            fraction /= 10;
            digits -= 1;
        }
        out.push(b'.');
        write_digits(fraction, digits, out);
    }
}

/// Writes a whole number with at least so many digits.
fn write_digits(mut number: u64, at_least: usize, out: &mut Vec<u8>) {
    let mut digits = [b'0'; 20];
    let mut start = digits.len();
    while number > 0 || digits.len() - start < at_least {
        start -= 1;
        digits[start] = b'0' + (number % 10) as u8;
        number /= 10;
    }
    out.extend_from_slice(&digits[start..]);
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn decimal(value: f64, decimals: u32) -> String {
        let mut out = Vec::new();
        write_decimal(value, decimals, &mut out);
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn numbers_are_short() {
        let cases = [
            (0.0, 4, "0"),
            (-0.0, 4, "0"),
            (-0.000_01, 4, "0"),
            (1.5, 4, "1.5"),
            (-12.05, 4, "-12.05"),
            (0.000_000_001_4, 9, "0.000000001"),
            (179.999_999_999_9, 9, "180"),
            (-20_037_508.342_8, 4, "-20037508.3428"),
        ];
        for (value, decimals, text) in cases {
            assert_eq!(decimal(value, decimals), text);
        }
    }

    proptest! {
        #[test]
        fn numbers_are_right(value in -180.0..180.0) {
            let read: f64 = decimal(value, 9).parse().unwrap();
            prop_assert!((read - value).abs() <= 0.500_001e-9);
        }
    }
}
