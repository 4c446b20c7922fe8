//! Features -> `GeoPackage` 1.3, the `SQLite` file that GIS read and write.
//!
//! Source: OGC 12-128r18, with the extension "Schema" for titles and descriptions of columns. Method: a database in memory,
//! a table for each collection, then its bytes. Numbers, truths and texts are columns of their own type; lists and poses are
//! texts of JSON. A collection of areas or of paths is written as several areas or paths each, so that a table has one type
//! of shape. `fid` is the id of a feature where that is a number. Cost: O(corners + values). Limits: no spatial index, which
//! GIS make when they want one.

mod binary_geometry;
mod systems;
#[cfg(test)]
mod tests;

use rusqlite::types::Value as Cell;
use rusqlite::{Connection, MAIN_DB, Result, Transaction, params, params_from_iter};
use stillage_core::geometry::Bounds;

use crate::coordinates::Transform;
use crate::features::{Collection, CollectionSchema, Feature, FeatureId, GeometryType, Kind, Value};

/// Marks of the file (requirements 2 and 3), and the tables that tell what is in it.
const HEAD: &str = include_str!("head.sql");

/// A collection with its features.
#[derive(Debug)]
pub struct PackageLayer {
    /// The collection.
    pub collection: Collection,
    /// Its features.
    pub features: Vec<Feature>,
}

/// Collections as a file in the coordinates of the transform. `changed` is the time of the last change, ISO 8601 in UTC with
/// milliseconds.
#[must_use]
#[allow(clippy::missing_panics_doc, reason = "rows fit the tables that are made for them")]
pub fn file(layers: &[PackageLayer], transform: &Transform, changed: &str) -> Vec<u8> {
    write(layers, transform, changed).expect("a database in memory takes rows that fit its tables")
}

fn write(layers: &[PackageLayer], transform: &Transform, changed: &str) -> Result<Vec<u8>> {
    let mut database = Connection::open_in_memory()?;
    database.execute_batch(HEAD)?;
    let transaction = database.transaction()?;
    systems::insert(&transaction, transform.crs())?;
    for layer in layers {
        table(&transaction, layer, transform, changed)?;
    }
    transaction.commit()?;
    Ok(database.serialize(MAIN_DB)?.to_vec())
}

/// The table of a collection, and what the file says of it.
fn table(database: &Transaction<'_>, layer: &PackageLayer, transform: &Transform, changed: &str) -> Result<()> {
    let (name, schema) = (layer.collection.id(), CollectionSchema::of(layer.collection));
    // The last type takes all others.
    let shape = schema.geometry.last().copied().unwrap_or(GeometryType::Point);
    let shape_name = shape.name().to_uppercase();
    let columns =
        schema.properties.iter().map(|property| format!(", \"{}\" {}", property.name, sql_type(property.kind)));
    let columns: String = columns.collect();
    database.execute_batch(&format!(
        "CREATE TABLE \"{name}\" (fid INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, geom {shape_name}{columns})"
    ))?;
    let system = systems::id(transform.crs());
    let bounds = rows(database, layer, shape, transform)?;
    let bounds = (!bounds.is_empty()).then(|| [bounds.low.x, bounds.low.y, bounds.high.x, bounds.high.y]);
    let side = |index: usize| bounds.map(|bounds| bounds[index]);
    database.execute(
        "INSERT INTO gpkg_contents VALUES (?1, 'features', ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9)",
        params![name, schema.title, schema.description, changed, side(0), side(1), side(2), side(3), system],
    )?;
    database.execute(
        "INSERT INTO gpkg_geometry_columns VALUES (?1, 'geom', ?2, ?3, 0, 0)",
        params![name, shape_name, system],
    )?;
    for property in &schema.properties {
        let is_json = sql_type(property.kind) == "TEXT" && !matches!(property.kind, Kind::Text | Kind::Word(_));
        database.execute(
            "INSERT INTO gpkg_data_columns VALUES (?1, ?2, ?3, ?3, ?4, ?5, NULL)",
            params![name, property.name, property.title, property.description, is_json.then_some("application/json")],
        )?;
    }
    Ok(())
}

/// Writes the features of a collection; answers the box around them.
fn rows(
    database: &Transaction<'_>,
    layer: &PackageLayer,
    shape: GeometryType,
    transform: &Transform,
) -> Result<Bounds> {
    let properties = CollectionSchema::of(layer.collection).properties.len();
    let places = vec!["?"; properties + 2].join(", ");
    let mut insert = database.prepare(&format!("INSERT INTO \"{}\" VALUES ({places})", layer.collection.id()))?;
    let mut bounds = Bounds::EMPTY;
    for (index, feature) in layer.features.iter().enumerate() {
        let number = match feature.id {
            FeatureId::Number(number) => number as i64,
            FeatureId::Text(_) => index as i64 + 1,
        };
        let mut cells = vec![Cell::Integer(number), Cell::Null];
        if let Some(geometry) = binary_geometry::of_shape(&feature.geometry, shape, transform) {
            bounds = Bounds { low: bounds.low.inf(&geometry.bounds.low), high: bounds.high.sup(&geometry.bounds.high) };
            cells[1] = Cell::Blob(geometry.bytes);
        }
        cells.extend((0..properties).map(|property| cell(feature.row.value(property))));
        insert.execute(params_from_iter(cells))?;
    }
    Ok(bounds)
}

const fn sql_type(kind: Kind) -> &'static str {
    match kind {
        Kind::Boolean => "BOOLEAN",
        Kind::Integer => "INTEGER",
        Kind::Number => "DOUBLE",
        _ => "TEXT",
    }
}

fn cell(value: Value<'_>) -> Cell {
    match value {
        Value::Null => Cell::Null,
        Value::Boolean(truth) => Cell::Integer(truth.into()),
        Value::Integer(number) => Cell::Integer(number as i64),
        Value::Number(number) => Cell::Real(number),
        Value::Text(text) => Cell::Text(text.to_owned()),
        other => Cell::Text(serde_json::to_string(&other).expect("values are texts and finite numbers")),
    }
}
