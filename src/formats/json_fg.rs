//! Features -> JSON-FG, OGC Features and Geometries JSON 1.0 (OGC 21-045r1).
//!
//! `place` is the shape in metres: those of the map frame (an engineering system), or of the projected system that was
//! asked for. `geometry` is the same shape in degrees, so that readers of plain GeoJSON see it where it lies (profile
//! `jsonfg-plus`). No feature has a time.

use super::geojson::{self, Members};
use super::json::Json;
use crate::coordinates::Transform;
use crate::features::query::PropertySelection;
use crate::features::{CollectionSchema, Feature, Geometry, GeometryType};

/// The plane of a building or a site, as the OGC names it.
pub const ENGINEERING_2D: &str = "http://www.opengis.net/def/crs/OGC/0/Engineering2D";

/// The classes of requirements that a document meets.
const CONFORMS_TO: [&str; 3] = [
    "http://www.opengis.net/spec/json-fg-1/1.0/conf/core",
    "http://www.opengis.net/spec/json-fg-1/1.0/conf/types-schemas",
    "http://www.opengis.net/spec/json-fg-1/1.0/conf/profiles",
];

/// What is said of a document as a whole.
#[derive(Debug, Clone, Copy)]
pub struct JsonFgDocument<'a> {
    /// To the system of `place`.
    pub place: &'a Transform,
    /// The URI of that system.
    pub place_uri: &'a str,
    /// To the system of `geometry`: degrees.
    pub geometry: &'a Transform,
    /// Where the schema of the features is, if they have all that it asks for.
    pub schema: Option<&'a str>,
}

/// A shape in the system of `place`.
#[derive(Debug)]
struct Place<'a> {
    geometry: &'a Geometry,
    transform: &'a Transform,
}

impl Json for Place<'_> {
    fn write(&self, out: &mut Vec<u8>) {
        geojson::write_geometry(self.geometry, self.transform, out);
    }
}

/// A feature with some of its properties, and with members beside those of JSON-FG.
#[must_use]
pub fn feature(
    feature: &Feature,
    properties: &PropertySelection,
    document: JsonFgDocument<'_>,
    members: Members<'_>,
) -> Vec<u8> {
    let mut out = Vec::new();
    with_root(properties, document, &[], members, |members| {
        write_feature(feature, properties, document, members, &mut out);
    });
    out.push(b'\n');
    out
}

/// A `FeatureCollection` of features with some of their properties, and with members beside those of JSON-FG, which come
/// before the features.
#[must_use]
pub fn feature_collection<'a>(
    features: impl IntoIterator<Item = &'a Feature>,
    properties: &PropertySelection,
    document: JsonFgDocument<'_>,
    members: Members<'_>,
) -> Vec<u8> {
    let dimension = dimension(CollectionSchema::of(properties.collection()).geometry);
    with_root(properties, document, &[("geometryDimension", &dimension)], members, |members| {
        geojson::write_collection(features, members, |feature, out| {
            write_feature(feature, properties, document, &[], out);
        })
    })
}

/// Writes a root object: its members of JSON-FG come before the others.
fn with_root<T>(
    properties: &PropertySelection,
    document: JsonFgDocument<'_>,
    more: Members<'_>,
    members: Members<'_>,
    write: impl FnOnce(Members<'_>) -> T,
) -> T {
    let feature_type = properties.collection().id();
    let mut root: Vec<(&str, &dyn Json)> = vec![("conformsTo", &CONFORMS_TO), ("featureType", &feature_type)];
    if let Some(schema) = &document.schema {
        root.push(("featureSchema", schema));
    }
    root.push(("coordRefSys", &document.place_uri));
    write(&[root.as_slice(), more, members].concat())
}

/// 0 of points, 1 of paths, 2 of areas.
fn dimension(types: &[GeometryType]) -> u8 {
    match types.first() {
        Some(GeometryType::Polygon | GeometryType::MultiPolygon) => 2,
        Some(GeometryType::LineString | GeometryType::MultiLineString) => 1,
        Some(GeometryType::Point) | None => 0,
    }
}

fn write_feature(
    feature: &Feature,
    properties: &PropertySelection,
    document: JsonFgDocument<'_>,
    members: Members<'_>,
    out: &mut Vec<u8>,
) {
    let place = Place { geometry: &feature.geometry, transform: document.place };
    let own: [(&str, &dyn Json); 2] = [("time", &()), ("place", &place)];
    geojson::write_feature(feature, properties, document.geometry, &[own.as_slice(), members].concat(), out);
}
