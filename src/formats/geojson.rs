//! Features -> GeoJSON (RFC 7946).
//!
//! Coordinates are written with a fixed number of decimals and without trailing zeros, straight into the buffer: a
//! layer of 7,000 faces is some 100,000 numbers.

use serde::{Serialize, Serializer};
use stillage_core::Point;

use super::json::{self, Json};
use crate::coordinates::{Crs, Transform};
use crate::features::query::PropertySelection;
use crate::features::{Feature, FeatureId, Geometry};

/// Members of an object beside those that GeoJSON has: name and value, in the order in which they are written.
pub type Members<'a> = &'a [(&'a str, &'a dyn Json)];

/// A GeoJSON feature.
#[derive(Debug, Clone, Copy)]
pub struct GeoJsonFeature<'a> {
    /// Its id, if it has one.
    pub id: Option<&'a FeatureId>,
    /// Its shape.
    pub geometry: &'a Geometry,
    /// A JSON object.
    pub properties: &'a dyn Json,
    /// What it has beside the members of GeoJSON.
    pub members: Members<'a>,
}

/// A feature of a collection with some of its properties, and with members beside those of GeoJSON.
#[must_use]
pub fn feature(
    feature: &Feature,
    properties: &PropertySelection,
    transform: &Transform,
    members: Members<'_>,
) -> Vec<u8> {
    let mut out = Vec::new();
    write_feature(feature, properties, transform, members, &mut out);
    out.push(b'\n');
    out
}

/// A feature that belongs to no collection.
#[must_use]
pub fn document(document: &GeoJsonFeature<'_>, transform: &Transform) -> Vec<u8> {
    let mut out = Vec::new();
    write_document(document, transform, &mut out);
    out.push(b'\n');
    out
}

/// A `FeatureCollection` of features with some of their properties, and with members beside those of GeoJSON, which come
/// before the features.
#[must_use]
pub fn feature_collection<'a>(
    features: impl IntoIterator<Item = &'a Feature>,
    properties: &PropertySelection,
    transform: &Transform,
    members: Members<'_>,
) -> Vec<u8> {
    write_collection(features, members, |feature, out| write_feature(feature, properties, transform, &[], out))
}

/// A `FeatureCollection` of features that belong to no collection of the map.
#[must_use]
pub fn document_collection<'a>(
    documents: impl IntoIterator<Item = GeoJsonFeature<'a>>,
    transform: &Transform,
    members: Members<'_>,
) -> Vec<u8> {
    write_collection(documents, members, |document, out| write_document(&document, transform, out))
}

/// A `FeatureCollection` whose features are written in a way of their own.
pub(super) fn write_collection<T>(
    features: impl IntoIterator<Item = T>,
    members: Members<'_>,
    write: impl Fn(T, &mut Vec<u8>),
) -> Vec<u8> {
    let mut out = b"{\"type\":\"FeatureCollection\"".to_vec();
    for (name, value) in members {
        out.push(b',');
        json::member(name, *value, &mut out);
    }
    out.extend_from_slice(b",\"features\":");
    // A feature a line: readable, and small differences stay small.
    json::list(features, &mut out, |feature, out| {
        out.push(b'\n');
        write(feature, out);
    });
    out.extend_from_slice(b"}\n");
    out
}

/// EPSG:3857 as the `crs` member of GeoJSON 2008, which RFC 7946 dropped and GIS tools still read: for files, which no
/// header tells what their coordinates are.
pub const EPSG_3857: NamedCrs =
    NamedCrs { r#type: "name", properties: CrsProperties { name: "urn:ogc:def:crs:EPSG::3857" } };

/// A coordinate reference system by name (GeoJSON 2008, 3.1).
#[derive(Debug, Serialize)]
pub struct NamedCrs {
    r#type: &'static str,
    properties: CrsProperties,
}

#[derive(Debug, Serialize)]
struct CrsProperties {
    name: &'static str,
}

/// Some properties of a feature as an object.
#[derive(Debug)]
struct Properties<'a> {
    feature: &'a Feature,
    selection: &'a PropertySelection,
}

impl Serialize for Properties<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.selection.values(self.feature).map(|(property, value)| (property.name, value)))
    }
}

pub(super) fn write_feature(
    feature: &Feature,
    selection: &PropertySelection,
    transform: &Transform,
    members: Members<'_>,
    out: &mut Vec<u8>,
) {
    let properties = Properties { feature, selection };
    let document =
        GeoJsonFeature { id: Some(&feature.id), geometry: &feature.geometry, properties: &properties, members };
    write_document(&document, transform, out);
}

fn write_document(document: &GeoJsonFeature<'_>, transform: &Transform, out: &mut Vec<u8>) {
    out.extend_from_slice(b"{\"type\":\"Feature\",");
    if let Some(id) = document.id {
        json::member("id", id, out);
        out.push(b',');
    }
    out.extend_from_slice(b"\"geometry\":");
    write_geometry(document.geometry, transform, out);
    out.push(b',');
    json::member("properties", document.properties, out);
    for (name, value) in document.members {
        out.push(b',');
        json::member(name, *value, out);
    }
    out.push(b'}');
}

pub(super) fn write_geometry(geometry: &Geometry, transform: &Transform, out: &mut Vec<u8>) {
    out.extend_from_slice(b"{\"type\":\"");
    out.extend_from_slice(geometry.geometry_type().name().as_bytes());
    out.extend_from_slice(b"\",\"coordinates\":");
    let path = |path: &Vec<Point>, out: &mut Vec<u8>| write_positions(path, transform, out);
    // A ring ends with the position with which it begins.
    let ring = |ring: &Vec<Point>, out: &mut Vec<u8>| write_positions(ring.iter().chain(ring.first()), transform, out);
    match geometry {
        Geometry::Point(point) => write_position(*point, transform, out),
        Geometry::LineString(points) => path(points, out),
        Geometry::MultiLineString(paths) => json::list(paths, out, path),
        Geometry::Polygon(rings) => json::list(rings, out, ring),
        Geometry::MultiPolygon(polygons) => json::list(polygons, out, |rings, out| json::list(rings, out, ring)),
    }
    out.push(b'}');
}

fn write_positions<'a>(points: impl IntoIterator<Item = &'a Point>, transform: &Transform, out: &mut Vec<u8>) {
    json::list(points, out, |point, out| write_position(*point, transform, out));
}

fn write_position(point: Point, transform: &Transform, out: &mut Vec<u8>) {
    json::list(transform.forward(point), out, |number, out| json::decimal(number, decimals(transform.crs()), out));
}

/// Decimals worth writing: nine of a degree and four of a metre are a tenth of a millimetre.
pub(super) const fn decimals(crs: Crs) -> u32 {
    match crs {
        Crs::Crs84 => 9,
        Crs::WebMercator | Crs::Utm(_) => 4,
    }
}
