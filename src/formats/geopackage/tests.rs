//! Files as their readers take them apart.

use rusqlite::types::Value as Cell;
use stillage_core::Point;

use super::*;
use crate::coordinates::{Crs, Georeference};
use crate::features::Geometry;
use crate::features::tests::all;

/// The hall in a file, opened again.
fn opened(transform: &Transform) -> Connection {
    let layers: Vec<PackageLayer> = all().map(|(collection, features)| PackageLayer { collection, features }).collect();
    let bytes = file(&layers, transform, "2026-01-15T08:00:00.000Z");
    assert_eq!(&bytes[68..72], b"GPKG", "the application id of the file");
    let mut database = Connection::open_in_memory().unwrap();
    database.deserialize_read_exact(MAIN_DB, bytes.as_slice(), bytes.len(), true).unwrap();
    database
}

#[test]
fn each_collection_is_a_table_with_all_its_features() {
    let database = opened(&Transform::map_frame());
    let one = |sql: &str| database.query_row(sql, [], |row| row.get::<_, Cell>(0)).unwrap();
    assert_eq!(one("PRAGMA integrity_check"), Cell::Text("ok".into()));
    assert!(database.prepare("PRAGMA foreign_key_check").unwrap().query([]).unwrap().next().unwrap().is_none());
    for (collection, features) in all() {
        let name = collection.id();
        assert_eq!(one(&format!("SELECT count(*) FROM \"{name}\"")), Cell::Integer(features.len() as i64), "{name}");
        let shapes = format!("SELECT count(*) FROM \"{name}\" WHERE substr(geom, 1, 2) = CAST('GP' AS BLOB)");
        assert_eq!(one(&shapes), Cell::Integer(features.len() as i64), "{name}");
        let system = one(&format!("SELECT srs_id FROM gpkg_contents WHERE table_name = '{name}'"));
        assert_eq!(system, Cell::Integer(3857));
        let columns = one(&format!("SELECT count(*) FROM gpkg_data_columns WHERE table_name = '{name}'"));
        assert_eq!(columns, Cell::Integer(CollectionSchema::of(collection).properties.len() as i64));
    }
    assert_eq!(one("SELECT label FROM faces WHERE fid = 1"), one("SELECT label FROM faces WHERE id = 1"));
    assert_eq!(one("SELECT typeof(edges) FROM faces WHERE fid = 1"), Cell::Text("text".into()));
}

#[test]
fn a_shape_is_a_box_and_well_known_binary() {
    let point = Geometry::Point(Point::new(1.5, -2.0));
    let blob = binary_geometry::of_shape(&point, GeometryType::Point, &Transform::map_frame()).unwrap().bytes;
    let doubles = |from: usize, to: usize| -> Vec<f64> {
        blob[from..to].chunks_exact(8).map(|bytes| f64::from_le_bytes(bytes.try_into().unwrap())).collect()
    };
    assert_eq!((&blob[..4], &blob[4..8]), (b"GP\0\x03".as_slice(), 3857_u32.to_le_bytes().as_slice()));
    assert_eq!(doubles(8, 40), [1.5, 1.5, -2.0, -2.0]);
    assert_eq!((blob[40], &blob[41..45]), (1, 1_u32.to_le_bytes().as_slice()));
    assert_eq!(doubles(45, 61), [1.5, -2.0]);
    let ring = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0)].map(|(x, y)| Point::new(x, y)).to_vec();
    let area = Geometry::Polygon(vec![ring]);
    let alone = binary_geometry::of_shape(&area, GeometryType::Polygon, &Transform::map_frame()).unwrap().bytes;
    let several = binary_geometry::of_shape(&area, GeometryType::MultiPolygon, &Transform::map_frame()).unwrap().bytes;
    assert_eq!(alone.len(), 40 + 5 + 4 + 4 + 4 * 16, "closed");
    assert_eq!((several[41], several.len() - alone.len(), &several[49..]), (6, 9, &alone[40..]));
    let nowhere = Geometry::Polygon(Vec::new());
    assert!(binary_geometry::of_shape(&nowhere, GeometryType::Polygon, &Transform::map_frame()).is_none());
}

#[test]
fn a_georeferenced_map_is_in_the_metres_of_its_zone() {
    let georeference = Georeference { lon: 12.8, lat: -56.6, heading: 30.0 };
    let crs = Crs::of_map(Some(georeference)).pop().unwrap();
    let database = opened(&Transform::new(crs, Some(georeference)));
    let [name, definition] = ["srs_name", "definition"].map(|column| {
        let sql = format!("SELECT {column} FROM gpkg_spatial_ref_sys WHERE srs_id = 32733");
        database.query_row(&sql, [], |row| row.get::<_, String>(0)).unwrap()
    });
    assert_eq!(name, "WGS 84 / UTM zone 33S");
    assert!(definition.contains("PARAMETER[\"central_meridian\",15]"), "{definition}");
    assert_eq!(definition.matches('[').count(), definition.matches(']').count());
    let low: f64 = database.query_row("SELECT min_y FROM gpkg_contents", [], |row| row.get(0)).unwrap();
    assert!((3_000_000.0..4_000_000.0).contains(&low), "metres from a false northing: {low}");
}
