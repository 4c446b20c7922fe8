//! What a request writes of a feature: single members, or a whole feature as a GIS sends it.

use serde::Deserialize;
use serde_json::{Map, Value};
use stillage_core::registry::Given;
use utoipa::ToSchema;

use crate::features::Collection;
use crate::http::extract::{parse_json, pointer_step, present};
use crate::http::problem::Problem;
use crate::views::name::{Code, Group, Groups, Name};

/// What people say of a feature, as a JSON merge patch (RFC 7396), by itself or in `properties`. Null takes away a name, the
/// groups, or the label that a face has of its own.
#[derive(Debug, Default, Deserialize, ToSchema)]
#[schema(as = FeaturePatch)]
#[serde(deny_unknown_fields)]
pub struct FeaturePatchBody {
    /// Id of its label; of faces only.
    #[serde(default, deserialize_with = "present")]
    #[schema(example = "ju")]
    #[allow(clippy::option_option, reason = "a merge patch tells absent from null")]
    pub label: Option<Option<String>>,
    /// Its name.
    #[serde(default, deserialize_with = "present")]
    #[schema(value_type = Option<Name>)]
    #[allow(clippy::option_option, reason = "a merge patch tells absent from null")]
    name: Option<Option<Name>>,
    /// Its code; of locations only.
    code: Option<Code>,
    /// Its groups.
    #[serde(default, deserialize_with = "present")]
    #[schema(value_type = Option<Vec<Group>>)]
    #[allow(clippy::option_option, reason = "a merge patch tells absent from null")]
    groups: Option<Option<Groups>>,
}

impl From<FeaturePatchBody> for Given {
    fn from(body: FeaturePatchBody) -> Self {
        Self {
            code: body.code.map(|code| code.0),
            name: body.name.map(|name| name.map(|name| name.0)),
            groups: body.groups.map(|groups| groups.map(|groups| groups.0).unwrap_or_default()),
        }
    }
}

/// A feature as a GIS sends it. What differs from the feature as it is must be writable.
#[derive(Debug, ToSchema)]
#[schema(as = FeatureWrite)]
#[allow(dead_code, reason = "it describes what is read member by member")]
pub struct FeatureWriteBody {
    /// `Feature`
    #[schema(example = "Feature")]
    r#type: Option<String>,
    /// Its shape follows from the map: that of the feature as it was read, or nothing.
    #[schema(value_type = Option<Object>)]
    geometry: Option<Value>,
    /// What is written, beside what was read.
    properties: FeaturePatchBody,
}

/// The properties of a collection that people may write.
pub const fn writable(collection: Collection) -> &'static [&'static str] {
    match collection {
        Collection::Faces => &["label"],
        Collection::Locations => &["code", "name", "groups"],
        Collection::Places | Collection::Aisles | Collection::Rows => &["name", "groups"],
        _ => &[],
    }
}

/// What a request writes.
#[derive(Debug)]
pub struct Written {
    /// The members that change.
    pub patch: FeaturePatchBody,
    /// Where they lie in the body, as a JSON pointer.
    pub pointer: &'static str,
}

/// Whether a body is a feature, or a part of one, rather than the members themselves.
pub fn is_feature(body: &Map<String, Value>) -> bool {
    ["properties", "geometry"].iter().any(|member| body.contains_key(*member))
        || body.get("type").is_some_and(|kind| kind == "Feature")
}

/// Reads the members themselves.
///
/// # Errors
/// 422 where one of them cannot be written, or not so.
pub fn members(collection: Collection, body: Map<String, Value>) -> Result<Written, Problem> {
    read(collection, "", body)
}

/// Reads a feature: what is as in `current`, the feature as it is read, changes nothing.
///
/// # Errors
/// 422 where something else than the writable properties differs, or one of them cannot be so.
pub fn feature(collection: Collection, mut body: Map<String, Value>, current: &Value) -> Result<Written, Problem> {
    if body.get("geometry").is_some_and(|sent| !sent.is_null() && *sent != current["geometry"]) {
        let detail = "the shape of a feature follows from the analysis of the map and cannot be written";
        return Err(Problem::invalid("/geometry", detail));
    }
    let mut properties = match body.remove("properties") {
        None | Some(Value::Null) => Map::new(),
        Some(Value::Object(properties)) => properties,
        Some(_) => return Err(Problem::invalid("/properties", "must be an object")),
    };
    properties.retain(|name, sent| current["properties"].get(name) != Some(sent));
    read(collection, "/properties", properties)
}

fn read(collection: Collection, pointer: &'static str, members: Map<String, Value>) -> Result<Written, Problem> {
    let writable = writable(collection);
    if let Some(name) = members.keys().find(|name| !writable.contains(&name.as_str())) {
        let detail = format!("of {}, {} may be written", collection.id(), writable.join(", "));
        return Err(Problem::invalid(format!("{pointer}/{}", pointer_step(name)), detail));
    }
    let patch = parse_json(pointer, Value::Object(members).to_string().as_bytes())?;
    Ok(Written { patch, pointer })
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn object(value: Value) -> Map<String, Value> {
        let Value::Object(members) = value else { unreachable!("the tests write objects") };
        members
    }

    #[test]
    fn members_are_told_from_a_feature() {
        for feature in [json!({"properties": {"label": "co"}}), json!({"geometry": null}), json!({"type": "Feature"})] {
            assert!(is_feature(&object(feature.clone())), "{feature}");
        }
        assert!(!is_feature(&object(json!({"label": "co"}))));
    }

    #[test]
    fn null_is_told_from_nothing() {
        let label = |body| members(Collection::Faces, object(body)).expect("is a patch").patch.label;
        assert_eq!(label(json!({})), None);
        assert_eq!(label(json!({"label": null})), Some(None));
        assert_eq!(label(json!({"label": "ju"})), Some(Some("ju".to_owned())));
    }

    #[test]
    fn what_may_be_written_is_told() {
        let problem = members(Collection::Places, object(json!({"code": "A"}))).expect_err("is refused");
        assert_eq!(problem.errors()[0].pointer.as_deref(), Some("/code"));
        assert_eq!(problem.errors()[0].detail, "of places, name, groups may be written");
    }

    #[test]
    fn a_feature_writes_what_differs() {
        let current = json!({"geometry": {"type": "Point", "coordinates": [1.5, 2]}, "properties": {"label": "co", "areaM2": 4.25}});
        let read = |body: &Value| feature(Collection::Faces, object(body.clone()), &current);
        let mut sent = current.clone();
        assert_eq!(read(&sent).expect("is the same").patch.label, None);
        sent["properties"]["label"] = "ju".into();
        assert_eq!(read(&sent).expect("is a label").patch.label, Some(Some("ju".to_owned())));
        let refused = |body: &Value| read(body).expect_err("is refused").errors()[0].pointer.clone();
        sent["properties"]["areaM2"] = 5.into();
        assert_eq!(refused(&sent).as_deref(), Some("/properties/areaM2"));
        assert_eq!(
            refused(&json!({"geometry": {"type": "Point", "coordinates": [0, 0]}})).as_deref(),
            Some("/geometry")
        );
        assert_eq!(refused(&json!({"properties": "co"})).as_deref(), Some("/properties"));
    }
}
