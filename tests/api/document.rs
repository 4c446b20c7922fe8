//! The OpenAPI document is true: every read in it answers as it says.

use serde_json::Value;

use crate::client::Api;

#[tokio::test]
async fn every_read_answers_as_documented() {
    let api = Api::new().await;
    let map = api.hall().await;
    let job = api.get("/v1/jobs").await.json()["jobs"][0]["jobID"].as_str().expect("an id").to_owned();
    let document = api.get("/openapi.json").await.json();
    for (template, item) in document["paths"].as_object().expect("paths") {
        let Some(operation) = item.get("get") else { continue };
        let path = template
            .replace("/v1/maps/{mapId}", &map)
            .replace("{collectionId}", "vertices")
            .replace("{featureId}", "0")
            .replace("{jobId}", &job)
            .replace("{ruleSetId}", "office")
            .replace("{problem}", "busy");
        let query = if path.ends_with("/routes") { "?from=face:1&to=face:1" } else { "" };
        let answer = api.get(&format!("{path}{query}")).await;
        let documented = operation["responses"].get(answer.status.as_str());
        let documented = documented.unwrap_or_else(|| panic!("{path}: {} is not documented", answer.status));
        assert!(answer.status.is_success() || path.ends_with("/routes"), "{path}: {}", answer.text());
        if let Some(content) = documented.get("content").and_then(Value::as_object) {
            assert!(content.contains_key(answer.header("content-type")), "{path}: {}", answer.header("content-type"));
        }
        for header in documented["headers"].as_object().into_iter().flatten().map(|(name, _)| name) {
            assert!(header == "Link" || !answer.header(header).is_empty(), "{path}: {header}");
        }
    }
}

/// Every `$ref` of a document.
fn references(value: &Value, found: &mut Vec<String>) {
    match value {
        Value::Object(members) => {
            found.extend(members.get("$ref").and_then(Value::as_str).map(str::to_owned));
            members.values().for_each(|member| references(member, found));
        }
        Value::Array(entries) => entries.iter().for_each(|entry| references(entry, found)),
        _ => {}
    }
}

#[tokio::test]
async fn the_document_needs_nothing_from_elsewhere() {
    let api = Api::new().await;
    let document = api.get("/openapi.json").await.json();
    let mut found = Vec::new();
    references(&document, &mut found);
    for reference in found {
        let pointer = reference.strip_prefix('#').unwrap_or_else(|| panic!("{reference} leads away"));
        assert!(document.pointer(pointer).is_some(), "{reference} leads nowhere");
    }
    assert_eq!(document["info"]["license"]["identifier"], "MIT OR Apache-2.0");
    let mut ids = std::collections::BTreeSet::new();
    for operation in
        document["paths"].as_object().into_iter().flatten().filter_map(|(_, item)| item.as_object()).flatten()
    {
        let id = operation.1["operationId"].as_str().expect("every operation has an id");
        assert!(ids.insert(id.to_owned()), "{id} is there twice");
        assert!(operation.1["tags"][0].is_string() && operation.1["summary"].is_string(), "{id}");
    }
}
