//! Shapes as a `GeoPackage` has them: a head with the box around them, then well-known binary (OGC 06-103r4, section 8).
//! Little-endian throughout.

use stillage_core::Point;
use stillage_core::geometry::Bounds;

use super::systems;
use crate::coordinates::Transform;
use crate::features::{Geometry, GeometryType, Ring};

/// `GP`, version 1 (written as 0), flags: little-endian, with a box of x and y.
const HEAD: [u8; 4] = [b'G', b'P', 0, 0b0000_0011];
/// Numbers that follow are little-endian.
const LITTLE_ENDIAN: u8 = 1;

/// A shape in bytes.
pub struct BinaryGeometry {
    /// Its bytes.
    pub bytes: Vec<u8>,
    /// The box around it, in the coordinates of the transform.
    pub bounds: Bounds,
}

/// A shape as one of this type, which is its own or several of its own; none for a shape without positions.
pub fn of_shape(geometry: &Geometry, shape: GeometryType, transform: &Transform) -> Option<BinaryGeometry> {
    let corners: Vec<Point> = geometry.points().map(|&point| Point::from(transform.forward(point))).collect();
    let bounds = Bounds::around(&corners);
    if bounds.is_empty() {
        return None;
    }
    let mut bytes = HEAD.to_vec();
    bytes.extend(systems::id(transform.crs()).to_le_bytes());
    for side in [bounds.low.x, bounds.high.x, bounds.low.y, bounds.high.y] {
        bytes.extend(side.to_le_bytes());
    }
    let mut writer = Writer { transform, bytes };
    match geometry {
        Geometry::LineString(path) if shape == GeometryType::MultiLineString => writer.paths(&[path.as_slice()]),
        Geometry::Polygon(rings) if shape == GeometryType::MultiPolygon => writer.areas(&[rings.as_slice()]),
        Geometry::Point(point) => {
            writer.begin(GeometryType::Point);
            writer.position(*point);
        }
        Geometry::LineString(path) => writer.path(path),
        Geometry::MultiLineString(paths) => writer.paths(&paths.iter().map(Vec::as_slice).collect::<Vec<_>>()),
        Geometry::Polygon(rings) => writer.area(rings),
        Geometry::MultiPolygon(polygons) => writer.areas(&polygons.iter().map(Vec::as_slice).collect::<Vec<_>>()),
    }
    Some(BinaryGeometry { bytes: writer.bytes, bounds })
}

/// Well-known binary, shape by shape.
struct Writer<'a> {
    transform: &'a Transform,
    bytes: Vec<u8>,
}

impl Writer<'_> {
    fn begin(&mut self, shape: GeometryType) {
        let code: u32 = match shape {
            GeometryType::Point => 1,
            GeometryType::LineString => 2,
            GeometryType::Polygon => 3,
            GeometryType::MultiLineString => 5,
            GeometryType::MultiPolygon => 6,
        };
        self.bytes.push(LITTLE_ENDIAN);
        self.bytes.extend(code.to_le_bytes());
    }

    fn count(&mut self, count: usize) {
        self.bytes.extend((count as u32).to_le_bytes());
    }

    fn position(&mut self, point: Point) {
        self.bytes.extend(self.transform.forward(point).into_iter().flat_map(f64::to_le_bytes));
    }

    fn path(&mut self, path: &[Point]) {
        self.begin(GeometryType::LineString);
        self.count(path.len());
        for &point in path {
            self.position(point);
        }
    }

    /// A ring ends with the position with which it begins.
    fn area(&mut self, rings: &[Ring]) {
        self.begin(GeometryType::Polygon);
        self.count(rings.len());
        for ring in rings {
            self.count(ring.len() + ring.first().iter().len());
            for &point in ring.iter().chain(ring.first()) {
                self.position(point);
            }
        }
    }

    fn paths(&mut self, paths: &[&[Point]]) {
        self.begin(GeometryType::MultiLineString);
        self.count(paths.len());
        for path in paths {
            self.path(path);
        }
    }

    fn areas(&mut self, polygons: &[&[Ring]]) {
        self.begin(GeometryType::MultiPolygon);
        self.count(polygons.len());
        for rings in polygons {
            self.area(rings);
        }
    }
}
