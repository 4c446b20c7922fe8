//! Areas of GeoJSON as people send them. Limits: rings must be closed and simple; crossings are not looked for.

use serde_json::Value;
use stillage_core::Point;

use super::IngestError;

/// From the coordinates of a document to the map frame.
pub type Coordinates<'a> = &'a dyn Fn([f64; 2]) -> Point;

/// Farthest coordinate, metres: beyond it centimetres are lost, and it is no site.
const FARTHEST: f64 = 1e7;

/// The features of a collection.
pub(super) fn features(document: &Value) -> Result<&[Value], IngestError> {
    if document["type"] != "FeatureCollection" {
        return Err(IngestError::invalid("/type", "must be `FeatureCollection`: send GeoJSON"));
    }
    let features = document["features"].as_array();
    features.map(Vec::as_slice).ok_or_else(|| IngestError::invalid("/features", "must be a list of features"))
}

/// The polygons of a feature.
pub(super) fn area(
    feature: &Value,
    pointer: &str,
    to_map: Coordinates<'_>,
) -> Result<Vec<Vec<Vec<Point>>>, IngestError> {
    let geometry = &feature["geometry"];
    let pointer = format!("{pointer}/geometry");
    let at = format!("{pointer}/coordinates");
    let coordinates = &geometry["coordinates"];
    match geometry["type"].as_str() {
        Some("Polygon") => Ok(vec![polygon(coordinates, &at, to_map)?]),
        Some("MultiPolygon") => {
            let polygons = list(coordinates, &at, 1, "polygons")?.iter().enumerate();
            polygons.map(|(index, coordinates)| polygon(coordinates, &format!("{at}/{index}"), to_map)).collect()
        }
        _ => Err(IngestError::invalid(format!("{pointer}/type"), "must be `Polygon` or `MultiPolygon`")),
    }
}

fn polygon(coordinates: &Value, pointer: &str, to_map: Coordinates<'_>) -> Result<Vec<Vec<Point>>, IngestError> {
    let rings = list(coordinates, pointer, 1, "rings")?.iter().enumerate();
    rings.map(|(index, coordinates)| ring(coordinates, &format!("{pointer}/{index}"), to_map)).collect()
}

/// A closed ring; the last point, which repeats the first, is left out.
fn ring(coordinates: &Value, pointer: &str, to_map: Coordinates<'_>) -> Result<Vec<Point>, IngestError> {
    let positions = list(coordinates, pointer, 4, "positions")?;
    if positions.first() != positions.last() {
        return Err(IngestError::invalid(pointer, "the ring is open: its last position must repeat its first"));
    }
    let position = |(index, coordinates): (usize, &Value)| {
        let axis = |axis: usize| coordinates.get(axis).and_then(Value::as_f64).filter(|value| value.abs() <= FARTHEST);
        match (axis(0), axis(1)) {
            (Some(x), Some(y)) => Ok(to_map([x, y])),
            _ => Err(IngestError::invalid(
                format!("{pointer}/{index}"),
                format!("must be x and y, at most {FARTHEST:.0} from the origin"),
            )),
        }
    };
    positions[..positions.len() - 1].iter().enumerate().map(position).collect()
}

pub(super) fn list<'a>(value: &'a Value, pointer: &str, least: usize, what: &str) -> Result<&'a [Value], IngestError> {
    let entries = value.as_array().filter(|entries| entries.len() >= least);
    let wrong = || IngestError::invalid(pointer, format!("must be a list of {least} or more {what}"));
    entries.map(Vec::as_slice).ok_or_else(wrong)
}
