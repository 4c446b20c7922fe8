//! Filters in CQL2, asked of two things.

use std::borrow::Cow;

use geo::{BoundingRect as _, Geometry, Point, Rect};
use stillage::cql2::{
    Expression, Filter, FilterCoordinates, FilterError, FilterValue, Filterable, Located, Queryable, ValueType,
    read_json, read_text,
};

use super::check_refusal;

const QUERYABLES: [Queryable<'static>; 4] = [
    Queryable { name: "label", value_type: ValueType::Text },
    Queryable { name: "area", value_type: ValueType::Number },
    Queryable { name: "groups", value_type: ValueType::Array },
    Queryable { name: "geometry", value_type: ValueType::Geometry },
];
const DEGREES: FilterCoordinates<'static> = FilterCoordinates { are_degrees: true, to_data: &|position| position };

/// A room, or a post.
struct Place {
    area: Option<f64>,
    outline: Outline,
}

#[derive(Debug)]
struct Outline(Geometry);

impl Located for Outline {
    fn bounds(&self) -> Rect {
        self.0.bounding_rect().expect("no outline is empty")
    }

    fn shape(&self) -> Cow<'_, Geometry> {
        Cow::Borrowed(&self.0)
    }
}

impl Filterable for Place {
    fn value(&self, queryable: usize) -> FilterValue<'_> {
        let text = |text: &'static str| FilterValue::Text(Cow::Borrowed(text));
        match queryable {
            0 => text("Büro"),
            1 => self.area.map_or(FilterValue::Null, FilterValue::Number),
            2 => FilterValue::Array(vec![text("main"), text("wide")]),
            _ => FilterValue::Geometry(&self.outline),
        }
    }
}

/// A filter as text.
pub fn filter_text(bytes: &[u8]) {
    if let Ok(text) = std::str::from_utf8(bytes) {
        select(read_text(text));
    }
}

/// A filter as JSON.
pub fn filter_json(bytes: &[u8]) {
    if let Ok(text) = std::str::from_utf8(bytes) {
        select(read_json(text));
    }
}

/// What is selected by a condition is not selected by its opposite.
fn select(expression: Result<Expression, FilterError>) {
    let bound = expression.and_then(|expression| {
        let filter = Filter::new(&expression, &QUERYABLES, DEGREES)?;
        Ok((filter, Filter::new(&expression.negated(), &QUERYABLES, DEGREES)?))
    });
    let places = [
        Place { area: Some(12.0), outline: Outline(Rect::new((0.0, 2.0), (4.0, 5.0)).to_polygon().into()) },
        Place { area: None, outline: Outline(Point::new(7.0, 1.0).into()) },
    ];
    match bound {
        Ok((filter, opposite)) => {
            for place in &places {
                assert!(!(filter.selects(place) && opposite.selects(place)));
            }
        }
        Err(error) => check_refusal(&error),
    }
}
