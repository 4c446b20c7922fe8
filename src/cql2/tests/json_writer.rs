//! Expressions as `cql2-json`, so that each text can be asked in both encodings.

use geo::{Coord, Geometry, LineString, Polygon};
use serde_json::{Value, json};

use crate::cql2::{Expression, Instant, IntervalEnd};

pub fn write(expression: &Expression) -> Value {
    let all = |expressions: &[Expression]| expressions.iter().map(write).collect::<Vec<_>>();
    match expression {
        Expression::Boolean(value) => json!(value),
        Expression::Number(number) => json!(number),
        Expression::Text(text) => json!(text),
        Expression::Instant(Instant::Date(date)) => json!({"date": date.to_string()}),
        Expression::Instant(Instant::Timestamp(timestamp)) => json!({"timestamp": timestamp.to_string()}),
        Expression::Interval(ends) => json!({"interval": ends.each_ref().map(interval_end)}),
        Expression::Geometry(shape) => geometry(shape),
        Expression::Bbox(bbox) => json!({"bbox": bbox}),
        Expression::Property(name) => json!({"property": name}),
        Expression::Array(values) => json!(all(values)),
        Expression::Call { operator, arguments } => json!({"op": operator.name(), "args": all(arguments)}),
        Expression::Function { name, arguments } => json!({"op": name, "args": all(arguments)}),
    }
}

fn interval_end(end: &IntervalEnd) -> Value {
    match end {
        IntervalEnd::Open => json!(".."),
        IntervalEnd::Instant(Instant::Date(date)) => json!(date.to_string()),
        IntervalEnd::Instant(Instant::Timestamp(timestamp)) => json!(timestamp.to_string()),
        IntervalEnd::Property(name) => json!({"property": name}),
    }
}

fn geometry(shape: &Geometry) -> Value {
    let position = |position: &Coord| json!([position.x, position.y]);
    let path = |path: &LineString| path.0.iter().map(position).collect::<Vec<_>>();
    let rings = |polygon: &Polygon| {
        std::iter::once(polygon.exterior()).chain(polygon.interiors()).map(path).collect::<Vec<_>>()
    };
    match shape {
        Geometry::Point(point) => json!({"type": "Point", "coordinates": position(&point.0)}),
        Geometry::LineString(line) => json!({"type": "LineString", "coordinates": path(line)}),
        Geometry::Polygon(polygon) => json!({"type": "Polygon", "coordinates": rings(polygon)}),
        Geometry::MultiPoint(points) => {
            let positions: Vec<Value> = points.iter().map(|point| position(&point.0)).collect();
            json!({"type": "MultiPoint", "coordinates": positions})
        }
        Geometry::MultiLineString(lines) => {
            json!({"type": "MultiLineString", "coordinates": lines.iter().map(path).collect::<Vec<_>>()})
        }
        Geometry::MultiPolygon(polygons) => {
            json!({"type": "MultiPolygon", "coordinates": polygons.iter().map(rings).collect::<Vec<_>>()})
        }
        Geometry::GeometryCollection(members) => {
            json!({"type": "GeometryCollection", "geometries": members.iter().map(geometry).collect::<Vec<_>>()})
        }
        other => unreachable!("no encoding has {other:?}"),
    }
}
