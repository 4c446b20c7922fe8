//! Corrections from GeoJSON: the racks of a plan, for example.
//!
//! A feature becomes what its shape suggests, or what its property `kind` says: an area is drawn, a line splits, a point gives
//! a label or a name, points are merged. The other members of the correction are properties of their names; properties that
//! mean nothing here are left out.

use serde_json::{Map, Value, json};

use super::IngestError;
use super::geojson::{Coordinates, list};

/// Members of corrections that are no points.
const PROPERTIES: [&str; 6] = ["label", "name", "places", "pitchM", "layers", "isOpen"];

/// A correction as JSON, and where it stands.
#[derive(Debug, Clone, PartialEq)]
pub struct CorrectionFeature {
    /// JSON pointer to its feature.
    pub pointer: String,
    /// The correction, with points in metres of the map frame.
    pub correction: Map<String, Value>,
}

/// The corrections of a feature or a feature collection. What is drawn without a label has `drawn_label`; where there is none,
/// a label must be said.
///
/// # Errors
/// Everything that is wrong, with JSON pointers.
pub fn correction_features(
    document: &Value,
    drawn_label: Option<&str>,
    to_map: Coordinates<'_>,
) -> Result<Vec<CorrectionFeature>, Vec<IngestError>> {
    let wrong = |pointer: &str, message: &str| vec![IngestError::invalid(pointer, message)];
    let features: Vec<(String, &Value)> = match document["type"].as_str() {
        Some("Feature") => vec![(String::new(), document)],
        Some("FeatureCollection") => {
            let features = document["features"].as_array();
            let features = features.ok_or_else(|| wrong("/features", "must be a list of features"))?;
            features.iter().enumerate().map(|(index, feature)| (format!("/features/{index}"), feature)).collect()
        }
        _ => return Err(wrong("/type", "must be `Feature` or `FeatureCollection`: send GeoJSON")),
    };
    if features.is_empty() {
        return Err(wrong("/features", "there is no feature in it"));
    }
    let (mut read, mut problems) = (Vec::new(), Vec::new());
    for (pointer, feature) in features {
        match of_feature(feature, &pointer, drawn_label, to_map) {
            Ok(corrections) => {
                let with_place = |correction| CorrectionFeature { pointer: pointer.clone(), correction };
                read.extend(corrections.into_iter().map(with_place));
            }
            Err(problem) => problems.push(problem),
        }
    }
    if problems.is_empty() { Ok(read) } else { Err(problems) }
}

/// The corrections of a feature: one for each of its polygons, lines or points.
fn of_feature(
    feature: &Value,
    pointer: &str,
    drawn_label: Option<&str>,
    to_map: Coordinates<'_>,
) -> Result<Vec<Map<String, Value>>, IngestError> {
    let (geometry, properties) = (&feature["geometry"], &feature["properties"]);
    let at = format!("{pointer}/geometry/coordinates");
    let coordinates = &geometry["coordinates"];
    let kind = match &properties["kind"] {
        Value::Null => None,
        Value::String(kind) => Some(kind.as_str()),
        _ => return Err(IngestError::invalid(format!("{pointer}/properties/kind"), "must be a text")),
    };
    let each = |what: &str| -> Result<Vec<(String, &Value)>, IngestError> {
        let parts = list(coordinates, &at, 1, what)?.iter().enumerate();
        Ok(parts.map(|(index, part)| (format!("{at}/{index}"), part)).collect())
    };
    let (kind, shapes) = match geometry["type"].as_str() {
        Some("Polygon") => (kind.unwrap_or("draw"), vec![outline(coordinates, &at, to_map)?]),
        Some("MultiPolygon") => {
            let outlines = each("polygons")?.into_iter().map(|(at, polygon)| outline(polygon, &at, to_map));
            (kind.unwrap_or("draw"), outlines.collect::<Result<_, _>>()?)
        }
        Some("LineString") => (kind.unwrap_or("split"), vec![path(coordinates, &at, to_map)?]),
        Some("MultiLineString") => {
            let paths = each("lines")?.into_iter().map(|(at, line)| path(line, &at, to_map));
            (kind.unwrap_or("split"), paths.collect::<Result<_, _>>()?)
        }
        Some("Point") => {
            let suggested = if properties["label"].is_null() { "name" } else { "label" };
            (kind.unwrap_or(suggested), vec![position(coordinates, &at, to_map)?])
        }
        Some("MultiPoint") => (kind.unwrap_or("merge"), vec![path(coordinates, &at, to_map)?]),
        _ => {
            let message = "must be a polygon, a line or a point, or several of them";
            return Err(IngestError::invalid(format!("{pointer}/geometry/type"), message));
        }
    };
    let member = match kind {
        "draw" | "erase" => "ring",
        "row" => "rectangle",
        "merge" | "label" | "name" => "at",
        _ => "line",
    };
    let of_shape = |shape: Value| {
        let mut correction = Map::from_iter([("kind".to_owned(), json!(kind)), (member.to_owned(), shape)]);
        let known = PROPERTIES.iter().filter(|name| is_property(kind, name) && !properties[**name].is_null());
        correction.extend(known.map(|name| ((*name).to_owned(), properties[*name].clone())));
        if kind == "draw" && !correction.contains_key("label") {
            let missing = "say which label it gets: the rule set has no label for storage, or more than one";
            let missing = || IngestError::invalid(format!("{pointer}/properties/label"), missing);
            correction.insert("label".to_owned(), json!(drawn_label.ok_or_else(missing)?));
        }
        if kind == "row" {
            correction["rectangle"] = four_corners(&correction["rectangle"]);
        }
        if kind == "door" {
            correction.entry("isOpen").or_insert(Value::Bool(true));
        }
        Ok(correction)
    };
    shapes.into_iter().map(of_shape).collect()
}

/// Whether corrections of a kind have a member. Of an unknown kind all are kept: it is refused later.
fn is_property(kind: &str, name: &str) -> bool {
    match kind {
        "draw" => matches!(name, "label" | "name"),
        "row" => matches!(name, "label" | "places" | "pitchM" | "layers"),
        "label" => name == "label",
        "name" => name == "name",
        "door" => name == "isOpen",
        "split" | "merge" | "erase" => false,
        _ => true,
    }
}

/// The corners of a ring without the first one repeated.
fn four_corners(ring: &Value) -> Value {
    match ring.as_array().map(Vec::as_slice) {
        Some([corners @ .., last]) if corners.len() == 4 && corners[0] == *last => json!(corners),
        _ => ring.clone(),
    }
}

/// The outer ring of a polygon without holes.
fn outline(polygon: &Value, pointer: &str, to_map: Coordinates<'_>) -> Result<Value, IngestError> {
    match list(polygon, pointer, 1, "rings")? {
        [outline] => path(outline, &format!("{pointer}/0"), to_map),
        _ => {
            Err(IngestError::invalid(format!("{pointer}/1"), "a polygon has no holes here: draw what is in them, too"))
        }
    }
}

fn path(positions: &Value, pointer: &str, to_map: Coordinates<'_>) -> Result<Value, IngestError> {
    let positions = list(positions, pointer, 1, "positions")?.iter().enumerate();
    positions.map(|(index, at)| position(at, &format!("{pointer}/{index}"), to_map)).collect()
}

fn position(coordinates: &Value, pointer: &str, to_map: Coordinates<'_>) -> Result<Value, IngestError> {
    let axis = |axis: usize| coordinates.get(axis).and_then(Value::as_f64);
    let (Some(x), Some(y)) = (axis(0), axis(1)) else {
        return Err(IngestError::invalid(pointer, "must be a position: two numbers"));
    };
    let point = to_map([x, y]);
    Ok(json!([point.x, point.y]))
}

#[cfg(test)]
mod tests {
    use stillage_core::Point;

    use super::*;

    fn read(feature: &Value, drawn_label: Option<&str>) -> Result<Vec<Value>, Vec<String>> {
        let half = |[x, y]: [f64; 2]| Point::new(x / 2.0, y / 2.0);
        match correction_features(feature, drawn_label, &half) {
            Ok(read) => Ok(read.into_iter().map(|feature| Value::Object(feature.correction)).collect()),
            Err(errors) => {
                Err(errors.into_iter().map(|error| format!("{} {}", error.pointer, error.message)).collect())
            }
        }
    }

    fn feature(kind: &str, coordinates: &Value, properties: &Value) -> Value {
        json!({"type": "Feature", "geometry": {"type": kind, "coordinates": coordinates}, "properties": properties})
    }

    #[test]
    fn a_shape_says_what_it_corrects() {
        let square = json!([[[0, 0], [2, 0], [2, 2], [0, 0]]]);
        let rack = feature("Polygon", &square, &json!({"name": "Rack 12", "layer": "RACKS"}));
        let ring = json!([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 0.0]]);
        assert_eq!(
            read(&rack, Some("pc")),
            Ok(vec![json!({"kind": "draw", "ring": ring, "label": "pc", "name": "Rack 12"})])
        );
        let line = feature("LineString", &json!([[0, 0], [2, 0]]), &Value::Null);
        assert_eq!(read(&line, None), Ok(vec![json!({"kind": "split", "line": [[0.0, 0.0], [1.0, 0.0]]})]));
        let point = feature("Point", &json!([2, 4]), &json!({"name": "Cold store"}));
        assert_eq!(read(&point, None), Ok(vec![json!({"kind": "name", "at": [1.0, 2.0], "name": "Cold store"})]));
        let row = json!([[[0, 0], [8, 0], [8, 2], [0, 2], [0, 0]]]);
        let row = feature("Polygon", &row, &json!({"kind": "row", "places": 4}));
        let rectangle = json!([[0.0, 0.0], [4.0, 0.0], [4.0, 1.0], [0.0, 1.0]]);
        assert_eq!(read(&row, None), Ok(vec![json!({"kind": "row", "rectangle": rectangle, "places": 4})]));
    }

    #[test]
    fn all_that_is_wrong_is_told() {
        let square = json!([[[0, 0], [2, 0], [2, 2], [0, 0]]]);
        let holed = json!([square[0], square[0]]);
        let nowhere = json!({"type": "Feature", "geometry": null, "properties": {}});
        let features = json!({"type": "FeatureCollection", "features": [
            feature("Polygon", &square, &json!({})), feature("Polygon", &holed, &json!({})),
            feature("LineString", &json!([[0, 0], [2]]), &json!({})), nowhere]});
        assert_eq!(
            read(&features, None),
            Err(vec![
                "/features/0/properties/label say which label it gets: the rule set has no label for storage, or more \
                 than one"
                    .into(),
                "/features/1/geometry/coordinates/1 a polygon has no holes here: draw what is in them, too".into(),
                "/features/2/geometry/coordinates/1 must be a position: two numbers".into(),
                "/features/3/geometry/type must be a polygon, a line or a point, or several of them".into(),
            ])
        );
    }
}
