//! Wrong filters: what is wrong is said, where, and what would be right.

use expect_test::expect;

use super::DEGREES;
use super::places::QUERYABLES;
use crate::cql2::{Filter, read_json, read_text};

fn of_text(text: &str) -> String {
    let bound = read_text(text).and_then(|expression| Filter::new(&expression, &QUERYABLES, DEGREES));
    bound.expect_err(text).to_string()
}

fn of_json(json: &str) -> String {
    let bound = read_json(json).and_then(|expression| Filter::new(&expression, &QUERYABLES, DEGREES));
    bound.expect_err(json).to_string()
}

fn all(filters: &[&str], error: fn(&str) -> String) -> String {
    filters.iter().map(|filter| format!("{filter}\n    {}\n", error(filter))).collect()
}

#[test]
fn broken_texts_name_the_column() {
    let broken = [
        "",
        "label =",
        "label = 'co' AND",
        "label == 'co'",
        "label = 'co' label",
        "label = NULL",
        "(label = 'co'",
        "label NOT = 'co'",
        "label IN 'co'",
        "area BETWEEN 1, 2",
        "S_INTERSECTS(geometry)",
        "S_INTERSECTS(geometry, POINT(1, 2))",
        "S_INTERSECTS(geometry, POLYGON((0 0, 1 0, 1 1)))",
        "S_INTERSECTS(geometry, BBOX(1, 5, 2, 3))",
        "T_AFTER(label, DATE('31.1.2026'))",
        "label = 'a long text in which nothing is wrong but what comes after it' §",
    ];
    expect![[r#"

            is empty
        label =
            column 8: expected a property, a value or a condition, found the end
        label = 'co' AND
            column 17: expected a property, a value or a condition, found the end
        label == 'co'
            column 8: expected a property, a value or a condition, found =
        label = 'co' label
            column 14: expected an operator, AND, OR or the end, found label
        label = NULL
            column 9: NULL is asked for with IS NULL
        (label = 'co'
            column 14: expected an operator, a comma or ), found the end
        label NOT = 'co'
            column 11: expected LIKE, BETWEEN or IN, found =
        label IN 'co'
            column 10: expected (, found 'co'
        area BETWEEN 1, 2
            column 15: expected AND, found ,
        S_INTERSECTS(geometry)
            column 1: S_INTERSECTS takes 2 arguments
        S_INTERSECTS(geometry, POINT(1, 2))
            column 31: expected a number, found ,
        S_INTERSECTS(geometry, POLYGON((0 0, 1 0, 1 1)))
            column 24: a ring needs four positions at least, and ends where it begins
        S_INTERSECTS(geometry, BBOX(1, 5, 2, 3))
            column 24: the box is inverted: south lies above north
        T_AFTER(label, DATE('31.1.2026'))
            column 21: '31.1.2026' is not a day such as 2026-01-31
        label = 'a long text in which nothing is wrong but what comes after it' §
            column 73: '§' has no meaning here
    "#]]
    .assert_eq(&all(&broken, of_text));
}

#[test]
fn names_and_types_that_do_not_fit_are_told() {
    let misfits = [
        "lable = 'co'",
        "label = 5",
        "area LIKE '%'",
        "label AND TRUE",
        "area + label > 3",
        "box = 'x'",
        "geometry IS NULL OR geometry = 5",
        "S_INTERSECTS(label, POINT(1 2))",
        "A_CONTAINS(label, ('a'))",
        "T_AFTER(label, DATE('2026-01-31'))",
        "T_AFTER(INTERVAL('2026-02-01', '2026-01-31'), DATE('2026-01-31'))",
        "T_AFTER(INTERVAL(label, '..'), DATE('2026-01-31'))",
        "label LIKE label",
        "area BETWEEN 'a' AND 'b'",
        "nearby(geometry) = TRUE",
        "S_INTERSECTS(geometry, POLYGON((0 0, 1 1, 1 0, 0 1, 0 0)))",
    ];
    expect![[r#"
        lable = 'co'
            there is no property lable, and a text stands in single quotes; did you mean label, area or box?
        label = 5
            label (a text) cannot be compared with the number 5
        area LIKE '%'
            expected a text for LIKE, found area (a number)
        label AND TRUE
            expected a condition, found label (a text)
        area + label > 3
            expected a number, found label (a text)
        box = 'x'
            box (an object) cannot be compared
        geometry IS NULL OR geometry = 5
            geometry (a geometry) cannot be compared
        S_INTERSECTS(label, POINT(1 2))
            expected a geometry for S_INTERSECTS, found label (a text)
        A_CONTAINS(label, ('a'))
            expected an array for A_CONTAINS, found label (a text)
        T_AFTER(label, DATE('2026-01-31'))
            expected a date, time or interval for T_AFTER, found label (a text)
        T_AFTER(INTERVAL('2026-02-01', '2026-01-31'), DATE('2026-01-31'))
            an interval ends before it begins
        T_AFTER(INTERVAL(label, '..'), DATE('2026-01-31'))
            expected a date or time for INTERVAL, found label (a text)
        label LIKE label
            the pattern of LIKE must be a text in single quotes
        area BETWEEN 'a' AND 'b'
            expected a number for BETWEEN, found the text 'a'
        nearby(geometry) = TRUE
            there is no function nearby
        S_INTERSECTS(geometry, POLYGON((0 0, 1 1, 1 0, 0 1, 0 0)))
            the geometry is invalid: a ring crosses or touches itself or another one, or has no area
    "#]]
    .assert_eq(&all(&misfits, of_text));
}

#[test]
fn broken_json_names_the_member() {
    let broken = [
        "",
        r#"{"op": "=""#,
        "null",
        "{}",
        r#"{"op": 5}"#,
        r#"{"op": "=", "args": {"property": "label"}}"#,
        r#"{"op": "=", "args": [{"property": "label"}]}"#,
        r#"{"op": "and", "args": [true]}"#,
        r#"{"op": "=", "args": [{"property": "label"}, null]}"#,
        r#"{"op": "in", "args": [{"property": "label"}, "co"]}"#,
        r#"{"op": "=", "args": [{"property": 5}, 5]}"#,
        r#"{"op": "t_after", "args": [{"date": "31.1.2026"}, {"timestamp": "noon"}]}"#,
        r#"{"op": "t_after", "args": [{"interval": ["2026-01-31"]}, {"interval": ["a", "b"]}]}"#,
        r#"{"op": "s_within", "args": [{"property": "geometry"}, {"bbox": [1, 2, "3", 4]}]}"#,
        r#"{"op": "s_within", "args": [{"property": "geometry"}, {"type": "Circle"}]}"#,
        r#"{"op": "s_within", "args": [{"property": "geometry"}, {"type": "Point", "coordinates": [1]}]}"#,
        r#"{"op": "s_within", "args": [{"property": "geometry"}, {"type": "Polygon", "coordinates": [[[0, 0], ["x", 1]]]}]}"#,
    ];
    expect![[r#"

            is empty
        {"op": "="
            is not JSON from line 1, column 10 on
        null
            null is no value: the operator isNull tests for it
        {}
            must have op, property, date, timestamp, interval, type or bbox
        {"op": 5}
            /op: must be a text
        {"op": "=", "args": {"property": "label"}}
            /args: must be an array
        {"op": "=", "args": [{"property": "label"}]}
            /args: = takes 2
        {"op": "and", "args": [true]}
            /args: and takes 2 or more
        {"op": "=", "args": [{"property": "label"}, null]}
            /args/1: null is no value: the operator isNull tests for it
        {"op": "in", "args": [{"property": "label"}, "co"]}
            /args/1: must be an array of values
        {"op": "=", "args": [{"property": 5}, 5]}
            /args/0/property: must be a text
        {"op": "t_after", "args": [{"date": "31.1.2026"}, {"timestamp": "noon"}]}
            /args/0/date: is not a day such as 2026-01-31
        {"op": "t_after", "args": [{"interval": ["2026-01-31"]}, {"interval": ["a", "b"]}]}
            /args/0/interval: must be an array of a start and an end
        {"op": "s_within", "args": [{"property": "geometry"}, {"bbox": [1, 2, "3", 4]}]}
            /args/1/bbox: needs four or six numbers: west, south, [low,] east, north[, high]
        {"op": "s_within", "args": [{"property": "geometry"}, {"type": "Circle"}]}
            /args/1/type: "Circle" is none of Point, LineString, Polygon, MultiPoint, MultiLineString, MultiPolygon, GeometryCollection
        {"op": "s_within", "args": [{"property": "geometry"}, {"type": "Point", "coordinates": [1]}]}
            /args/1/coordinates: must be a position: an array of two numbers
        {"op": "s_within", "args": [{"property": "geometry"}, {"type": "Polygon", "coordinates": [[[0, 0], ["x", 1]]]}]}
            /args/1/coordinates/0/1: must be a position: an array of two numbers
    "#]].assert_eq(&all(&broken, of_json));
}
