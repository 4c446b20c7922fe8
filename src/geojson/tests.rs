//! The collections of a whole map: a small hall with racks, turned and moved in its map frame.

use std::sync::OnceLock;

use expect_test::expect;
use serde_json::Value;
use stillage_core::geometry::{Point, ring_area};
use stillage_core::semantics::{self, Assignment, RuleSet};
use stillage_core::watch::Watch;
use stillage_core::{AnalysisOptions, GridFrame, Occupancy, OccupancyGrid, layout};

use super::feature::Ring;
use super::*;

/// A hall of 24 x 16 m with double rows of racks and an office in a corner, at 0.1 m, turned by 0.3 radians.
fn hall() -> OccupancyGrid {
    let (width, height) = (240, 160);
    let cell = |column: usize, row: usize| {
        let is_office_wall = column >= 200 && row < 26 && (column < 202 || row >= 24 && !(212..222).contains(&column));
        let is_wall = !(4..236).contains(&column) || !(4..156).contains(&row) || is_office_wall;
        let in_rack = (40..200).contains(&column) && row % 50 >= 28 && row % 50 < 48 && row < 150;
        let is_post = (column - column.min(40)).is_multiple_of(27) || matches!(row % 50, 28 | 38 | 47);
        match (is_wall, in_rack) {
            (true, _) => Occupancy::Occupied,
            (false, true) if is_post => Occupancy::Occupied,
            (false, true) => Occupancy::Unknown,
            (false, false) => Occupancy::Free,
        }
    };
    let cells = (0..width * height).map(|index| cell(index % width, index / width)).collect();
    OccupancyGrid::new(width, height, GridFrame { resolution: 0.1, origin: Point::new(-3.0, 7.0), yaw: 0.3 }, cells)
}

struct Whole {
    analysis: Analysis,
    semantic: SemanticMap,
    locations: Vec<Location>,
}

/// Analysed once for all tests.
fn whole() -> &'static Whole {
    static WHOLE: OnceLock<Whole> = OnceLock::new();
    WHOLE.get_or_init(|| {
        let mut options = AnalysisOptions::default();
        options.categorization.stride = 4;
        options.categorization.beams = 60;
        let spec = options.check().unwrap();
        let analysis = stillage_core::analyze(&hall(), &spec, &Watch::unwatched()).unwrap();
        let rule_set = RuleSet::warehouse();
        let label =
            |suggestion: semantics::Suggestion| (suggestion.category, rule_set.label(suggestion.label).id.clone());
        let assignment = semantics::suggest(&analysis, &rule_set).into_iter().map(label).collect();
        let assignment = Assignment { assignment, ..Assignment::default() };
        let semantic = semantics::apply(&analysis, &rule_set, &assignment).unwrap();
        let locations = layout::locations(&analysis, &semantic);
        Whole { analysis, semantic, locations }
    })
}

fn view(whole: &Whole) -> MapView<'_> {
    MapView { analysis: &whole.analysis, semantic: &whole.semantic, locations: &whole.locations, georeference: None }
}

fn all() -> impl Iterator<Item = (Collection, Vec<Feature>)> {
    Collection::ALL.into_iter().map(|collection| (collection, features(&view(whole()), collection)))
}

fn polygons_of(geometry: &Geometry) -> Vec<Vec<Ring>> {
    match geometry {
        Geometry::Polygon(rings) => vec![rings.clone()],
        Geometry::MultiPolygon(polygons) => polygons.clone(),
        _ => Vec::new(),
    }
}

fn area(feature: &Feature) -> f64 {
    polygons_of(&feature.geometry).iter().flatten().map(|ring| ring_area(ring)).sum()
}

#[test]
fn each_collection_has_its_properties() {
    let lists: Vec<String> = all()
        .map(|(collection, features)| {
            let first = features.first().unwrap_or_else(|| panic!("no {}", collection.id()));
            let names: Vec<&str> = first.properties.keys().map(String::as_str).collect();
            format!("{} ({}): {}\n", collection.id(), first.geometry.type_name(), names.join(", "))
        })
        .collect();
    expect![[r#"
        faces (Polygon): id, category, categoryShares, membership, label, labelName, functionality, confidence, evidence, areaM2, lengthM, widthM, orientation, elongation, freeFraction, occupiedFraction, unknownFraction, region, edges, place, location
        edges (LineString): id, faceLeft, faceRight, cogency, lengthM, support, open, confidence, evidence, disagreement, link, orientation, line
        vertices (Point): id, edges
        nodes (Point): id, face, label, degree
        links (LineString): id, from, to, connectivity, drivable, edge
        lines (LineString): id, orientation, offset, support, region
        regions (Polygon): id, orientations, share, box
        places (Polygon): id, label, labelName, functionality, areaM2, room, faces
        doors (LineString): id, widthM, from, to, links
        locations (Polygon): code, face, label, labelName, aisle, bay, side, centre, widthM, depthM, headingDeg, occupancy, accessEdges, accessFrom, approach
    "#]].assert_eq(&lists.concat());
}

#[test]
fn ids_ascend() {
    for (collection, features) in all() {
        assert!(features.is_sorted_by(|first, second| first.id < second.id), "{}", collection.id());
    }
}

#[test]
fn features_have_the_same_properties_throughout() {
    for (collection, features) in all() {
        let names = |feature: &Feature| feature.properties.keys().cloned().collect::<Vec<_>>();
        assert!(features.iter().all(|feature| names(feature) == names(&features[0])), "{}", collection.id());
    }
}

#[test]
fn rings_turn_to_the_right_hand_and_areas_are_kept() {
    for (collection, features) in all() {
        for feature in &features {
            for rings in polygons_of(&feature.geometry) {
                assert!(ring_area(&rings[0]) > 0.0, "{} {}", collection.id(), feature.id);
                assert!(rings[1..].iter().all(|hole| ring_area(hole) < 0.0), "{} {}", collection.id(), feature.id);
            }
            if let Some(stated) = feature.properties.get("areaM2").and_then(Value::as_f64) {
                assert!((area(feature) - stated).abs() < 1e-3, "{} {}", collection.id(), feature.id);
            }
        }
    }
}

#[test]
fn places_and_regions_cover_what_the_faces_cover() {
    let total = |collection| features(&view(whole()), collection).iter().map(area).sum::<f64>();
    let faces = total(Collection::Faces);
    // Faces that nobody identified belong to no place, unless they are a room.
    let is_placed = |feature: &&Feature| !feature.properties["place"].is_null();
    let placed: f64 = features(&view(whole()), Collection::Faces).iter().filter(is_placed).map(area).sum();
    assert!((total(Collection::Places) - placed).abs() < 1e-6);
    assert!((total(Collection::Regions) - faces).abs() < 1e-6);
}

#[test]
fn references_lead_to_features() {
    let ids = |collection| features(&view(whole()), collection).into_iter().map(|feature| feature.id);
    let faces: Vec<FeatureId> = ids(Collection::Faces).collect();
    let edges: Vec<FeatureId> = ids(Collection::Edges).collect();
    let links: Vec<FeatureId> = ids(Collection::Links).collect();
    let leads = |targets: &[FeatureId], value: &Value| {
        value.is_null() || value.as_u64().is_some_and(|id| targets.contains(&FeatureId::Number(id)))
    };
    for feature in features(&view(whole()), Collection::Edges) {
        assert!(leads(&faces, &feature.properties["faceLeft"]) && leads(&faces, &feature.properties["faceRight"]));
        assert!(leads(&links, &feature.properties["link"]));
    }
    for feature in features(&view(whole()), Collection::Links) {
        assert!(leads(&faces, &feature.properties["from"]) && leads(&faces, &feature.properties["to"]));
    }
    let places: Vec<FeatureId> = ids(Collection::Places).collect();
    for feature in features(&view(whole()), Collection::Doors) {
        assert!(leads(&places, &feature.properties["from"]) && leads(&places, &feature.properties["to"]));
        assert!(feature.properties["links"].as_array().unwrap().iter().all(|link| leads(&links, link)));
    }
    for feature in features(&view(whole()), Collection::Faces) {
        let around = feature.properties["edges"].as_array().unwrap();
        assert!(around.len() >= 3 && around.iter().all(|edge| leads(&edges, edge)));
    }
}

#[test]
fn lines_lie_where_their_offset_says() {
    for feature in features(&view(whole()), Collection::Lines) {
        let angle = feature.properties["orientation"].as_f64().unwrap().to_radians();
        let offset = feature.properties["offset"].as_f64().unwrap();
        for point in feature.geometry.points() {
            let found = stillage_core::geometry::normal(angle).dot(&point.coords);
            assert!((found - offset).abs() < 1e-3, "line {}: {found} instead of {offset}", feature.id);
        }
    }
}

#[test]
fn the_bytes_are_json_and_in_metres_the_map_frame() {
    for (collection, features) in all() {
        let bytes = feature_collection(&features, &Transform::map_frame());
        let json: Value = serde_json::from_slice(&bytes).unwrap();
        assert_eq!(json["crs"]["properties"]["name"], "urn:ogc:def:crs:EPSG::3857");
        let written = json["features"].as_array().unwrap();
        assert_eq!(written.len(), features.len(), "{}", collection.id());
        for (feature, written) in features.iter().zip(written) {
            assert_eq!(serde_json::to_value(&feature.id).unwrap(), written["id"]);
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
fn the_default_coordinates_name_no_system() {
    let features = features(&view(whole()), Collection::Vertices);
    let json: Value =
        serde_json::from_slice(&feature_collection(&features, &Transform::new(Crs::Crs84, None))).unwrap();
    assert_eq!(json.get("crs"), None);
    let longitude = json["features"][0]["geometry"]["coordinates"][0].as_f64().unwrap();
    let Geometry::Point(position) = features[0].geometry else { panic!("a vertex is a point") };
    assert!((longitude - (position.x / 6_378_137.0).to_degrees()).abs() < 1e-9);
}

#[test]
fn the_table_has_a_row_for_each_location() {
    let table = String::from_utf8(locations_csv(&view(whole()))).unwrap();
    let rows: Vec<&str> = table.lines().collect();
    assert_eq!(rows.len(), whole().locations.len() + 1);
    for (row, location) in rows[1..].iter().zip(&whole().locations) {
        assert!(row.starts_with(&format!("{},", location.code)), "{row}");
    }
}
