//! The example expressions of the standard: text and JSON say the same.

use std::fs;

use super::standard;
use crate::cql2::{Expression, read_json, read_text};

#[test]
fn the_text_and_the_json_of_each_example_are_the_same_expression() {
    let Some(folder) = standard("examples") else { return };
    let (mut pairs, mut alternatives) = (0, 0);
    for entry in fs::read_dir(folder.join("text")).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_stem().unwrap().to_str().unwrap();
        let text = fs::read_to_string(&path).unwrap();
        let of_text = read_text(&text).unwrap_or_else(|error| panic!("{name}: {error}"));
        // `-alt01` is another spelling of the same example.
        let (example, _) = name.split_once('-').unwrap_or((name, ""));
        let json = fs::read_to_string(folder.join("json").join(example).with_extension("json")).unwrap();
        let of_json = read_json(&json).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(composed(of_text), composed(of_json), "{name}");
        if name == example { pairs += 1 } else { alternatives += 1 }
    }
    assert_eq!((pairs, alternatives), (109, 11));
}

/// Texts with each accent in one character with its letter: one example has it so in the text and not in the JSON.
fn composed(expression: Expression) -> Expression {
    use unicode_normalization::UnicodeNormalization as _;
    match expression {
        Expression::Text(text) => Expression::Text(text.nfc().collect()),
        Expression::Call { operator, arguments } => {
            Expression::call(operator, arguments.into_iter().map(composed).collect())
        }
        other => other,
    }
}
