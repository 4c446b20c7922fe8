//! What a collection holds, as a JSON Schema (OGC API Features parts 3 and 5).

use serde::Serialize;
use serde_json::{Map, Value, json};
use utoipa::ToSchema;

use crate::features::query::GEOMETRY;
use crate::features::{CollectionSchema, GeometryType, Kind, Property};

/// The properties of a collection as a JSON Schema.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = FeatureSchema)]
#[serde(rename_all = "camelCase")]
pub struct FeatureSchemaView {
    /// The version of JSON Schema.
    #[serde(rename = "$schema")]
    #[schema(format = "uri")]
    schema: &'static str,
    /// Where this schema is.
    #[serde(rename = "$id")]
    #[schema(format = "uri")]
    id: String,
    /// `object`
    r#type: &'static str,
    title: &'static str,
    description: &'static str,
    /// A JSON Schema for each property; that of the geometry has the format `geometry-...`.
    #[schema(value_type = Object)]
    properties: Map<String, Value>,
    /// The properties that every feature has.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    required: Vec<&'static str>,
    /// Whether there may be others.
    additional_properties: bool,
}

impl FeatureSchemaView {
    /// The properties of the features, at this address.
    #[must_use]
    pub fn of_features(schema: &CollectionSchema, address: String) -> Self {
        let required = schema.properties.iter().filter(|property| !property.nullable).map(|property| property.name);
        Self { required: required.collect(), ..Self::new(schema, address, |_| true) }
    }

    /// What filters may use, at this address.
    #[must_use]
    pub fn of_queryables(schema: &CollectionSchema, address: String) -> Self {
        Self::new(schema, address, |property| !matches!(property.kind, Kind::Pose | Kind::Box))
    }

    fn new(schema: &CollectionSchema, address: String, is_in: impl Fn(&Property) -> bool) -> Self {
        let geometry = json!({
            "title": "Geometry",
            "description": "The shape of the feature",
            "x-ogc-role": "primary-geometry",
            "format": geometry_format(schema.geometry),
        });
        let properties = schema.properties.iter().enumerate().filter(|(_, property)| is_in(property));
        let properties = properties.map(|(index, each)| (each.name.to_owned(), property(each, index == 0)));
        Self {
            schema: "https://json-schema.org/draft/2020-12/schema",
            id: address,
            r#type: "object",
            title: schema.title,
            description: schema.description,
            properties: [(GEOMETRY.to_owned(), geometry)].into_iter().chain(properties).collect(),
            required: Vec::new(),
            additional_properties: false,
        }
    }
}

/// The format of a geometry that has one of these types (OGC 23-058r1).
fn geometry_format(types: &[GeometryType]) -> String {
    let names: Vec<String> = types.iter().map(|one| one.name().to_lowercase()).collect();
    format!("geometry-{}", names.join("-or-"))
}

fn property(property: &Property, is_id: bool) -> Value {
    let number = json!({"type": "number"});
    let mut schema = match property.kind {
        Kind::Boolean => json!({"type": "boolean"}),
        Kind::Integer => json!({"type": "integer", "minimum": 0}),
        Kind::Number => number,
        Kind::Text => json!({"type": "string"}),
        Kind::Word(words) => json!({"type": "string", "enum": words}),
        Kind::Integers => json!({"type": "array", "items": {"type": "integer", "minimum": 0}}),
        Kind::Numbers => json!({"type": "array", "items": number}),
        Kind::Texts => json!({"type": "array", "items": {"type": "string"}}),
        Kind::Words(words) => json!({"type": "array", "items": {"type": "string", "enum": words}}),
        Kind::Position => position(),
        Kind::Pose => json!({"type": "object", "properties": {"x": number, "y": number, "headingDeg": number}}),
        Kind::Box => json!({"type": "object", "properties":
            {"center": position(), "lengthM": number, "widthM": number, "orientation": number}}),
    };
    schema["title"] = property.title.into();
    schema["description"] = property.description.into();
    if is_id {
        schema["x-ogc-role"] = "id".into();
    }
    if let Some(unit) = property.unit {
        schema["x-ogc-unit"] = unit.into();
        schema["x-ogc-unitLang"] = "UCUM".into();
    }
    schema
}

/// x and y.
fn position() -> Value {
    json!({"type": "array", "items": {"type": "number"}, "minItems": 2, "maxItems": 2})
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::features::Collection;

    #[test]
    fn geometries_and_units_are_told_as_the_standard_says() {
        let of =
            |collection| FeatureSchemaView::of_features(CollectionSchema::of(collection), "http://x/schema".into());
        let faces = of(Collection::Faces);
        assert_eq!(faces.properties["geometry"]["format"], "geometry-polygon-or-multipolygon");
        assert_eq!(of(Collection::Vertices).properties["geometry"]["format"], "geometry-point");
        assert_eq!(faces.properties["id"]["x-ogc-role"], "id");
        assert_eq!(faces.properties["areaM2"]["x-ogc-unit"], "m2");
        assert!(faces.required.contains(&"label") && !faces.required.contains(&"location"));
        let queryables = FeatureSchemaView::of_queryables(CollectionSchema::of(Collection::Regions), String::new());
        assert!(of(Collection::Regions).properties.contains_key("box") && !queryables.properties.contains_key("box"));
    }
}
