//! What is wrong in a body is told by its pointer, in words for people.

use std::collections::BTreeSet;

use serde_json::{Map, Value, json};

use crate::client::Answer;
use crate::document::{Sent, Site, operations, valid};

/// How deep members are looked for in the schemas of bodies.
const DEPTH: usize = 4;
/// Words of the program's language and libraries, which nobody who sends a body knows.
const FOREIGN: [&str; 24] = [
    "invalid type",
    "invalid value",
    "missing field",
    "unknown field",
    "unknown variant",
    "duplicate field",
    "untagged",
    "struct ",
    "enum ",
    "variant",
    "tuple",
    "sequence",
    "serde",
    "Option",
    "Some(",
    "None",
    " at line ",
    "f64",
    "u8",
    "u16",
    "u32",
    "u64",
    "i64",
    "usize",
];

/// Values of every type that JSON has.
fn values() -> [Value; 8] {
    [
        Value::Null,
        json!(true),
        json!(-7.5),
        json!(1e300),
        json!("wrong"),
        json!([]),
        json!(["wrong"]),
        json!({"stranger": 1}),
    ]
}

/// Every place in a value, by its pointer.
fn places(value: &Value, pointer: &str, found: &mut BTreeSet<String>) {
    found.insert(pointer.to_owned());
    match value {
        Value::Object(members) => {
            members.iter().for_each(|(name, member)| places(member, &format!("{pointer}/{name}"), found));
        }
        Value::Array(entries) => {
            entries.iter().enumerate().for_each(|(index, entry)| places(entry, &format!("{pointer}/{index}"), found));
        }
        _ => {}
    }
}

/// Every member that a schema has, by its pointer.
fn members(document: &Value, schema: &Value, pointer: &str, found: &mut BTreeSet<String>) {
    let schema = match schema["$ref"].as_str() {
        Some(reference) => document.pointer(reference.trim_start_matches('#')).expect("leads somewhere"),
        None => schema,
    };
    for kind in ["allOf", "oneOf", "anyOf"] {
        schema[kind].as_array().into_iter().flatten().for_each(|part| members(document, part, pointer, found));
    }
    for (name, member) in schema["properties"].as_object().into_iter().flatten() {
        let inner = format!("{pointer}/{name}");
        if inner.matches('/').count() <= DEPTH {
            members(document, member, &inner, found);
        }
        found.insert(inner);
    }
}

/// A body with another value at a place; members on the way are made where they are missing.
fn spoilt(body: &Value, pointer: &str, value: &Value) -> Value {
    let mut body = body.clone();
    let mut at = &mut body;
    for step in pointer.split('/').skip(1) {
        at = match (at, step.parse::<usize>()) {
            (Value::Array(entries), Ok(index)) => &mut entries[index],
            (other, _) => {
                if !other.is_object() {
                    *other = Value::Object(Map::new());
                }
                other.as_object_mut().expect("is an object").entry(step).or_insert(Value::Null)
            }
        };
    }
    *at = value.clone();
    body
}

/// A refusal names a place at, above or below the one that was spoilt, and uses no foreign words.
fn check(operation: &str, pointer: &str, value: &Value, answer: &Answer) {
    let told = || format!("{operation} {pointer} = {value}: {} {}", answer.status, answer.text());
    assert!(answer.status.is_client_error(), "{}", told());
    let problem = answer.json();
    let items = problem["errors"].as_array().unwrap_or_else(|| panic!("no pointer: {}", told()));
    for item in items {
        let named = item["pointer"].as_str().unwrap_or_else(|| panic!("no pointer: {}", told()));
        assert!(named.starts_with(pointer) || pointer.starts_with(named), "elsewhere: {}", told());
        let detail = item["detail"].as_str().expect("a text");
        let foreign = FOREIGN.iter().find(|word| detail.contains(**word));
        assert!(foreign.is_none() && !detail.is_empty(), "{foreign:?}: {}", told());
    }
}

#[tokio::test]
async fn every_wrong_value_is_told_by_its_pointer_in_plain_words() {
    let site = Site::new().await;
    let document = site.api.get("/openapi.json").await.json();
    let mut refused = 0;
    for (id, operation) in operations(&document) {
        let content = operation["requestBody"]["content"].as_object();
        let schema = content.into_iter().flatten().find(|(media_type, _)| media_type.ends_with("json"));
        let Some((_, content)) = schema else { continue };
        let (good, _) = valid(&site, &id).await;
        let body: Value = serde_json::from_slice(&good.body).expect("is JSON");
        let mut pointers = BTreeSet::new();
        places(&body, "", &mut pointers);
        members(&document, &content["schema"], "", &mut pointers);
        for pointer in &pointers {
            for value in values() {
                // What fits after all may take long: jobs are not waited for.
                let wrong = Sent { body: spoilt(&body, pointer, &value).to_string().into_bytes(), ..good.clone() };
                let answer = wrong.with("prefer", "respond-async").to(&site.api).await;
                if !answer.status.is_success() && answer.status != 503 {
                    check(&id, pointer, &value, &answer);
                    refused += 1;
                }
            }
        }
    }
    assert!(refused > 1_000, "{refused} were refused");
}
