//! Whatever a client sends: an answer or a refusal, and the same one in both encodings.

use proptest::prelude::*;

use super::places::{QUERYABLES, places};
use super::{DEGREES, json_writer};
use crate::cql2::{Expression, Filter, read_json, read_text};

/// Evaluates an expression for every place, if it can be bound.
fn evaluate(expression: &Expression) -> Option<[bool; 3]> {
    let filter = Filter::new(expression, &QUERYABLES, DEGREES).ok()?;
    Some(places().each_ref().map(|place| filter.selects(place)))
}

/// The words of the language in any order.
fn words() -> impl Strategy<Value = String> {
    let word = prop::sample::select(vec![
        "label",
        "area",
        "groups",
        "geometry",
        "box",
        "\"area\"",
        "'co'",
        "'%o'",
        "1",
        "-2.5",
        "(",
        ")",
        "((",
        "))",
        ",",
        "=",
        "<>",
        "<",
        ">=",
        "+",
        "-",
        "*",
        "/",
        "%",
        "^",
        "div",
        "AND",
        "OR",
        "NOT",
        "IS NULL",
        "LIKE",
        "BETWEEN",
        "IN",
        "TRUE",
        "CASEI(",
        "ACCENTI(",
        "S_INTERSECTS(",
        "S_TOUCHES(",
        "T_DURING(",
        "A_CONTAINS(",
        "DATE('2026-01-31')",
        "TIMESTAMP('2026-01-31T00:00:00Z')",
        "INTERVAL('2026-01-31', '..')",
        "POINT(1 1)",
        "BBOX(0, 0, 4, 3)",
        "POLYGON((0 0, 4 0, 4 4, 0 0))",
        "LINESTRING(0 0, 9 9)",
        "f(",
        "'",
        "\"",
    ]);
    prop::collection::vec(word, 0..24).prop_map(|words| words.join(" "))
}

/// Filters that are right, of all kinds.
fn filters() -> impl Strategy<Value = String> {
    let number = prop_oneof![
        Just("area".to_owned()),
        (-50..50_i32).prop_map(|number| number.to_string()),
        Just("2 * (area - 1) ^ 2".to_owned()),
    ];
    let position = (0..12_i32, 0..6_i32).prop_map(|(x, y)| format!("{x} {y}"));
    let shape = prop_oneof![
        position.clone().prop_map(|position| format!("POINT({position})")),
        prop::collection::vec(position.clone(), 3)
            .prop_map(|corners| { format!("POLYGON(({0}, {1}, {2}, {0}))", corners[0], corners[1], corners[2]) }),
        prop::collection::vec(position, 2..5).prop_map(|positions| format!("LINESTRING({})", positions.join(", "))),
        (0..9_i32, 0..5_i32, 0..9_i32, 0..5_i32).prop_map(|(x, y, width, height)| format!(
            "BBOX({x}, {y}, {}, {})",
            x + width,
            y + height
        )),
    ];
    let relation = prop::sample::select(vec![
        "S_INTERSECTS",
        "S_DISJOINT",
        "S_EQUALS",
        "S_TOUCHES",
        "S_WITHIN",
        "S_OVERLAPS",
        "S_CROSSES",
        "S_CONTAINS",
    ]);
    let leaf = prop_oneof![
        (number.clone(), prop::sample::select(vec!["=", "<>", "<", ">", "<=", ">="]), number.clone())
            .prop_map(|(one, comparison, other)| format!("{one} {comparison} {other}")),
        (number.clone(), number.clone(), number).prop_map(|(one, low, high)| format!("{one} BETWEEN {low} AND {high}")),
        (relation, shape).prop_map(|(relation, shape)| format!("{relation}(geometry, {shape})")),
        Just("CASEI(label) LIKE CASEI('%O%')".to_owned()),
        Just("label IN ('co', 'post')".to_owned()),
        Just("area IS NULL".to_owned()),
        Just("A_OVERLAPS(groups, ('main'))".to_owned()),
    ];
    leaf.prop_recursive(4, 24, 4, |condition| {
        prop_oneof![
            prop::collection::vec(condition.clone(), 2..4).prop_map(|all| format!("({})", all.join(" AND "))),
            prop::collection::vec(condition.clone(), 2..4).prop_map(|all| format!("({})", all.join(" OR "))),
            condition.prop_map(|condition| format!("NOT ({condition})")),
        ]
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn any_text_is_read_or_refused(text in ".{0,80}") {
        if let Ok(expression) = read_text(&text) {
            evaluate(&expression);
        }
        prop_assert!(read_json(&text).is_err() || serde_json::from_str::<serde_json::Value>(&text).is_ok());
    }

    #[test]
    fn words_in_any_order_are_read_or_refused(text in words()) {
        if let Ok(expression) = read_text(&text) {
            let answer = evaluate(&expression);
            let again = read_json(&json_writer::write(&expression).to_string()).expect("what was read can be written");
            prop_assert_eq!(&again, &expression);
            prop_assert_eq!(evaluate(&again), answer);
        }
    }

    #[test]
    fn right_filters_answer_and_their_opposites_select_nothing_in_common(text in filters()) {
        let expression = read_text(&text).expect("is right");
        // A polygon of three positions may have no area.
        let Some(selected) = evaluate(&expression) else { return Ok(()) };
        let opposite = evaluate(&expression.clone().negated()).expect("can be bound as well");
        prop_assert!(selected.iter().zip(opposite).all(|(&one, other)| !(one && other)), "{}", text);
        let again = read_json(&json_writer::write(&expression).to_string()).expect("what was read can be written");
        prop_assert_eq!(evaluate(&again), Some(selected));
    }
}
