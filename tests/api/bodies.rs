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

/// What is wrong with a refusal: it names a place in the member that was spoilt, or the whole body, and uses no foreign words.
fn fault(pointer: &str, answer: &Answer) -> Option<String> {
    if !answer.status.is_client_error() {
        return Some("no refusal".to_owned());
    }
    let problem = answer.json();
    let Some(items) = problem["errors"].as_array() else { return Some("no place".to_owned()) };
    items.iter().find_map(|item| {
        let Some(named) = item["pointer"].as_str() else { return Some("no pointer".to_owned()) };
        let member = |pointer: &str| pointer.split('/').nth(1).map(str::to_owned);
        if !named.is_empty() && !pointer.is_empty() && member(named) != member(pointer) {
            return Some("another place".to_owned());
        }
        let detail = item["detail"].as_str().expect("a text");
        let foreign = FOREIGN.iter().find(|word| detail.contains(**word));
        foreign.map(|word| format!("a foreign word, {word}")).or(detail.is_empty().then(|| "no detail".to_owned()))
    })
}

#[tokio::test]
async fn every_wrong_value_is_told_by_its_pointer_in_plain_words() {
    let site = Site::new().await;
    let document = site.api.get("/openapi.json").await.json();
    let (mut refused, mut faults) = (0, Vec::new());
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
                // What fits may still be refused for what is there already, or is being worked on.
                if !answer.status.is_success() && ![404, 409, 412, 503].contains(&answer.status.as_u16()) {
                    refused += 1;
                    let told = |fault| format!("{id} {pointer} = {value}: {fault}: {}", answer.text());
                    faults.extend(fault(pointer, &answer).map(told));
                }
            }
        }
    }
    assert!(faults.is_empty(), "{} of {refused}:\n{}", faults.len(), faults.join("\n"));
    assert!(refused > 1_000, "{refused} were refused");
}
