//! The OpenAPI document of one map: every map is the root of an OGC API of its own, and GIS clients look paths up relative
//! to that root.

use std::collections::BTreeSet;

use serde_json::{Map, Value, json};

/// The path of a map, under which its resources lie.
const MAP: &str = "/v1/maps/{mapId}";
/// Stands for the address of the map until it is known.
pub const SERVER: &str = "/v1/maps/00000000-0000-7000-8000-000000000000";

/// The part of the document that is about the features of a map, its paths relative to the map.
#[must_use]
pub fn of_map(document: &Value) -> Value {
    let mut paths = Map::new();
    for (path, item) in document["paths"].as_object().into_iter().flatten() {
        let Some(below) = path.strip_prefix(MAP) else { continue };
        let is_root = below.is_empty();
        let mut item = item.clone();
        if let Some(operations) = item.as_object_mut() {
            operations
                .retain(|method, operation| if is_root { method == "get" } else { operation["tags"][0] == "features" });
            operations.values_mut().for_each(forget_map);
            if !operations.is_empty() {
                paths.insert(if is_root { "/".to_owned() } else { below.to_owned() }, item);
            }
        }
    }
    let mut own = json!({
        "openapi": document["openapi"],
        "info": document["info"],
        "servers": [{"url": SERVER, "description": "This map"}],
        "paths": paths,
    });
    own["info"]["title"] = json!("A map of stillage");
    own["components"] = components(document, &own["paths"]);
    own
}

/// The map is the server: no operation asks for it.
fn forget_map(operation: &mut Value) {
    if let Some(parameters) = operation.get_mut("parameters").and_then(Value::as_array_mut) {
        parameters.retain(|parameter| parameter["name"] != "mapId");
    }
}

/// The components that some value refers to, directly or through others.
fn components(document: &Value, value: &Value) -> Value {
    let mut found = BTreeSet::new();
    let mut open = vec![value];
    while let Some(value) = open.pop() {
        let mut references = BTreeSet::new();
        collect_references(value, &mut references);
        for reference in references {
            if found.insert(reference) {
                open.extend(document.pointer(reference.trim_start_matches('#')));
            }
        }
    }
    let mut components = document["components"].clone();
    for (kind, named) in components.as_object_mut().into_iter().flatten() {
        // Schemes of security are referred to by their names alone.
        if let Some(named) = named.as_object_mut().filter(|_| kind != "securitySchemes") {
            named.retain(|name, _| found.contains(format!("#/components/{kind}/{name}").as_str()));
        }
    }
    components
}

fn collect_references<'a>(value: &'a Value, found: &mut BTreeSet<&'a str>) {
    match value {
        Value::Object(members) => {
            found.extend(members.get("$ref").and_then(Value::as_str));
            members.values().for_each(|member| collect_references(member, found));
        }
        Value::Array(entries) => entries.iter().for_each(|entry| collect_references(entry, found)),
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_map_is_the_root_of_its_document() {
        let features =
            json!({"tags": ["features"], "parameters": [{"name": "mapId"}, {"$ref": "#/components/parameters/limit"}]});
        let document = json!({"openapi": "3.0.3", "info": {"title": "stillage"}, "paths": {
                "/v1/maps": {"get": {"tags": ["maps"]}},
                "/v1/maps/{mapId}": {"get": {"tags": ["maps"]}, "delete": {"tags": ["maps"]}},
                "/v1/maps/{mapId}/collections": {"get": features},
                "/v1/maps/{mapId}/routes": {"get": {"tags": ["fleet"]}}},
            "components": {"parameters": {"limit": {"schema": {"$ref": "#/components/schemas/A"}}},
                "schemas": {"A": {"type": "integer"}, "B": {"type": "string"}}}});
        let own = of_map(&document);
        assert_eq!(
            own["paths"],
            json!({"/": {"get": {"tags": ["maps"]}},
            "/collections": {"get": {"tags": ["features"], "parameters": [{"$ref": "#/components/parameters/limit"}]}}})
        );
        assert_eq!(own["components"]["schemas"], json!({"A": {"type": "integer"}}));
        assert!(own["components"]["parameters"]["limit"].is_object());
    }
}
