//! What readers of JSON and of queries say of wrong values, in words for people who do not know the program.
//!
//! serde and `serde_json` have their messages as texts only. Each form of them is one of the rules here; a message that is
//! none of them is one of our own and stays as it is.

use std::borrow::Cow;

/// What values are called: the beginning of serde's word, and ours.
const FOUND: [(&str, &str); 10] = [
    ("string ", "the text "),
    ("character ", "the text "),
    ("integer ", "the number "),
    ("floating point ", "the number "),
    ("boolean ", ""),
    ("null", "null"),
    ("unit", "null"),
    ("map", "an object"),
    ("sequence", "an array"),
    ("Option", "null"),
];
/// What can be wished: the beginning of serde's words, and ours.
const EXPECTED: [(&str, &str); 18] = [
    ("u8", "a whole number from 0 to 255"),
    ("u16", "a whole number from 0 to 65535"),
    ("u32", "a whole number from 0 to 4294967295"),
    ("u64", "a whole number from 0"),
    ("usize", "a whole number from 0"),
    ("i8", "a whole number"),
    ("i16", "a whole number"),
    ("i32", "a whole number"),
    ("i64", "a whole number"),
    ("f32", "a number"),
    ("f64", "a number"),
    ("a string", "a text"),
    ("a boolean", "true or false"),
    ("a sequence", "an array"),
    ("a map", "an object"),
    ("struct ", "an object"),
    ("internally tagged enum ", "an object"),
    ("any value", "a value"),
];
/// Whole messages, and what they mean.
const WHOLE: [(&str, &str); 6] = [
    ("invalid digit found in string", "must be a whole number"),
    ("cannot parse integer from empty string", "must be a whole number"),
    ("number too large to fit in target type", "is too large"),
    ("invalid float literal", "must be a number"),
    ("cannot parse float from empty string", "must be a number"),
    ("provided string was not `true` or `false`", "must be true or false"),
];

/// A message in plain words.
#[must_use]
pub fn plain(message: &str) -> String {
    let (text, place) = without_place(message);
    let whole = WHOLE.iter().find(|(serde, _)| *serde == text).map(|(_, plain)| (*plain).to_owned());
    whole.or_else(|| misfit(text)).or_else(|| member(text)).unwrap_or_else(|| match place {
        Some(place) => format!("is no JSON: {} ({place})", syntax(text)),
        None => text.to_owned(),
    })
}

/// A message of `serde_json` without its place, `line 1, column 24`.
fn without_place(message: &str) -> (&str, Option<String>) {
    let split = || {
        let (text, place) = message.rsplit_once(" at line ")?;
        let (line, column) = place.split_once(" column ")?;
        let is_number = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
        (is_number(line) && is_number(column)).then(|| (text, format!("line {line}, column {column}")))
    };
    split().map_or((message, None), |(text, place)| (text, Some(place)))
}

/// A value that is none of those that are wished.
fn misfit(text: &str) -> Option<String> {
    if let Some(rest) = text.strip_prefix("invalid length ") {
        let (count, wished) = rest.split_once(", expected ")?;
        return Some(format!("must be {}, and has {count} entries", expected(wished)));
    }
    if text.starts_with("data did not match any variant of untagged enum") {
        return Some("is none of the values that it may be".to_owned());
    }
    let rest = text.strip_prefix("invalid type: ").or_else(|| text.strip_prefix("invalid value: "))?;
    // What was found may hold anything, the words between them too.
    let (value, wished) = rest.rsplit_once(", expected ")?;
    Some(format!("must be {}, and is {}", expected(wished), found(value)))
}

/// A member that is missing, unknown or there twice, or a word that is none of those that it may be.
fn member(text: &str) -> Option<String> {
    let (before, after, name) = [
        ("missing field `", "needs the member ", ""),
        ("duplicate field `", "has a member twice: ", ""),
        ("unknown field `", "", " is not known here"),
        ("unknown variant `", "may not be ", ""),
    ]
    .into_iter()
    .find_map(|(serde, before, after)| Some((before, after, text.strip_prefix(serde)?)))?;
    // The list of what is known comes last: the name may hold anything.
    let (name, known) = match name.rsplit_once("`, expected ") {
        Some((name, known)) => (name, format!(": it is {}", or(&known.trim_start_matches("one of ").replace('`', "")))),
        None => (name.strip_suffix("`, there are no fields").or_else(|| name.strip_suffix('`'))?, String::new()),
    };
    Some(format!("{before}{name}{after}{known}"))
}

/// A list with an "or" before its last word.
fn or(list: &str) -> Cow<'_, str> {
    if list.contains(" or ") {
        return list.into();
    }
    list.rsplit_once(", ").map_or_else(|| list.into(), |(others, last)| format!("{others} or {last}").into())
}

fn found(value: &str) -> String {
    let known = FOUND.iter().find_map(|(serde, plain)| Some(format!("{plain}{}", value.strip_prefix(serde)?)));
    known.unwrap_or_else(|| "another value".to_owned()).replace('`', "")
}

fn expected(wished: &str) -> String {
    let count =
        |text: &str| text.split(' ').find(|word| word.bytes().all(|byte| byte.is_ascii_digit())).map(str::to_owned);
    if wished.starts_with("a tuple ") || wished.starts_with("tuple ") || wished.starts_with("an array of length ") {
        return count(wished).map_or_else(|| "an array".to_owned(), |count| format!("an array of {count} entries"));
    }
    if wished.contains("enum") || wished.contains("variant") || wished == "string or map" {
        return "one of the values that it may be".to_owned();
    }
    let is_word = |serde: &str| wished == serde || (serde.ends_with(' ') && wished.starts_with(serde));
    let known = EXPECTED.iter().find(|(serde, _)| is_word(serde)).map(|(_, plain)| (*plain).to_owned());
    known.unwrap_or_else(|| wished.replace('`', ""))
}

/// Why a text is no JSON.
fn syntax(text: &str) -> &'static str {
    match text {
        ended if ended.starts_with("EOF") => "it ends too early",
        "trailing characters" => "something follows after its end",
        "trailing comma" => "a comma stands before an end",
        "recursion limit exceeded" => "it is nested too deeply",
        "number out of range" => "a number is too large",
        "key must be a string" => "the name of a member must stand in double quotes",
        _ => "something else must stand there",
    }
}

#[cfg(test)]
mod tests {
    use serde::Deserialize;
    use serde::de::DeserializeOwned;

    use super::*;

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields, rename_all = "camelCase")]
    struct Place {
        #[serde(rename = "cell")]
        _cell: (u8, f64),
        #[serde(rename = "kind")]
        _kind: Option<Kind>,
    }

    #[derive(Debug, Deserialize)]
    #[serde(rename_all = "lowercase")]
    enum Kind {
        Rack,
        Floor,
    }

    fn refusal<T: DeserializeOwned + std::fmt::Debug>(json: &str) -> String {
        plain(&serde_json::from_str::<T>(json).expect_err("is refused").to_string())
    }

    #[test]
    fn misfits_are_told_in_plain_words() {
        for (json, told) in [
            ("7", "must be an object, and is the number 7"),
            ("{}", "needs the member cell"),
            (r#"{"cell": [1, 2.0], "cell": 1}"#, "has a member twice: cell"),
            (r#"{"cel": 1}"#, "cel is not known here: it is cell or kind"),
            (r#"{"cell": "a"}"#, "must be an array of 2 entries, and is the text \"a\""),
            (r#"{"cell": [1]}"#, "must be an array of 2 entries, and has 1 entries"),
            (r#"{"cell": [-1, 2]}"#, "must be a whole number from 0 to 255, and is the number -1"),
            (r#"{"cell": [1, null]}"#, "must be a number, and is null"),
            (r#"{"cell": [1, 2], "kind": "x`, expected `y"}"#, "may not be x`, expected `y: it is rack or floor"),
            (r#"{"cell": [1, 2], "kind": "shelf"}"#, "may not be shelf: it is rack or floor"),
            (r#"{"cell": [1, 2] 2}"#, "is no JSON: something else must stand there (line 1, column 17)"),
            (r#"{"cell": [1, 2]"#, "is no JSON: it ends too early (line 1, column 15)"),
            (r#"{"cell": [1, 2],}"#, "is no JSON: a comma stands before an end (line 1, column 17)"),
        ] {
            assert_eq!(refusal::<Place>(json), told, "{json}");
        }
        assert_eq!(refusal::<bool>("[]"), "must be true or false, and is an array");
        assert_eq!(refusal::<Vec<String>>("{}"), "must be an array, and is an object");
    }

    #[test]
    fn words_of_our_own_stay() {
        for own in ["must be a whole number from 1 (at most 1000 are answered)", "there is no rule set site-b"] {
            assert_eq!(plain(own), own);
        }
    }
}
