//! The data that comes with the abstract test suite of the standard: a `GeoPackage` of countries, places and rivers.

use std::borrow::Cow;
use std::path::Path;

use geo::{BoundingRect as _, Coord, Geometry, LineString, MultiPolygon, Point, Polygon, Rect};
use sqlx::sqlite::{SqliteConnectOptions, SqliteConnection, SqliteRow};
use sqlx::{ConnectOptions as _, Row as _};

use crate::cql2::{FilterValue, Filterable, Instant, Located, Queryable, ValueType};

/// A table with the columns that the test suite asks of.
pub struct StandardTable {
    pub name: &'static str,
    pub columns: &'static [Queryable<'static>],
    pub rows: Vec<StandardRow>,
}

/// A row: the values of its columns.
#[derive(Debug)]
pub struct StandardRow(Vec<StandardValue>);

#[derive(Debug)]
enum StandardValue {
    Null,
    Boolean(bool),
    Number(f64),
    Text(String),
    Instant(Instant),
    Geometry(StandardShape),
}

#[derive(Debug)]
struct StandardShape(Geometry);

impl Located for StandardShape {
    fn bounds(&self) -> Rect {
        self.0.bounding_rect().expect("no shape of the data is empty")
    }

    fn shape(&self) -> Cow<'_, Geometry> {
        Cow::Borrowed(&self.0)
    }
}

impl Filterable for StandardRow {
    fn value(&self, queryable: usize) -> FilterValue<'_> {
        match &self.0[queryable] {
            StandardValue::Null => FilterValue::Null,
            StandardValue::Boolean(value) => FilterValue::Boolean(*value),
            StandardValue::Number(number) => FilterValue::Number(*number),
            StandardValue::Text(text) => FilterValue::Text(Cow::Borrowed(text)),
            StandardValue::Instant(instant) => FilterValue::Instant(*instant),
            StandardValue::Geometry(shape) => FilterValue::Geometry(shape),
        }
    }
}

const fn column(name: &'static str, value_type: ValueType) -> Queryable<'static> {
    Queryable { name, value_type }
}

const COUNTRIES: &[Queryable<'static>] =
    &[column("geom", ValueType::Geometry), column("NAME", ValueType::Text), column("POP_EST", ValueType::Number)];

const PLACES: &[Queryable<'static>] = &[
    column("geom", ValueType::Geometry),
    column("name", ValueType::Text),
    column("nameascii", ValueType::Text),
    column("pop_min", ValueType::Number),
    column("pop_max", ValueType::Number),
    column("pop_other", ValueType::Number),
    column("date", ValueType::Instant),
    column("start", ValueType::Instant),
    column("end", ValueType::Instant),
    column("boolean", ValueType::Boolean),
];

const RIVERS: &[Queryable<'static>] = &[column("geom", ValueType::Geometry)];

const TABLES: [(&str, &[Queryable<'static>]); 3] = [
    ("ne_110m_admin_0_countries", COUNTRIES),
    ("ne_110m_populated_places_simple", PLACES),
    ("ne_110m_rivers_lake_centerlines", RIVERS),
];

/// Reads the tables.
pub async fn read(file: &Path) -> Vec<StandardTable> {
    let options = SqliteConnectOptions::new().filename(file).read_only(true).immutable(true);
    let mut connection = options.connect().await.unwrap();
    let mut tables = Vec::new();
    for (name, columns) in TABLES {
        tables.push(StandardTable { name, columns, rows: rows(&mut connection, name, columns).await });
    }
    tables
}

async fn rows(connection: &mut SqliteConnection, table: &str, columns: &[Queryable<'_>]) -> Vec<StandardRow> {
    let names: Vec<String> = columns.iter().map(|column| format!("\"{}\"", column.name)).collect();
    let query = format!("SELECT {} FROM \"{table}\"", names.join(", "));
    let rows = sqlx::query(sqlx::AssertSqlSafe(query)).fetch_all(connection).await.unwrap();
    rows.iter().map(|row| StandardRow(columns.iter().map(|column| value(row, column)).collect())).collect()
}

fn value(row: &SqliteRow, column: &Queryable<'_>) -> StandardValue {
    let name = column.name;
    let value = match column.value_type {
        ValueType::Geometry => row.get::<Option<Vec<u8>>, _>(name).map(|blob| StandardValue::Geometry(shape(&blob))),
        ValueType::Text => row.get::<Option<String>, _>(name).map(StandardValue::Text),
        ValueType::Boolean => row.get::<Option<bool>, _>(name).map(StandardValue::Boolean),
        ValueType::Instant => row.get_unchecked::<Option<String>, _>(name).map(|text| {
            // The moments are UTC without saying so.
            let instant = Instant::date(&text).or_else(|_| Instant::timestamp(&format!("{text}Z")));
            StandardValue::Instant(instant.unwrap())
        }),
        _ => row.get_unchecked::<Option<f64>, _>(name).map(StandardValue::Number),
    };
    value.unwrap_or(StandardValue::Null)
}

/// A geometry of a `GeoPackage` (OGC 12-128r18, 2.1.3): a header and little-endian Well-Known Binary.
fn shape(blob: &[u8]) -> StandardShape {
    let envelope_bytes = [0, 32, 48, 48, 64][usize::from(blob[3] >> 1 & 7)];
    StandardShape(Wkb(&blob[8 + envelope_bytes..]).geometry())
}

struct Wkb<'a>(&'a [u8]);

impl Wkb<'_> {
    fn take<const N: usize>(&mut self) -> [u8; N] {
        let (bytes, rest) = self.0.split_first_chunk().expect("the geometry is whole");
        self.0 = rest;
        *bytes
    }

    fn count(&mut self) -> u32 {
        u32::from_le_bytes(self.take())
    }

    fn position(&mut self) -> Coord {
        let [x, y] = [self.take(), self.take()].map(f64::from_le_bytes);
        Coord { x, y }
    }

    fn path(&mut self) -> LineString {
        (0..self.count()).map(|_| self.position()).collect()
    }

    fn geometry(&mut self) -> Geometry {
        let [byte_order] = self.take();
        assert_eq!(byte_order, 1, "the data is little-endian");
        match self.count() {
            1 => Point(self.position()).into(),
            2 => self.path().into(),
            3 => {
                let mut rings: Vec<LineString> = (0..self.count()).map(|_| self.path()).collect();
                let outer = rings.remove(0);
                Polygon::new(outer, rings).into()
            }
            6 => {
                let polygons = (0..self.count()).map(|_| Polygon::try_from(self.geometry()).expect("a polygon"));
                MultiPolygon(polygons.collect()).into()
            }
            other => unreachable!("the data has no geometry of type {other}"),
        }
    }
}
