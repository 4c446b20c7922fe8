//! A deployment is moved to another database and other blobs.
//!
//! A map goes with all of its rows in one transaction, after its blobs, so that what was interrupted goes on where it ended:
//! a map that is there is there whole.

use std::collections::BTreeMap;

use sqlx::AssertSqlSafe;

use super::columns::SqlRow;
use super::database::{Database, Transaction};
use super::statement::{SqlValue, query};
use super::store::SqlStore;
use crate::store::{BlobId, Store, StoreError};

/// The tables with rows of maps, and which rows those of map `$1` are; a row comes after the rows that it names.
const OF_MAPS: [(&str, &str); 6] = [
    ("maps", "id = $1"),
    ("analyses", "map = $1"),
    ("jobs", "map = $1"),
    ("idempotency_keys", "job IN (SELECT id FROM jobs WHERE map = $1)"),
    ("correction_lists", "map = $1"),
    ("semantics_versions", "map = $1"),
];

/// The tables whose rows belong to no map.
const OF_TENANTS: [&str; 5] = ["registries", "rule_sets", "api_keys", "tenant_turns", "audit_log"];

/// The columns that say yes or no, for which SQLite has whole numbers.
const FLAGS: [&str; 2] = ["cancel_requested", "activates"];

/// What was moved.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Moved {
    /// Maps that were moved.
    pub maps: u64,
    /// Maps that were there already.
    pub maps_there: u64,
    /// Blobs that were written.
    pub blobs: u64,
    /// Blobs that were missing or damaged and stay so.
    pub damaged: Vec<BlobId>,
    /// Rows of each table, before and after.
    pub rows: BTreeMap<&'static str, (u64, u64)>,
}

/// Moves everything from one open store to another, of which nobody makes use meanwhile. After each map `tell` is told how
/// far it is.
///
/// # Errors
/// What the stores answer; the same call goes on afterwards.
pub async fn move_all(from: &SqlStore, to: &SqlStore, tell: impl Fn(&Moved)) -> Result<Moved, StoreError> {
    let mut moved = Moved::default();
    let columns = Columns::of(&from.database).await?;
    for map in query("SELECT id FROM maps ORDER BY id").fetch_all(&from.database).await? {
        let map = map.text("id")?;
        if query("SELECT 1 FROM maps WHERE id = $1").bind(&map).fetch_optional(&to.database).await?.is_some() {
            moved.maps_there += 1;
        } else {
            move_blobs(from, to, &map, &mut moved).await?;
            let mut transaction = to.database.write().await?;
            for (table, condition) in OF_MAPS {
                let sql = format!("SELECT * FROM {table} WHERE {condition}");
                let rows = query(AssertSqlSafe(sql)).bind(&map).fetch_all(&from.database).await?;
                columns.insert(&mut transaction, table, &rows).await?;
            }
            transaction.commit().await?;
            moved.maps += 1;
        }
        tell(&moved);
    }
    let mut transaction = to.database.write().await?;
    for table in OF_TENANTS {
        let rows = query(AssertSqlSafe(format!("SELECT * FROM {table}"))).fetch_all(&from.database).await?;
        columns.insert(&mut transaction, table, &rows).await?;
    }
    transaction.commit().await?;
    for table in OF_MAPS.map(|(table, _)| table).into_iter().chain(OF_TENANTS) {
        moved.rows.insert(table, (count(&from.database, table).await?, count(&to.database, table).await?));
    }
    Ok(moved)
}

async fn move_blobs(from: &SqlStore, to: &SqlStore, map: &str, moved: &mut Moved) -> Result<(), StoreError> {
    let rows = query("SELECT source AS blob FROM maps WHERE id = $1 UNION SELECT blob FROM analyses WHERE map = $1");
    for row in rows.bind(map).fetch_all(&from.database).await? {
        match from.blobs().get(&row.blob("blob")?).await {
            Ok(blob) => {
                to.blobs.put(&blob).await?;
                moved.blobs += 1;
            }
            Err(StoreError::Damaged { blob, .. }) => moved.damaged.push(blob),
            Err(error) => return Err(error),
        }
    }
    Ok(())
}

async fn count(database: &Database, table: &str) -> Result<u64, StoreError> {
    let sql = format!("SELECT count(*) AS rows FROM {table}");
    query(AssertSqlSafe(sql)).fetch_one(database).await?.whole("rows")
}

/// What a column holds.
#[derive(Debug, Clone, Copy)]
enum ColumnKind {
    Text,
    Integer,
    Real,
    Flag,
}

/// The columns of every table, with what they hold.
struct Columns(BTreeMap<&'static str, Vec<(String, ColumnKind)>>);

impl Columns {
    async fn of(database: &Database) -> Result<Self, StoreError> {
        let sql = if database.is_shared() {
            "SELECT CAST(column_name AS text) AS name, CAST(data_type AS text) AS type FROM information_schema.columns \
             WHERE table_schema = current_schema() AND table_name = $1"
        } else {
            "SELECT name, type FROM pragma_table_info($1)"
        };
        let mut columns = BTreeMap::new();
        for table in OF_MAPS.map(|(table, _)| table).into_iter().chain(OF_TENANTS) {
            let rows = query(sql).bind(table).fetch_all(database).await?;
            let column = |row: &SqlRow| Ok((row.text("name")?, kind(&row.text("name")?, &row.text("type")?)));
            columns.insert(table, rows.iter().map(column).collect::<Result<_, StoreError>>()?);
        }
        Ok(Self(columns))
    }

    /// Writes rows that were read elsewhere; those that are there stay as they are.
    async fn insert(
        &self,
        transaction: &mut Transaction,
        table: &'static str,
        rows: &[SqlRow],
    ) -> Result<(), StoreError> {
        let columns = &self.0[table];
        let names: Vec<&str> = columns.iter().map(|(name, _)| name.as_str()).collect();
        let places: Vec<String> = (1..=names.len()).map(|place| format!("${place}")).collect();
        let sql =
            format!("INSERT INTO {table} ({}) VALUES ({}) ON CONFLICT DO NOTHING", names.join(", "), places.join(", "));
        for row in rows {
            let mut insert = query(AssertSqlSafe(sql.clone()));
            for (name, kind) in columns {
                insert = insert.bind(value(row, name, *kind)?);
            }
            insert.execute(&mut *transaction).await?;
        }
        Ok(())
    }
}

fn kind(column: &str, type_name: &str) -> ColumnKind {
    match type_name {
        _ if FLAGS.contains(&column) => ColumnKind::Flag,
        "INTEGER" | "bigint" => ColumnKind::Integer,
        "REAL" | "double precision" => ColumnKind::Real,
        _ => ColumnKind::Text,
    }
}

fn value(row: &SqlRow, column: &str, kind: ColumnKind) -> Result<SqlValue, StoreError> {
    Ok(match kind {
        ColumnKind::Text => SqlValue::Text(row.text_if(column)?),
        ColumnKind::Integer => SqlValue::Integer(row.integer_if(column)?),
        ColumnKind::Real => SqlValue::Real(row.real(column)?),
        ColumnKind::Flag => SqlValue::Flag(row.flag(column)?),
    })
}
