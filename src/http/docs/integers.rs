//! How the document speaks of whole numbers: the library says `int32` of unsigned ones too, which hold twice as much.

use serde_json::{Map, Value, json};

/// Gives unsigned numbers the range that they have. The limit of a page has none: one that is too large is lowered.
pub fn tell_ranges(value: &mut Value) {
    match value {
        Value::Array(entries) => entries.iter_mut().for_each(tell_ranges),
        Value::Object(members) => {
            if members.get("name") == Some(&json!("limit"))
                && let Some(Value::Object(schema)) = members.get_mut("schema")
            {
                schema.remove("format");
            }
            tell_range(members);
            members.values_mut().for_each(tell_ranges);
        }
        _ => {}
    }
}

fn tell_range(schema: &mut Map<String, Value>) {
    let is_unsigned = schema.get("minimum").and_then(Value::as_f64).is_some_and(|least| least >= 0.0);
    if is_unsigned && schema.get("format") == Some(&json!("int32")) {
        schema.insert("format".to_owned(), json!("int64"));
        schema.entry("maximum").or_insert(json!(u32::MAX));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unsigned_numbers_have_their_range() {
        let mut schema = json!({"seed": {"type": "integer", "format": "int32", "minimum": 0}});
        tell_ranges(&mut schema);
        let expected = json!({"type": "integer", "format": "int64", "minimum": 0, "maximum": 4_294_967_295_u32});
        assert_eq!(schema["seed"], expected);
    }

    #[test]
    fn the_limit_of_a_page_may_be_any_number() {
        let mut parameter = json!({"name": "limit", "schema": {"type": "integer", "format": "int32", "minimum": 1}});
        tell_ranges(&mut parameter);
        assert_eq!(parameter["schema"], json!({"type": "integer", "minimum": 1}));
    }
}
