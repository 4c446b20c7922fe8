//! The shapes of features, in map-frame metres.

use stillage_core::Point;
use stillage_core::geometry::Bounds;

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

    /// The box around it.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        Bounds::around(self.points())
    }
}
