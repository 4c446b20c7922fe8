//! Filters on three small things.

use std::borrow::Cow;

use geo::{BoundingRect as _, Geometry, Rect};

use super::DEGREES;
use crate::cql2::{Expression, Filter, FilterValue, Filterable, Located, Queryable, ValueType, read_text};

/// What the tests select from.
#[derive(Debug)]
pub struct Place {
    label: &'static str,
    area: Option<f64>,
    groups: &'static [&'static str],
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

pub const QUERYABLES: [Queryable<'static>; 5] = [
    Queryable { name: "label", value_type: ValueType::Text },
    Queryable { name: "area", value_type: ValueType::Number },
    Queryable { name: "groups", value_type: ValueType::Array },
    Queryable { name: "box", value_type: ValueType::Object },
    Queryable { name: "geometry", value_type: ValueType::Geometry },
];

impl Filterable for Place {
    fn value(&self, queryable: usize) -> FilterValue<'_> {
        let text = |text: &'static str| FilterValue::Text(Cow::Borrowed(text));
        match queryable {
            0 => text(self.label),
            1 => self.area.map_or(FilterValue::Null, FilterValue::Number),
            2 => FilterValue::Array(self.groups.iter().copied().map(text).collect()),
            3 => FilterValue::Object,
            _ => FilterValue::Geometry(&self.outline),
        }
    }
}

/// A corridor and an office beside it, 10 m and 4 m long, and a post of unknown area.
pub fn places() -> [Place; 3] {
    let outline = |wkt: &str| match read_text(&format!("S_INTERSECTS(geometry, {wkt})")) {
        Ok(Expression::Call { mut arguments, .. }) => match arguments.pop() {
            Some(Expression::Geometry(geometry)) => Outline(geometry),
            other => panic!("{wkt} is {other:?}"),
        },
        other => panic!("{wkt} is {other:?}"),
    };
    let place = |label, area, groups, wkt| Place { label, area, groups, outline: outline(wkt) };
    [
        place("co", Some(20.0), &["main", "wide"], "POLYGON((0 0, 10 0, 10 2, 0 2, 0 0))"),
        place("Büro", Some(12.0), &[], "POLYGON((0 2, 4 2, 4 5, 0 5, 0 2))"),
        place("post", None, &["main"], "POINT(7 1)"),
    ]
}

/// The labels of what a filter selects.
fn selected(text: &str) -> Vec<&'static str> {
    let expression = read_text(text).unwrap_or_else(|error| panic!("{text}: {error}"));
    let filter = Filter::new(&expression, &QUERYABLES, DEGREES).unwrap_or_else(|error| panic!("{text}: {error}"));
    places().into_iter().filter(|place| filter.selects(place)).map(|place| place.label).collect()
}

#[test]
fn what_is_missing_is_neither_more_nor_less() {
    assert_eq!(selected("area > 15"), ["co"]);
    assert_eq!(selected("NOT area > 15"), ["Büro"]);
    assert_eq!(selected("area > 15 OR TRUE"), ["co", "Büro", "post"]);
    assert_eq!(selected("area > 15 AND FALSE"), [""; 0]);
    assert_eq!(selected("(area > 15) IS NULL"), ["post"]);
    assert_eq!(selected("area IS NOT NULL"), ["co", "Büro"]);
    assert_eq!(selected("area NOT IN (12, 13)"), ["co"]);
    assert_eq!(selected("area NOT BETWEEN 15 AND area"), ["Büro"]);
}

#[test]
fn arithmetic_follows_the_rules_of_school() {
    assert_eq!(selected("area = 2 + 3 * 6"), ["co"]);
    assert_eq!(selected("area = 2 ^ 2 * 3"), ["Büro"]);
    assert_eq!(selected("-area = -(10 + 2)"), ["Büro"]);
    assert_eq!(selected("area div 8 = 2 AND area % 8 = 4"), ["co"]);
    assert_eq!(selected("area / 0 = 1 OR NOT area / 0 = 1"), [""; 0], "no number is divided by 0");
}

#[test]
fn texts_are_compared_without_case_or_accents_on_request() {
    assert_eq!(selected("CASEI(ACCENTI(label)) = casei(accenti('BURO'))"), ["Büro"]);
    assert_eq!(selected("CASEI(label) LIKE CASEI('%O')"), ["co", "Büro"]);
    assert_eq!(selected("label NOT LIKE '_o%'"), ["Büro"]);
}

#[test]
fn shapes_touch_cross_and_contain() {
    assert_eq!(selected("S_TOUCHES(geometry, POLYGON((0 2, 4 2, 4 5, 0 5, 0 2)))"), ["co"]);
    assert_eq!(selected("S_EQUALS(geometry, POLYGON((4 2, 4 5, 0 5, 0 2, 4 2)))"), ["Büro"]);
    assert_eq!(selected("S_WITHIN(geometry, BBOX(0, 0, 10, 2))"), ["co", "post"]);
    assert_eq!(selected("S_CONTAINS(geometry, POINT(1 3))"), ["Büro"]);
    assert_eq!(selected("S_CROSSES(LINESTRING(-1 1, 5 1), geometry)"), ["co"]);
    assert_eq!(selected("S_DISJOINT(geometry, BBOX(6, 0, 8, 1.5))"), ["Büro"]);
    assert_eq!(selected("S_OVERLAPS(geometry, BBOX(3, 1, 5, 3))"), ["co", "Büro"]);
    assert_eq!(selected("S_INTERSECTS(geometry, BBOX(7, 1, 7, 1))"), ["co", "post"], "a box without area");
}

#[test]
fn arrays_are_compared_as_sets() {
    assert_eq!(selected("A_CONTAINS(groups, ('main'))"), ["co", "post"]);
    assert_eq!(selected("A_EQUALS(groups, ('wide', 'main', 'wide'))"), ["co"]);
    assert_eq!(selected("A_CONTAINEDBY(groups, ('main', 'x'))"), ["Büro", "post"]);
    assert_eq!(selected("A_OVERLAPS(groups, ('wide', 'x'))"), ["co"]);
    assert_eq!(selected("A_EQUALS(groups, ())"), ["Büro"]);
}

#[test]
fn days_and_moments_are_compared() {
    let holds = |text: &str| !selected(text).is_empty();
    assert!(holds("TIMESTAMP('2026-01-31T12:00:00Z') = DATE('2026-01-31')"), "a day is all its moments");
    assert!(holds("TIMESTAMP('2026-01-31T12:00:00Z') < DATE('2026-02-01')"));
    assert!(holds("T_MEETS(INTERVAL('2025-01-01', '2026-01-31'), INTERVAL('2026-01-31', '..'))"));
    assert!(holds("T_DURING(TIMESTAMP('2026-01-31T12:00:00Z'), DATE('2026-01-31'))"));
    assert!(!holds("T_BEFORE(DATE('2026-01-31'), INTERVAL('..', '2026-03-01'))"));
}
