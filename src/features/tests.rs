//! The collections of a whole map: a small hall with racks, turned and moved in its map frame.

use std::sync::OnceLock;

use expect_test::expect;
use stillage_core::geometry::{Point, ring_area};
use stillage_core::layout::{self, Layout, LayoutSpec};
use stillage_core::semantics::{self, Assignment, RuleSet, SemanticMap};
use stillage_core::watch::Watch;
use stillage_core::{Analysis, AnalysisOptions, GridFrame, Occupancy, OccupancyGrid, SiteCells};

use super::query::PropertySelection;
use super::*;

/// A hall of 24 x 16 m with double rows of racks and an office in a corner, at 0.1 m, turned by 0.3 radians.
pub(crate) fn hall() -> OccupancyGrid {
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
    layout: Layout,
}

/// Analysed once for all tests.
fn whole() -> &'static Whole {
    static WHOLE: OnceLock<Whole> = OnceLock::new();
    WHOLE.get_or_init(|| {
        let mut options = AnalysisOptions::default();
        options.categorization.stride = 4;
        options.categorization.beams = 60;
        let spec = options.check().unwrap();
        let grid = hall();
        let analysis = stillage_core::analyze(&grid, &spec, &Watch::unwatched()).unwrap();
        let rule_set = RuleSet::warehouse();
        let label =
            |suggestion: semantics::Suggestion| (suggestion.category, rule_set.label(suggestion.label).id.clone());
        let assignment = semantics::suggest(&analysis, &rule_set).into_iter().map(label).collect();
        let assignment = Assignment { assignment, ..Assignment::default() };
        let semantic = semantics::apply(&analysis, &rule_set, &assignment).unwrap();
        let cells = SiteCells::of(&grid, &analysis);
        let layout = layout::layout(&cells.map(&grid, &analysis, &semantic), &LayoutSpec::of(&analysis.options));
        Whole { analysis, semantic, layout }
    })
}

/// The hall, analysed.
pub(crate) fn hall_view() -> AnalysedMap<'static> {
    let whole = whole();
    AnalysedMap { analysis: &whole.analysis, semantic: &whole.semantic, layout: &whole.layout, names: MapNames::none() }
}

/// Every collection of the hall.
pub(crate) fn all() -> impl Iterator<Item = (Collection, Vec<Feature>)> {
    Collection::ALL.into_iter().map(|collection| (collection, features(&hall_view(), collection)))
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

/// A property that is a number.
fn number(feature: &Feature, name: &str) -> Option<f64> {
    match feature.property(name)? {
        Value::Number(number) => Some(number),
        _ => None,
    }
}

#[test]
fn each_collection_has_its_properties() {
    let lists: Vec<String> = all()
        .map(|(collection, features)| {
            let first = features.first().unwrap_or_else(|| panic!("no {}", collection.id()));
            let names: Vec<&str> =
                PropertySelection::all(collection).properties().map(|property| property.name).collect();
            format!("{} ({}): {}\n", collection.id(), first.geometry.geometry_type().name(), names.join(", "))
        })
        .collect();
    expect![[r#"
        faces (Polygon): id, category, categoryShares, membership, label, labelName, functionality, confidence, evidence, areaM2, lengthM, widthM, orientation, elongation, freeFraction, occupiedFraction, unknownFraction, region, edges, place, location, name
        edges (LineString): id, faceLeft, faceRight, cogency, lengthM, support, open, confidence, evidence, disagreement, link, orientation, line
        vertices (Point): id, edges
        nodes (Point): id, face, label, degree
        links (LineString): id, from, to, connectivity, drivable, edge
        lines (LineString): id, orientation, offset, support, region
        regions (Polygon): id, orientations, share, box
        places (Polygon): id, name, groups, label, labelName, functionality, areaM2, room, faces
        doors (LineString): id, widthM, from, to, links
        locations (Polygon): code, name, groups, stale, face, part, parts, label, labelName, aisle, bay, row, depthInRow, side, centre, widthM, depthM, headingDeg, areaM2, occupancy, occupiedFraction, occupancyConfidence, accessEdges, accessFrom, corridor, approach
        aisles (LineString): id, name, groups, lengthM, widthM, headingDeg, place, left, right
        rows (LineString): id, name, groups, aisle, side, lengthM, depthM, layers, locations
    "#]].assert_eq(&lists.concat());
}

#[test]
fn ids_ascend() {
    for (collection, features) in all() {
        assert!(features.is_sorted_by(|first, second| first.id < second.id), "{}", collection.id());
    }
}

#[test]
fn values_are_what_the_schema_says() {
    for (collection, features) in all() {
        for feature in &features {
            for (property, value) in PropertySelection::all(collection).values(feature) {
                let name = property.name;
                let word = |word: &str, words: &[&str]| words.contains(&word);
                let fits = match (value, property.kind) {
                    (Value::Null, _) => property.nullable,
                    (Value::Boolean(_), Kind::Boolean)
                    | (Value::Integer(_), Kind::Integer)
                    | (Value::Number(_), Kind::Number)
                    | (Value::Text(_), Kind::Text)
                    | (Value::Texts(_), Kind::Texts)
                    | (Value::Integers(_), Kind::Integers)
                    | (Value::Numbers(_), Kind::Numbers)
                    | (Value::Position(_), Kind::Position)
                    | (Value::Pose(_), Kind::Pose)
                    | (Value::Box(_), Kind::Box) => true,
                    (Value::Text(text), Kind::Word(words)) => word(text, words),
                    (Value::Words(texts), Kind::Words(words)) => texts.iter().all(|text| word(text, words)),
                    _ => false,
                };
                assert!(fits, "{} {}: {name} is {value:?}", collection.id(), feature.id);
            }
            assert!(CollectionSchema::of(collection).geometry.contains(&feature.geometry.geometry_type()));
        }
    }
}

#[test]
fn names_follow_one_style_and_occur_once() {
    for collection in Collection::ALL {
        let CollectionSchema { title, description, properties, .. } = CollectionSchema::of(collection);
        assert!(!title.is_empty() && !description.is_empty());
        for (index, property) in properties.iter().enumerate() {
            let name = property.name;
            assert!(name.starts_with(|first: char| first.is_ascii_lowercase()), "{name}");
            assert!(name.chars().all(|character| character.is_ascii_alphanumeric()), "{name}");
            assert_eq!(CollectionSchema::of(collection).find(name), Some(index), "{name} occurs twice");
            // The unit stands in the name where users would otherwise have to guess it.
            assert!(!name.ends_with('M') || property.unit == Some("m"), "{name}");
            assert!(!name.ends_with("Deg") || property.unit == Some("deg"), "{name}");
        }
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
            if let Some(stated) = number(feature, "areaM2") {
                assert!((area(feature) - stated).abs() < 1e-3, "{} {}", collection.id(), feature.id);
            }
        }
    }
}

#[test]
fn places_and_regions_cover_what_the_faces_cover() {
    let total = |collection| features(&hall_view(), collection).iter().map(area).sum::<f64>();
    let faces = total(Collection::Faces);
    // Faces that nobody identified belong to no place, unless they are a room.
    let is_placed = |feature: &&Feature| feature.property("place").is_some_and(|place| !place.is_null());
    let placed: f64 = features(&hall_view(), Collection::Faces).iter().filter(is_placed).map(area).sum();
    assert!((total(Collection::Places) - placed).abs() < 1e-6);
    assert!((total(Collection::Regions) - faces).abs() < 1e-6);
}

#[test]
fn references_lead_to_features() {
    let refers = |from: Collection, property: &str, to: Collection| {
        let targets: Vec<FeatureId> = features(&hall_view(), to).into_iter().map(|feature| feature.id).collect();
        for feature in features(&hall_view(), from) {
            let ids: Vec<FeatureId> = match feature.property(property).unwrap() {
                Value::Null => Vec::new(),
                Value::Integer(id) => vec![FeatureId::Number(id)],
                Value::Integers(ids) => ids.iter().map(|&id| FeatureId::Number(id.into())).collect(),
                Value::Text(code) => vec![FeatureId::Text(code.to_owned())],
                other => panic!("{other:?} refers to nothing"),
            };
            assert!(ids.iter().all(|id| targets.contains(id)), "{} {}: {property}", from.id(), feature.id);
        }
    };
    refers(Collection::Faces, "edges", Collection::Edges);
    refers(Collection::Faces, "place", Collection::Places);
    refers(Collection::Faces, "location", Collection::Locations);
    refers(Collection::Faces, "region", Collection::Regions);
    refers(Collection::Edges, "faceLeft", Collection::Faces);
    refers(Collection::Edges, "faceRight", Collection::Faces);
    refers(Collection::Edges, "link", Collection::Links);
    refers(Collection::Edges, "line", Collection::Lines);
    refers(Collection::Vertices, "edges", Collection::Edges);
    refers(Collection::Nodes, "face", Collection::Faces);
    refers(Collection::Links, "from", Collection::Nodes);
    refers(Collection::Links, "to", Collection::Nodes);
    refers(Collection::Links, "edge", Collection::Edges);
    refers(Collection::Lines, "region", Collection::Regions);
    refers(Collection::Places, "faces", Collection::Faces);
    refers(Collection::Doors, "from", Collection::Places);
    refers(Collection::Doors, "to", Collection::Places);
    refers(Collection::Doors, "links", Collection::Links);
    refers(Collection::Locations, "face", Collection::Faces);
    refers(Collection::Locations, "accessEdges", Collection::Edges);
    refers(Collection::Locations, "accessFrom", Collection::Faces);
}

#[test]
fn lines_lie_where_their_offset_says() {
    for feature in features(&hall_view(), Collection::Lines) {
        let [angle, offset] = ["orientation", "offset"].map(|name| number(&feature, name).unwrap());
        for point in feature.geometry.points() {
            let found = stillage_core::geometry::normal(angle.to_radians()).dot(&point.coords);
            assert!((found - offset).abs() < 1e-3, "line {}: {found} instead of {offset}", feature.id);
        }
    }
}
