//! Shapes -> well-known text (OGC 06-103r4, section 7), for tables.

use stillage_core::Point;

use super::geojson::decimals;
use super::json;
use crate::coordinates::Transform;
use crate::features::Geometry;

/// A shape as text.
#[must_use]
pub fn geometry(geometry: &Geometry, transform: &Transform) -> String {
    let mut out = geometry.geometry_type().name().to_uppercase();
    if geometry.points().next().is_none() {
        return out + " EMPTY";
    }
    let ring = |ring: &Vec<Point>| positions(ring.iter().chain(ring.first()), transform);
    let area = |rings: &Vec<Vec<Point>>| list(rings, ring);
    out += &match geometry {
        Geometry::Point(point) => positions(std::iter::once(point), transform),
        Geometry::LineString(path) => positions(path, transform),
        Geometry::MultiLineString(paths) => list(paths, |path| positions(path, transform)),
        Geometry::Polygon(rings) => area(rings),
        Geometry::MultiPolygon(polygons) => list(polygons, area),
    };
    out
}

fn list<T>(items: &[T], text: impl Fn(&T) -> String) -> String {
    format!("({})", items.iter().map(text).collect::<Vec<_>>().join(","))
}

fn positions<'a>(points: impl IntoIterator<Item = &'a Point>, transform: &Transform) -> String {
    let position = |&point: &Point| {
        let [x, y] = transform.forward(point).map(|number| {
            let mut digits = Vec::new();
            json::decimal(number, decimals(transform.crs()), &mut digits);
            String::from_utf8(digits).expect("digits are ASCII")
        });
        format!("{x} {y}")
    };
    format!("({})", points.into_iter().map(position).collect::<Vec<_>>().join(","))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shapes_are_text() {
        let text = |shape: &Geometry| geometry(shape, &Transform::map_frame());
        let corners = || [(0.0, 0.0), (2.5, 0.0), (0.0, 1.0)].map(|(x, y)| Point::new(x, y)).to_vec();
        assert_eq!(text(&Geometry::Point(Point::new(1.0, -2.5))), "POINT(1 -2.5)");
        assert_eq!(text(&Geometry::LineString(corners())), "LINESTRING(0 0,2.5 0,0 1)");
        assert_eq!(text(&Geometry::MultiLineString(vec![corners()])), "MULTILINESTRING((0 0,2.5 0,0 1))");
        assert_eq!(text(&Geometry::Polygon(vec![corners()])), "POLYGON((0 0,2.5 0,0 1,0 0))");
        assert_eq!(text(&Geometry::MultiPolygon(vec![vec![corners()]])), "MULTIPOLYGON(((0 0,2.5 0,0 1,0 0)))");
        assert_eq!(text(&Geometry::Polygon(Vec::new())), "POLYGON EMPTY");
    }
}
