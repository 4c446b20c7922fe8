//! An OpenAPI 3.1 document -> the same in OpenAPI 3.0.3, the version that GIS read and generators know best.
//!
//! Source: OpenAPI Specification 3.0.3, "Schema Object", against JSON Schema 2020-12. A pure function of the document; what
//! 3.0 cannot say (`propertyNames`, for example) is left out.

use serde_json::{Map, Value, json};

/// Members whose values are data, not parts of the document.
const DATA: [&str; 5] = ["example", "examples", "default", "enum", "required"];
/// Members whose own members have names of the author's choice.
const NAMED: [&str; 7] = ["paths", "responses", "content", "headers", "schemas", "properties", "securitySchemes"];
/// Keywords of JSON Schema that 3.0 does not know.
const UNKNOWN: [&str; 12] = [
    "$schema",
    "$id",
    "$comment",
    "$defs",
    "contentEncoding",
    "contentMediaType",
    "dependentRequired",
    "dependentSchemas",
    "patternProperties",
    "propertyNames",
    "unevaluatedItems",
    "unevaluatedProperties",
];

/// The document in OpenAPI 3.0.3.
#[must_use]
pub fn down_convert(document: &Value) -> Value {
    let mut document = document.clone();
    document["openapi"] = json!("3.0.3");
    if let Some(license) = document.pointer_mut("/info/license").and_then(Value::as_object_mut) {
        license.remove("identifier");
    }
    let items = document.get_mut("paths").and_then(Value::as_object_mut).into_iter().flat_map(Map::values_mut);
    for operation in items.filter_map(Value::as_object_mut).flat_map(Map::values_mut) {
        forget_scopes(operation);
    }
    convert(&mut document);
    document
}

/// Only the schemes of OAuth have scopes in 3.0.
fn forget_scopes(operation: &mut Value) {
    let requirements = operation.get_mut("security").and_then(Value::as_array_mut);
    for scopes in requirements.into_iter().flatten().filter_map(Value::as_object_mut).flat_map(Map::values_mut) {
        *scopes = json!([]);
    }
}

fn convert(value: &mut Value) {
    match value {
        Value::Array(entries) => entries.iter_mut().for_each(convert),
        Value::Object(members) => {
            convert_schema(members);
            for (name, member) in members.iter_mut() {
                match member {
                    _ if DATA.contains(&name.as_str()) => {}
                    Value::Object(named) if NAMED.contains(&name.as_str()) => named.values_mut().for_each(convert),
                    other => convert(other),
                }
            }
        }
        _ => {}
    }
}

/// What an object of the document means in 3.0, where it is a schema. Others have none of these members.
fn convert_schema(schema: &mut Map<String, Value>) {
    convert_types(schema);
    for choice in ["oneOf", "anyOf"] {
        convert_choice(schema, choice);
    }
    if schema.len() > 1
        && let Some(reference) = schema.remove("$ref")
    {
        // Whatever stands beside a reference is not read.
        schema.insert("allOf".to_owned(), json!([{ "$ref": reference }]));
    }
    if let Some(value) = schema.remove("const") {
        schema.insert("enum".to_owned(), json!([value]));
    }
    if let Some(Value::Array(examples)) = schema.get_mut("examples") {
        let first = examples.drain(..).next();
        schema.remove("examples");
        schema.extend(first.map(|first| ("example".to_owned(), first)));
    }
    for (exclusive, inclusive) in [("exclusiveMinimum", "minimum"), ("exclusiveMaximum", "maximum")] {
        if let Some(limit @ Value::Number(_)) = schema.get(exclusive).cloned() {
            schema.insert(inclusive.to_owned(), limit);
            schema.insert(exclusive.to_owned(), json!(true));
        }
    }
    if let Some(entries) = schema.remove("prefixItems") {
        schema.insert("items".to_owned(), json!({ "anyOf": entries }));
    }
    if schema.get("type") == Some(&json!("array")) && !schema.contains_key("items") {
        schema.insert("items".to_owned(), json!({}));
    }
    if schema.contains_key("contentMediaType") && schema.get("type") == Some(&json!("string")) {
        schema.insert("format".to_owned(), json!("binary"));
    }
    for keyword in UNKNOWN {
        schema.remove(keyword);
    }
}

/// Several types: one of them is `null`, or they are alternatives.
fn convert_types(schema: &mut Map<String, Value>) {
    let Some(Value::Array(types)) = schema.get("type") else { return };
    let (null, others): (Vec<Value>, Vec<Value>) = types.iter().cloned().partition(|one| one == "null");
    schema.remove("type");
    match others.as_slice() {
        [] => {}
        [one] => drop(schema.insert("type".to_owned(), one.clone())),
        several => {
            let alternatives: Vec<Value> = several.iter().map(|one| json!({ "type": one })).collect();
            schema.insert("anyOf".to_owned(), Value::Array(alternatives));
        }
    }
    if !null.is_empty() {
        schema.insert("nullable".to_owned(), json!(true));
    }
}

/// A choice of which one is `null`.
fn convert_choice(schema: &mut Map<String, Value>, choice: &str) {
    let Some(Value::Array(alternatives)) = schema.get_mut(choice) else { return };
    let count = alternatives.len();
    alternatives.retain(|alternative| alternative.get("type") != Some(&json!("null")));
    if alternatives.len() == count {
        return;
    }
    if let [Value::Object(only)] = alternatives.as_mut_slice()
        && only.contains_key("$ref")
    {
        // Generators take a bare reference for the type that it names, and one with words beside it for a type of its own.
        let words: Vec<(String, Value)> = only
            .iter()
            .filter(|(name, _)| *name != "$ref")
            .map(|(name, value)| (name.clone(), value.clone()))
            .collect();
        only.retain(|name, _| name == "$ref");
        schema.extend(words);
    }
    schema.insert("nullable".to_owned(), json!(true));
}

#[cfg(test)]
mod tests {
    use super::*;

    fn schema(schema: &Value) -> Value {
        let document = json!({"openapi": "3.1.0", "components": {"schemas": {"S": schema}}});
        down_convert(&document)["components"]["schemas"]["S"].clone()
    }

    #[test]
    fn what_3_1_says_is_said_in_the_words_of_3_0() {
        let cases = [
            (json!({"type": ["string", "null"]}), json!({"type": "string", "nullable": true})),
            (json!({"type": ["string", "integer"]}), json!({"anyOf": [{"type": "string"}, {"type": "integer"}]})),
            (
                json!({"oneOf": [{"type": "null"}, {"$ref": "#/x", "description": "d"}]}),
                json!({"description": "d", "oneOf": [{"$ref": "#/x"}], "nullable": true}),
            ),
            (json!({"$ref": "#/x"}), json!({"$ref": "#/x"})),
            (json!({"const": 7}), json!({"enum": [7]})),
            (json!({"type": "string", "examples": ["a", "b"]}), json!({"type": "string", "example": "a"})),
            (json!({"exclusiveMinimum": 0}), json!({"minimum": 0, "exclusiveMinimum": true})),
            (
                json!({"type": "array", "prefixItems": [{"type": "number"}]}),
                json!({"type": "array", "items": {"anyOf": [{"type": "number"}]}}),
            ),
            (json!({"type": "array"}), json!({"type": "array", "items": {}})),
            (
                json!({"type": "string", "contentMediaType": "application/octet-stream"}),
                json!({"type": "string", "format": "binary"}),
            ),
            (json!({"type": "object", "propertyNames": {"type": "string"}}), json!({"type": "object"})),
        ];
        for (newer, older) in cases {
            assert_eq!(schema(&newer), older, "{newer}");
        }
    }

    #[test]
    fn names_and_examples_are_left_as_they_are() {
        let with_names = json!({"type": "object", "example": {"type": ["a", "null"]},
            "properties": {"const": {"type": "string"}, "default": {"type": ["integer", "null"]}}});
        let expected = json!({"type": "object", "example": {"type": ["a", "null"]},
            "properties": {"const": {"type": "string"}, "default": {"type": "integer", "nullable": true}}});
        assert_eq!(schema(&with_names), expected);
    }

    #[test]
    fn the_licence_has_no_identifier() {
        let document = json!({"openapi": "3.1.0", "info": {"license": {"name": "MIT", "identifier": "MIT"}}});
        assert_eq!(down_convert(&document), json!({"openapi": "3.0.3", "info": {"license": {"name": "MIT"}}}));
    }
}
