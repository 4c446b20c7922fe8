//! GeoJSON -> the truth of a site.
//!
//! A feature collection in metres of the map frame. `properties.label` says what a feature is: `pallet` (a place for one
//! pallet), `corridor`, `junction`, or `region` (with `angle_deg`, the direction of its rows); features of other labels
//! (walls, pillars, rooms) are left out. A place may say its `region` (`A`), whether it was `occupied` (yes) and which
//! share of its surroundings was `observed` (1). Areas are polygons or multi-polygons.
//!
//! O(bytes).

use serde_json::Value;
use stillage_core::Point;
use stillage_core::evaluation::{GroundTruth, TrueArea, TruePlace, TrueRegion};

use super::IngestError;
use super::geojson::{self, features};

/// Reads the truth of a site.
///
/// # Errors
/// [`IngestError`] with the JSON pointer of what is wrong.
pub fn ground_truth(document: &Value) -> Result<GroundTruth, IngestError> {
    let features = features(document)?;
    let mut truth = GroundTruth::default();
    for (index, feature) in features.iter().enumerate() {
        read(feature, &format!("/features/{index}"), &mut truth)?;
    }
    if truth.places.is_empty() && truth.corridors.is_empty() && truth.junctions.is_empty() {
        let message = "holds no feature labelled `pallet`, `corridor` or `junction`: there is nothing to compare with";
        return Err(IngestError::invalid("/features", message));
    }
    Ok(truth)
}

/// Adds one feature to the truth.
fn read(feature: &Value, pointer: &str, truth: &mut GroundTruth) -> Result<(), IngestError> {
    let properties = &feature["properties"];
    let label = properties["label"].as_str().ok_or_else(|| {
        IngestError::invalid(format!("{pointer}/properties/label"), "must say what the feature is, like `pallet`")
    })?;
    match label {
        "pallet" => truth.places.push(place(feature, pointer)?),
        "corridor" => truth.corridors.push(area(feature, pointer)?),
        "junction" => truth.junctions.push(area(feature, pointer)?),
        "region" => {
            let angle = number(properties, "angle_deg", pointer, -360.0..=360.0)?.ok_or_else(|| {
                let message = "must be the direction of the rows, degrees counter-clockwise from x";
                IngestError::invalid(format!("{pointer}/properties/angle_deg"), message)
            })?;
            let name = text(properties, "region", pointer)?;
            truth.regions.push(TrueRegion { name, angle: angle.to_radians() });
        }
        _ => {}
    }
    Ok(())
}

fn place(feature: &Value, pointer: &str) -> Result<TruePlace, IngestError> {
    let properties = &feature["properties"];
    let occupied = match &properties["occupied"] {
        Value::Null => true,
        Value::Bool(occupied) => *occupied,
        _ => return Err(IngestError::invalid(format!("{pointer}/properties/occupied"), "must be true or false")),
    };
    Ok(TruePlace {
        area: area(feature, pointer)?,
        region: text(properties, "region", pointer)?,
        occupied,
        observed: number(properties, "observed", pointer, 0.0..=1.0)?.unwrap_or(1.0),
    })
}

/// The name of a region; `A` when absent.
fn text(properties: &Value, name: &str, pointer: &str) -> Result<String, IngestError> {
    match &properties[name] {
        Value::Null => Ok("A".to_owned()),
        Value::String(text) => Ok(text.clone()),
        _ => Err(IngestError::invalid(format!("{pointer}/properties/{name}"), "must be a text")),
    }
}

/// A number that may be absent.
fn number(
    properties: &Value,
    name: &str,
    pointer: &str,
    range: std::ops::RangeInclusive<f64>,
) -> Result<Option<f64>, IngestError> {
    match &properties[name] {
        Value::Null => Ok(None),
        value => match value.as_f64().filter(|number| range.contains(number)) {
            Some(number) => Ok(Some(number)),
            None => Err(IngestError::invalid(
                format!("{pointer}/properties/{name}"),
                format!("must be a number from {} to {}", range.start(), range.end()),
            )),
        },
    }
}

fn area(feature: &Value, pointer: &str) -> Result<TrueArea, IngestError> {
    let area = TrueArea::new(geojson::area(feature, pointer, &Point::from)?);
    // Holes may not eat up their polygon.
    let at = || format!("{pointer}/geometry/coordinates");
    if area.area() > 0.0 { Ok(area) } else { Err(IngestError::invalid(at(), "the area is not above 0 square metres")) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use expect_test::expect;
    use serde_json::json;

    fn square(x: f64, side: f64) -> Value {
        json!([[x, 0.0], [x + side, 0.0], [x + side, side], [x, side], [x, 0.0]])
    }

    fn feature(properties: &Value, geometry: &Value) -> Value {
        json!({"type": "Feature", "properties": properties, "geometry": geometry})
    }

    fn collection(features: &[Value]) -> Value {
        json!({"type": "FeatureCollection", "features": features})
    }

    #[test]
    fn places_and_floor_are_read_and_walls_are_left_out() {
        let polygon = |x: f64| json!({"type": "Polygon", "coordinates": [square(x, 1.0)]});
        let ring =
            json!({"type": "MultiPolygon", "coordinates": [[square(0.0, 4.0), square(1.0, 1.0)], [square(9.0, 1.0)]]});
        let document = collection(&[
            feature(&json!({"label": "pallet", "region": "B", "occupied": false, "observed": 0.25}), &polygon(0.0)),
            feature(&json!({"label": "pallet"}), &polygon(1.0)),
            feature(&json!({"label": "corridor", "aisle": 0}), &polygon(2.0)),
            feature(&json!({"label": "junction"}), &ring),
            feature(&json!({"label": "wall"}), &json!(null)),
            feature(&json!({"label": "region", "region": "B", "angle_deg": 90.0}), &polygon(3.0)),
        ]);
        let truth = ground_truth(&document).unwrap();
        let places: Vec<(&str, bool, f64)> =
            truth.places.iter().map(|place| (place.region.as_str(), place.occupied, place.observed)).collect();
        assert_eq!(places, [("B", false, 0.25), ("A", true, 1.0)]);
        assert_eq!(truth.corridors[0].area(), 1.0);
        assert_eq!(truth.junctions[0].area(), 16.0);
        assert_eq!(truth.regions, [TrueRegion { name: "B".to_owned(), angle: std::f64::consts::FRAC_PI_2 }]);
    }

    #[test]
    fn what_is_wrong_is_named_with_its_pointer() {
        let good = json!({"type": "Polygon", "coordinates": [square(0.0, 1.0)]});
        let pallet = json!({"label": "pallet"});
        let with = |properties: Value| collection(&[feature(&properties, &good)]);
        let shaped = |geometry: Value| collection(&[feature(&pallet, &geometry)]);
        let cases = [
            json!({"type": "Feature"}),
            json!({"type": "FeatureCollection"}),
            collection(&[]),
            with(json!({"label": "wall"})),
            with(json!({})),
            with(json!({"label": "pallet", "observed": 50})),
            with(json!({"label": "pallet", "occupied": "yes"})),
            with(json!({"label": "pallet", "region": 1})),
            with(json!({"label": "region"})),
            shaped(json!({"type": "Point", "coordinates": [0, 0]})),
            shaped(json!({"type": "Polygon", "coordinates": []})),
            shaped(json!({"type": "Polygon", "coordinates": [[[0, 0], [1, 0], [1, 1], [0, 1]]]})),
            shaped(json!({"type": "Polygon", "coordinates": [[[0, 0], [1, 0], [1e9, 1], [0, 0]]]})),
            shaped(json!({"type": "Polygon", "coordinates": [[[0, 0], [1, 0], [2, 0], [0, 0]]]})),
        ];
        let report: Vec<String> = cases
            .iter()
            .map(|case| {
                let error = ground_truth(case).unwrap_err();
                format!("{}: {}", error.pointer, error.message)
            })
            .collect();
        expect![[r#"
            /type: must be `FeatureCollection`: send GeoJSON
            /features: must be a list of features
            /features: holds no feature labelled `pallet`, `corridor` or `junction`: there is nothing to compare with
            /features: holds no feature labelled `pallet`, `corridor` or `junction`: there is nothing to compare with
            /features/0/properties/label: must say what the feature is, like `pallet`
            /features/0/properties/observed: must be a number from 0 to 1
            /features/0/properties/occupied: must be true or false
            /features/0/properties/region: must be a text
            /features/0/properties/angle_deg: must be the direction of the rows, degrees counter-clockwise from x
            /features/0/geometry/type: must be `Polygon` or `MultiPolygon`
            /features/0/geometry/coordinates: must be a list of 1 or more rings
            /features/0/geometry/coordinates/0: the ring is open: its last position must repeat its first
            /features/0/geometry/coordinates/0/2: must be x and y, at most 10000000 from the origin
            /features/0/geometry/coordinates: the area is not above 0 square metres"#]]
        .assert_eq(&report.join("\n"));
    }
}
