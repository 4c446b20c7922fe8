//! The collections of a whole map as bytes.

use serde_json::Value;

use super::{csv, geojson};
use crate::coordinates::{Crs, Transform};
use crate::features::query::PropertySelection;
use crate::features::tests::{all, hall_view};
use crate::features::{Collection, Geometry, features};

#[test]
fn the_bytes_are_json_and_in_metres_the_map_frame() {
    for (collection, features) in all() {
        let members: geojson::Members<'_> = &[("crs", &geojson::EPSG_3857)];
        let properties = PropertySelection::all(collection);
        let bytes = geojson::feature_collection(&features, &properties, &Transform::map_frame(), members);
        let json: Value = serde_json::from_slice(&bytes).unwrap();
        assert_eq!(json["crs"]["properties"]["name"], "urn:ogc:def:crs:EPSG::3857");
        let written = json["features"].as_array().unwrap();
        assert_eq!(written.len(), features.len(), "{}", collection.id());
        for (feature, written) in features.iter().zip(written) {
            assert_eq!(serde_json::to_value(&feature.id).unwrap(), written["id"]);
            let names: Vec<&str> = properties.properties().map(|property| property.name).collect();
            assert_eq!(written["properties"].as_object().unwrap().keys().collect::<Vec<_>>(), names);
            let mut first = &written["geometry"]["coordinates"];
            while first[0].is_array() {
                first = &first[0];
            }
            let position = feature.geometry.points().next().unwrap();
            assert!((first[0].as_f64().unwrap() - position.x).abs() < 1e-4);
            assert!((first[1].as_f64().unwrap() - position.y).abs() < 1e-4);
        }
    }
}

#[test]
fn degrees_are_written_with_nine_decimals() {
    let features = features(&hall_view(), Collection::Vertices);
    let all = PropertySelection::all(Collection::Vertices);
    let bytes = geojson::feature_collection(&features, &all, &Transform::new(Crs::Crs84, None), &[]);
    let json: Value = serde_json::from_slice(&bytes).unwrap();
    assert_eq!(json.get("crs"), None, "GeoJSON is in degrees unless it says otherwise");
    let longitude = json["features"][0]["geometry"]["coordinates"][0].as_f64().unwrap();
    let Geometry::Point(position) = features[0].geometry else { panic!("a vertex is a point") };
    assert!((longitude - (position.x / 6_378_137.0).to_degrees()).abs() < 1e-9);
}

#[test]
fn the_table_has_a_row_for_each_location() {
    let locations = features(&hall_view(), Collection::Locations);
    let table = String::from_utf8(csv::locations(&locations)).unwrap();
    let rows: Vec<&str> = table.lines().collect();
    assert_eq!(rows.len(), locations.len() + 1);
    for (row, location) in rows[1..].iter().zip(&locations) {
        assert!(row.starts_with(&format!("{},", location.id)), "{row}");
    }
}
