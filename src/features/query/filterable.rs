//! What a filter reads of a feature: its properties, and its geometry after them.

use std::borrow::Cow;

use geo::{Coord, LineString, MultiLineString, MultiPolygon, Polygon, Rect};
use stillage_core::Point;

use crate::cql2::{FilterValue, Filterable, Located, Queryable, ValueType};
use crate::features::collection::Collection;
use crate::features::feature::Feature;
use crate::features::geometry::{Geometry, Ring};
use crate::features::property::Kind;
use crate::features::schema::CollectionSchema;
use crate::features::value::Value;

/// The name of the geometry in filters.
pub const GEOMETRY: &str = "geometry";

/// What filters on a collection may use: its properties in their order, then the geometry.
#[must_use]
pub fn queryables(collection: Collection) -> Vec<Queryable<'static>> {
    let properties = CollectionSchema::of(collection).properties.iter();
    let properties =
        properties.map(|property| Queryable { name: property.name, value_type: value_type(property.kind) });
    properties.chain([Queryable { name: GEOMETRY, value_type: ValueType::Geometry }]).collect()
}

const fn value_type(kind: Kind) -> ValueType {
    match kind {
        Kind::Boolean => ValueType::Boolean,
        Kind::Integer | Kind::Number => ValueType::Number,
        Kind::Text | Kind::Word(_) => ValueType::Text,
        Kind::Integers | Kind::Numbers | Kind::Texts | Kind::Words(_) | Kind::Position => ValueType::Array,
        Kind::Pose | Kind::Box => ValueType::Object,
    }
}

impl Filterable for Feature {
    fn value(&self, queryable: usize) -> FilterValue<'_> {
        if queryable == CollectionSchema::of(self.row.collection()).properties.len() {
            // A shape without positions is none.
            let has_positions = self.geometry.points().next().is_some();
            return if has_positions { FilterValue::Geometry(self) } else { FilterValue::Null };
        }
        let text = |text| FilterValue::Text(Cow::Borrowed(text));
        let numbers = |numbers: &[f64]| FilterValue::Array(numbers.iter().copied().map(FilterValue::Number).collect());
        match self.row.value(queryable) {
            Value::Null => FilterValue::Null,
            Value::Boolean(value) => FilterValue::Boolean(value),
            Value::Integer(number) => FilterValue::Number(number as f64),
            Value::Number(number) => FilterValue::Number(number),
            Value::Text(value) => text(value),
            Value::Integers(values) => {
                FilterValue::Array(values.iter().map(|&number| FilterValue::Number(f64::from(number))).collect())
            }
            Value::Numbers(values) => numbers(values),
            Value::Position(position) => numbers(&position),
            Value::Texts(values) => FilterValue::Array(values.iter().map(|value| text(value)).collect()),
            Value::Words(values) => FilterValue::Array(values.iter().map(|value| text(value)).collect()),
            Value::Pose(_) | Value::Box(_) => FilterValue::Object,
        }
    }
}

impl Located for Feature {
    fn bounds(&self) -> Rect {
        Rect::new(coordinate(&self.bounds.low), coordinate(&self.bounds.high))
    }

    fn shape(&self) -> Cow<'_, geo::Geometry> {
        Cow::Owned(match &self.geometry {
            Geometry::Point(point) => geo::Point(coordinate(point)).into(),
            Geometry::LineString(points) => path(points).into(),
            Geometry::MultiLineString(paths) => {
                MultiLineString(paths.iter().map(|points| path(points)).collect()).into()
            }
            Geometry::Polygon(rings) => area(rings).into(),
            Geometry::MultiPolygon(polygons) => MultiPolygon(polygons.iter().map(|rings| area(rings)).collect()).into(),
        })
    }
}

fn coordinate(point: &Point) -> Coord {
    Coord { x: point.x, y: point.y }
}

fn path(points: &[Point]) -> LineString {
    points.iter().map(coordinate).collect()
}

/// The rings are closed on the way.
fn area(rings: &[Ring]) -> Polygon {
    let mut rings = rings.iter().map(|ring| path(ring));
    let outer = rings.next().unwrap_or_else(|| LineString(Vec::new()));
    Polygon::new(outer, rings.collect())
}
