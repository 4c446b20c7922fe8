//! What GIS clients look for in an OpenAPI 3.0 document.
//!
//! GDAL looks up the path of each collection by its letters, and takes the length of a page from a parameter whose reference
//! says `limit`. QGIS reads `#/components/parameters/limit`, and only parameters whose `style` and `explode` are written
//! out.

use serde_json::{Map, Value, json};

use crate::features::Collection;
use crate::http::ogc::filter::may_have_parameter;
use crate::http::ogc::item_writes::is_writable;
use crate::http::ogc::items_query::MAX_LIMIT;

/// Where a path names a collection.
const COLLECTION: &str = "{collectionId}";

/// The document with a path for each collection, and parameters as GIS clients read them.
#[must_use]
pub fn for_clients(mut document: Value) -> Value {
    if let Some(paths) = document["paths"].as_object_mut() {
        let literal = std::mem::take(paths).into_iter().flat_map(|(path, item)| literal_paths(&path, item));
        *paths = literal.collect();
    }
    let mut limit = None;
    for (path, item) in document["paths"].as_object_mut().into_iter().flatten() {
        for parameter in item.as_object_mut().into_iter().flat_map(Map::values_mut).flat_map(parameters) {
            if parameter["in"] == "query" && parameter.get("style").is_none() {
                parameter["style"] = json!("form");
                parameter["explode"] = json!(false);
            }
            if path.ends_with("/items") && parameter["name"] == "limit" {
                limit = Some(std::mem::replace(parameter, json!({"$ref": "#/components/parameters/limit"})));
            }
        }
    }
    if let Some(mut limit) = limit {
        limit["schema"]["maximum"] = json!(MAX_LIMIT);
        document["components"]["parameters"] = json!({ "limit": limit });
    }
    document
}

/// The parameters of an operation.
fn parameters(operation: &mut Value) -> &mut [Value] {
    operation.get_mut("parameters").and_then(Value::as_array_mut).map_or(&mut [], Vec::as_mut_slice)
}

/// A path as it is, or for each collection where it has a place for one.
fn literal_paths(path: &str, item: Value) -> Vec<(String, Value)> {
    if !path.contains(COLLECTION) {
        return vec![(path.to_owned(), item)];
    }
    let of_collection = |collection: Collection| {
        let mut item = item.clone();
        if let Some(operations) = item.as_object_mut() {
            if !is_writable(collection) {
                for method in ["patch", "post", "put"] {
                    operations.remove(method);
                }
            }
            operations.values_mut().for_each(|operation| say_collection(operation, collection));
        }
        (path.replace(COLLECTION, collection.id()), item)
    };
    Collection::ALL.map(of_collection).into()
}

/// Makes an operation that of one collection.
fn say_collection(operation: &mut Value, collection: Collection) {
    if let Some(parameters) = operation.get_mut("parameters").and_then(Value::as_array_mut) {
        parameters.retain(|parameter| {
            let name = parameter["name"].as_str().unwrap_or_default();
            name != "collectionId" && (parameter["in"] != "query" || may_have_parameter(collection, name))
        });
    }
    let id = collection.id();
    let (first, rest) = id.split_at(1);
    for (member, suffix) in
        [("operationId", format!("Of{}{rest}", first.to_uppercase())), ("summary", format!(": {id}"))]
    {
        if let Some(Value::String(text)) = operation.get_mut(member) {
            text.push_str(&suffix);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_collection_has_a_path_of_its_own() {
        let parameters =
            json!([{"name": "collectionId", "in": "path"}, {"name": "limit", "in": "query", "schema": {}}]);
        let get = json!({"operationId": "getFeatures", "summary": "Features", "parameters": parameters});
        let document =
            json!({"paths": {"/collections/{collectionId}/items": {"get": get, "patch": {}}}, "components": {}});
        let document = for_clients(document);
        let paths = document["paths"].as_object().expect("paths");
        assert_eq!(paths.len(), Collection::ALL.len());
        let faces = &paths["/collections/faces/items"];
        let edges = &paths["/collections/edges/items"];
        assert_eq!(faces["get"]["operationId"], "getFeaturesOfFaces");
        assert_eq!(faces["get"]["parameters"], json!([{"$ref": "#/components/parameters/limit"}]));
        assert!(edges.get("patch").is_none() && faces.get("patch").is_some());
        let limit = &document["components"]["parameters"]["limit"];
        assert_eq!(
            (&limit["schema"]["maximum"], &limit["style"], &limit["explode"]),
            (&json!(10_000), &json!("form"), &json!(false))
        );
    }
}
