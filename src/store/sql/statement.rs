//! One statement in the words that both databases understand, with its parameters.

use sqlx::sqlite::SqliteArguments;
use sqlx::{SqlSafeStr, SqlStr, Sqlite};

use super::columns::SqlRow;
use super::database::{Database, Transaction};
use crate::store::StoreError;
#[cfg(feature = "postgres")]
use crate::store::postgres::in_time;

/// A parameter.
#[derive(Debug)]
pub enum SqlValue {
    /// Text, or nothing.
    Text(Option<String>),
    /// A whole number or a time, or nothing.
    Integer(Option<i64>),
    /// A number.
    Real(f64),
    /// Yes or no.
    Flag(bool),
}

macro_rules! values_from {
    ($($type:ty => $value:expr,)*) => {
        $(impl From<$type> for SqlValue {
            fn from(value: $type) -> Self {
                $value(value)
            }
        })*
    };
}

values_from! {
    &str => |value: &str| Self::Text(Some(value.to_owned())),
    &String => |value: &String| Self::Text(Some(value.clone())),
    &Option<String> => |value: &Option<String>| Self::Text(value.clone()),
    String => |value| Self::Text(Some(value)),
    Option<String> => Self::Text,
    u8 => |value| Self::Integer(Some(i64::from(value))),
    u32 => |value| Self::Integer(Some(i64::from(value))),
    i64 => |value| Self::Integer(Some(value)),
    Option<u32> => |value: Option<u32>| Self::Integer(value.map(i64::from)),
    Option<i64> => Self::Integer,
    f64 => Self::Real,
    bool => Self::Flag,
}

/// A statement to be run.
#[derive(Debug)]
pub struct Statement {
    sql: SqlStr,
    values: Vec<SqlValue>,
}

/// Where a statement runs: by itself, reading, or as a part of a transaction.
#[derive(Debug)]
pub enum RunsOn<'a> {
    /// By itself. SQLite's connections for reading refuse to write.
    Alone(&'a Database),
    /// In a transaction.
    Within(&'a mut Transaction),
}

impl<'a> From<&'a Database> for RunsOn<'a> {
    fn from(database: &'a Database) -> Self {
        Self::Alone(database)
    }
}

impl<'a> From<&'a mut Transaction> for RunsOn<'a> {
    fn from(transaction: &'a mut Transaction) -> Self {
        Self::Within(transaction)
    }
}

/// Runs a statement on whatever its place is, and converts what came of it.
macro_rules! run {
    ($statement:expr, $place:expr, $method:ident, $convert:expr) => {
        match $place.into() {
            RunsOn::Alone(Database::Sqlite(engine)) => {
                $convert($statement.for_sqlite().$method(&engine.readers).await?)
            }
            RunsOn::Within(Transaction::Sqlite { transaction, .. }) => {
                $convert($statement.for_sqlite().$method(&mut **transaction).await?)
            }
            #[cfg(feature = "postgres")]
            RunsOn::Alone(Database::Postgres(engine)) => {
                $convert(in_time($statement.for_postgres().$method(&engine.pool)).await?)
            }
            #[cfg(feature = "postgres")]
            RunsOn::Within(Transaction::Postgres(transaction)) => {
                $convert(in_time($statement.for_postgres().$method(&mut **transaction)).await?)
            }
        }
    };
}

/// The text of a statement on the rows that no other transaction holds: `before`, the words for that, `after`. SQLite has no
/// such words, because its writers are alone.
macro_rules! of_free_rows {
    ($transaction:expr, $before:literal, $after:literal) => {
        if $transaction.is_alone() {
            concat!($before, $after)
        } else {
            concat!($before, " FOR UPDATE SKIP LOCKED", $after)
        }
    };
}
pub(super) use of_free_rows;

/// A statement without parameters so far.
pub fn query(sql: impl SqlSafeStr) -> Statement {
    Statement { sql: sql.into_sql_str(), values: Vec::new() }
}

impl Statement {
    /// Adds the next parameter.
    pub fn bind(mut self, value: impl Into<SqlValue>) -> Self {
        self.values.push(value.into());
        self
    }

    /// All rows that it answers.
    pub async fn fetch_all<'a>(self, place: impl Into<RunsOn<'a>>) -> Result<Vec<SqlRow>, StoreError> {
        Ok(run!(self, place, fetch_all, |rows: Vec<_>| rows.into_iter().map(SqlRow::from).collect()))
    }

    /// The first row that it answers.
    pub async fn fetch_optional<'a>(self, place: impl Into<RunsOn<'a>>) -> Result<Option<SqlRow>, StoreError> {
        Ok(run!(self, place, fetch_optional, |row: Option<_>| row.map(SqlRow::from)))
    }

    /// The row that it always answers.
    pub async fn fetch_one<'a>(self, place: impl Into<RunsOn<'a>>) -> Result<SqlRow, StoreError> {
        Ok(run!(self, place, fetch_one, SqlRow::from))
    }

    /// How many rows it changed.
    pub async fn execute<'a>(self, place: impl Into<RunsOn<'a>>) -> Result<u64, StoreError> {
        Ok(run!(self, place, execute, Changed::count))
    }

    fn for_sqlite(self) -> sqlx::query::Query<'static, Sqlite, SqliteArguments> {
        self.values.into_iter().fold(sqlx::query(self.sql), |query, value| match value {
            SqlValue::Text(value) => query.bind(value),
            SqlValue::Integer(value) => query.bind(value),
            SqlValue::Real(value) => query.bind(value),
            SqlValue::Flag(value) => query.bind(value),
        })
    }

    #[cfg(feature = "postgres")]
    fn for_postgres(self) -> sqlx::query::Query<'static, sqlx::Postgres, sqlx::postgres::PgArguments> {
        self.values.into_iter().fold(sqlx::query(self.sql), |query, value| match value {
            SqlValue::Text(value) => query.bind(value),
            SqlValue::Integer(value) => query.bind(value),
            SqlValue::Real(value) => query.bind(value),
            SqlValue::Flag(value) => query.bind(value),
        })
    }
}

/// What a statement without rows answers.
trait Changed {
    /// How many rows it changed.
    fn count(self) -> u64;
}

impl Changed for sqlx::sqlite::SqliteQueryResult {
    fn count(self) -> u64 {
        self.rows_affected()
    }
}

#[cfg(feature = "postgres")]
impl Changed for sqlx::postgres::PgQueryResult {
    fn count(self) -> u64 {
        self.rows_affected()
    }
}
