//! The shapes of features, in map-frame metres.

use stillage_core::Point;
use stillage_core::geometry::{Bounds, polygon, segment};

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

/// The types of shapes, in the words of OGC Simple Features (06-103r4).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GeometryType {
    /// A position.
    Point,
    /// A path.
    LineString,
    /// Several paths.
    MultiLineString,
    /// An area.
    Polygon,
    /// Several areas.
    MultiPolygon,
}

impl GeometryType {
    /// A path or several.
    pub const PATHS: &[Self] = &[Self::LineString, Self::MultiLineString];
    /// An area or several.
    pub const AREAS: &[Self] = &[Self::Polygon, Self::MultiPolygon];

    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Point => "Point",
            Self::LineString => "LineString",
            Self::MultiLineString => "MultiLineString",
            Self::Polygon => "Polygon",
            Self::MultiPolygon => "MultiPolygon",
        }
    }
}

impl Geometry {
    /// One area or several, as it comes.
    #[must_use]
    pub fn area(mut polygons: Vec<Vec<Ring>>) -> Self {
        match polygons.len() {
            0 => Self::Polygon(Vec::new()),
            1 => Self::Polygon(polygons.remove(0)),
            _ => Self::MultiPolygon(polygons),
        }
    }

    /// Its type.
    #[must_use]
    pub const fn geometry_type(&self) -> GeometryType {
        match self {
            Self::Point(_) => GeometryType::Point,
            Self::LineString(_) => GeometryType::LineString,
            Self::MultiLineString(_) => GeometryType::MultiLineString,
            Self::Polygon(_) => GeometryType::Polygon,
            Self::MultiPolygon(_) => GeometryType::MultiPolygon,
        }
    }

    /// Every position of the shape.
    pub fn points(&self) -> impl Iterator<Item = &Point> {
        let paths: Vec<&[Point]> = match self {
            Self::Point(point) => vec![std::slice::from_ref(point)],
            Self::LineString(path) => vec![path],
            Self::MultiLineString(paths) | Self::Polygon(paths) => paths.iter().map(Vec::as_slice).collect(),
            Self::MultiPolygon(polygons) => polygons.iter().flatten().map(Vec::as_slice).collect(),
        };
        paths.into_iter().flatten()
    }

    /// Distance from a point, metres; 0 inside an area. Infinite for a shape without positions. O(positions).
    #[must_use]
    pub fn distance(&self, point: Point) -> f64 {
        let nearest = |distances: &mut dyn Iterator<Item = f64>| distances.fold(f64::INFINITY, f64::min);
        let path = |points: &[Point]| {
            let sides = points.windows(2).map(|pair| segment::distance(point, [pair[0], pair[1]]));
            nearest(&mut sides.chain(points.first().filter(|_| points.len() == 1).map(|only| (point - only).norm())))
        };
        let area = |rings: &[Ring]| {
            let sides = || polygon::sides(rings).map(|side| segment::distance(point, side));
            if polygon::contains(rings, point) { 0.0 } else { nearest(&mut sides()) }
        };
        match self {
            Self::Point(position) => (point - position).norm(),
            Self::LineString(points) => path(points),
            Self::MultiLineString(paths) => nearest(&mut paths.iter().map(|points| path(points))),
            Self::Polygon(rings) => area(rings),
            Self::MultiPolygon(polygons) => nearest(&mut polygons.iter().map(|rings| area(rings))),
        }
    }

    /// The box around it.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        Bounds::around(self.points())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(positions: &[[f64; 2]]) -> Vec<Point> {
        positions.iter().map(|&position| Point::from(position)).collect()
    }

    #[test]
    fn distances_are_to_the_nearest_part_of_a_shape() {
        let square = |x: f64| points(&[[x, 0.0], [x + 4.0, 0.0], [x + 4.0, 4.0], [x, 4.0]]);
        let hole = points(&[[1.0, 1.0], [1.0, 3.0], [3.0, 3.0], [3.0, 1.0]]);
        let ring = Geometry::Polygon(vec![square(0.0), hole]);
        let path = Geometry::LineString(points(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0]]));
        let cases = [
            (Geometry::Point(Point::new(3.0, 4.0)), [0.0, 0.0], 5.0),
            (path, [2.0, 1.0], 1.0),
            (Geometry::LineString(points(&[[1.0, 1.0]])), [1.0, 3.0], 2.0),
            (ring.clone(), [0.5, 0.5], 0.0),
            (ring.clone(), [2.0, 2.5], 0.5),
            (ring, [7.0, 8.0], 5.0),
            (Geometry::MultiPolygon(vec![vec![square(0.0)], vec![square(10.0)]]), [9.0, 2.0], 1.0),
            (Geometry::MultiLineString(vec![points(&[[0.0, 0.0], [1.0, 0.0]])]), [3.0, 0.0], 2.0),
            (Geometry::Polygon(Vec::new()), [0.0, 0.0], f64::INFINITY),
        ];
        for (shape, from, distance) in cases {
            assert_eq!(shape.distance(Point::from(from)), distance, "{shape:?} from {from:?}");
        }
    }
}
