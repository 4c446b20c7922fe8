//! Features -> JSON-FG, OGC Features and Geometries JSON 1.0 (OGC 21-045r1).
//!
//! `place` is the shape in metres: those of the map frame (an engineering system), or of the projected system that was
//! asked for. `geometry` is the same shape in degrees, so that readers of plain GeoJSON see it where it lies (profile
//! `jsonfg-plus`). No feature has a time.

use super::geojson::{self, Members};
use super::json::Json;
use crate::coordinates::Transform;
use crate::features::query::PropertySelection;
use crate::features::{Feature, Geometry};

/// The plane of a building or a site, as the OGC names it.
pub const ENGINEERING_2D: &str = "http://www.opengis.net/def/crs/OGC/0/Engineering2D";

/// The classes of requirements that a document meets.
const CONFORMS_TO: [&str; 2] = [
    "http://www.opengis.net/spec/json-fg-1/1.0/conf/core",
    "http://www.opengis.net/spec/json-fg-1/1.0/conf/types-schemas",
];

/// The two systems of a document.
#[derive(Debug, Clone, Copy)]
pub struct Systems<'a> {
    /// That of `place`.
    pub place: &'a Transform,
    /// Its URI.
    pub place_uri: &'a str,
    /// That of `geometry`: degrees.
    pub geometry: &'a Transform,
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
    systems: Systems<'_>,
    members: Members<'_>,
) -> Vec<u8> {
    let mut out = Vec::new();
    let feature_type = properties.collection().id();
    let root: [(&str, &dyn Json); 3] =
        [("conformsTo", &CONFORMS_TO), ("featureType", &feature_type), ("coordRefSys", &systems.place_uri)];
    write_feature(feature, properties, systems, &[root.as_slice(), members].concat(), &mut out);
    out.push(b'\n');
    out
}

/// A `FeatureCollection` of features with some of their properties, and with members beside those of JSON-FG, which come
/// before the features.
#[must_use]
pub fn feature_collection<'a>(
    features: impl IntoIterator<Item = &'a Feature>,
    properties: &PropertySelection,
    systems: Systems<'_>,
    members: Members<'_>,
) -> Vec<u8> {
    let feature_type = properties.collection().id();
    let root: [(&str, &dyn Json); 3] =
        [("conformsTo", &CONFORMS_TO), ("featureType", &feature_type), ("coordRefSys", &systems.place_uri)];
    let members = [root.as_slice(), members].concat();
    geojson::write_collection(features, &members, |feature, out| write_feature(feature, properties, systems, &[], out))
}

fn write_feature(
    feature: &Feature,
    properties: &PropertySelection,
    systems: Systems<'_>,
    members: Members<'_>,
    out: &mut Vec<u8>,
) {
    let place = Place { geometry: &feature.geometry, transform: systems.place };
    let own: [(&str, &dyn Json); 2] = [("time", &()), ("place", &place)];
    geojson::write_feature(feature, properties, systems.geometry, &[own.as_slice(), members].concat(), out);
}
