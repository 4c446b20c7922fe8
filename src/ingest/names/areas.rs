//! Labelled polygons (GeoJSON).
//!
//! A polygon has the properties `code`, `name` or `groups`, and `collection` (`locations` when absent); others are left out.

use serde_json::Value;
use stillage_core::Point;
use stillage_core::excerpt;
use stillage_core::geometry::ring_area;

use super::row::{NameRow, NameTarget, NamedCollection, gather};
use crate::ingest::IngestError;
use crate::ingest::geojson::{Coordinates, area, features};

/// Reads labelled polygons. `to_map` leads from their coordinates to the map frame.
///
/// # Errors
/// Everything that is wrong, by its JSON pointer.
pub fn name_areas(document: &Value, to_map: Coordinates<'_>) -> Result<Vec<NameRow>, Vec<IngestError>> {
    let features = features(document).map_err(|error| vec![error])?;
    gather(
        features.iter().enumerate().map(|(index, feature)| named_area(feature, &format!("/features/{index}"), to_map)),
    )
}

fn named_area(feature: &Value, pointer: &str, to_map: Coordinates<'_>) -> Result<NameRow, IngestError> {
    let properties = &feature["properties"];
    let text = |name: &str| match &properties[name] {
        Value::Null => Ok(None),
        Value::String(text) => Ok(Some(text.as_str())),
        _ => Err(IngestError::invalid(format!("{pointer}/properties/{name}"), "must be a text")),
    };
    let collection = match text("collection")? {
        None | Some("locations") => NamedCollection::Locations,
        Some("places") => NamedCollection::Places,
        Some("aisles") => NamedCollection::Aisles,
        Some("rows") => NamedCollection::Rows,
        Some(other) => {
            let detail = format!("{:?} has no names: locations, places, aisles and rows have", excerpt(other));
            return Err(IngestError::invalid(format!("{pointer}/properties/collection"), detail));
        }
    };
    let rings = area(feature, pointer, to_map)?.into_iter().flat_map(oriented).collect();
    let target = NameTarget::Area { collection, rings };
    let mut row = NameRow { pointer: pointer.to_owned(), target, code: None, name: None, groups: None };
    if let Some(code) = text("code")? {
        if collection != NamedCollection::Locations {
            return Err(row.problem("properties/code", "only locations have a code: give it a name"));
        }
        row.take_code(code)?;
    }
    if let Some(name) = text("name")? {
        row.take_name(name)?;
    }
    if let Some(groups) = properties["groups"].as_array() {
        row.take_groups(groups.iter().map(|group| group.as_str().unwrap_or_default()))?;
    }
    if row.code.is_none() && row.name.is_none() && row.groups.is_none() {
        return Err(row.problem("properties", "has no code, name or groups"));
    }
    Ok(row)
}

/// The outline of a polygon counter-clockwise, its holes clockwise.
fn oriented(polygon: Vec<Vec<Point>>) -> impl Iterator<Item = Vec<Point>> {
    polygon.into_iter().enumerate().map(|(index, mut ring)| {
        if (ring_area(&ring) > 0.0) != (index == 0) {
            ring.reverse();
        }
        ring
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn polygons_carry_their_labels() {
        let feature = |properties: Value| {
            json!({"type": "Feature", "properties": properties,
                "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]]]}})
        };
        let read = |properties: Value| {
            name_areas(&json!({"type": "FeatureCollection", "features": [feature(properties)]}), &Point::from)
        };
        let rows = read(json!({"name": "Cold store", "collection": "places", "fill": "#123456"})).expect("is right");
        let NameTarget::Area { collection, rings } = &rows[0].target else { panic!("it is an area") };
        assert_eq!((*collection, rings[0].len()), (NamedCollection::Places, 4));
        let pointer = |properties: Value| read(properties).expect_err("is wrong")[0].pointer.clone();
        assert_eq!(pointer(json!({"code": "A", "collection": "places"})), "/features/0/properties/code");
        assert_eq!(pointer(json!({"code": "A", "collection": "faces"})), "/features/0/properties/collection");
        assert_eq!(pointer(json!({"fill": "red"})), "/features/0/properties");
    }
}
