//! A row of either database, and its columns as values of the program.

use jiff::Timestamp;
use serde::de::DeserializeOwned;
use sqlx::Row as _;
use sqlx::sqlite::SqliteRow;
use uuid::Uuid;

use crate::records::{JobState, SemanticsOrigin, Tenant};
use crate::store::{BlobId, StoreError};

/// A row that was read.
#[derive(Debug)]
pub enum SqlRow {
    /// Of SQLite.
    Sqlite(SqliteRow),
    /// Of PostgreSQL.
    #[cfg(feature = "postgres")]
    Postgres(sqlx::postgres::PgRow),
}

impl From<SqliteRow> for SqlRow {
    fn from(row: SqliteRow) -> Self {
        Self::Sqlite(row)
    }
}

#[cfg(feature = "postgres")]
impl From<sqlx::postgres::PgRow> for SqlRow {
    fn from(row: sqlx::postgres::PgRow) -> Self {
        Self::Postgres(row)
    }
}

/// A column of a row, as the type that is asked for.
macro_rules! column {
    ($row:expr, $column:expr) => {
        match $row {
            SqlRow::Sqlite(row) => row.try_get($column)?,
            #[cfg(feature = "postgres")]
            SqlRow::Postgres(row) => row.try_get($column)?,
        }
    };
}

impl SqlRow {
    pub(super) fn text(&self, column: &'static str) -> Result<String, StoreError> {
        Ok(column!(self, column))
    }

    pub(super) fn text_if(&self, column: &str) -> Result<Option<String>, StoreError> {
        Ok(column!(self, column))
    }

    pub(super) fn real(&self, column: &str) -> Result<f64, StoreError> {
        Ok(column!(self, column))
    }

    pub(super) fn flag(&self, column: &str) -> Result<bool, StoreError> {
        Ok(column!(self, column))
    }

    pub(super) fn integer_if(&self, column: &str) -> Result<Option<i64>, StoreError> {
        Ok(column!(self, column))
    }

    pub(super) fn uuid(&self, column: &'static str) -> Result<Uuid, StoreError> {
        let value = self.text(column)?;
        Uuid::parse_str(&value).map_err(|_| StoreError::BadValue { column, value })
    }

    pub(super) fn uuid_if(&self, column: &'static str) -> Result<Option<Uuid>, StoreError> {
        self.text_if(column)?.map(|_| self.uuid(column)).transpose()
    }

    pub(super) fn time(&self, column: &'static str) -> Result<Timestamp, StoreError> {
        let value: i64 = self.whole(column)?;
        Timestamp::from_microsecond(value).map_err(|_| StoreError::BadValue { column, value: value.to_string() })
    }

    pub(super) fn time_if(&self, column: &'static str) -> Result<Option<Timestamp>, StoreError> {
        self.integer_if(column)?.map(|_| self.time(column)).transpose()
    }

    pub(super) fn whole<T: TryFrom<i64>>(&self, column: &'static str) -> Result<T, StoreError> {
        let value: i64 = column!(self, column);
        T::try_from(value).map_err(|_| StoreError::BadValue { column, value: value.to_string() })
    }

    pub(super) fn whole_if<T: TryFrom<i64>>(&self, column: &'static str) -> Result<Option<T>, StoreError> {
        self.integer_if(column)?.map(|_| self.whole(column)).transpose()
    }

    pub(super) fn json<T: DeserializeOwned>(&self, column: &'static str) -> Result<T, StoreError> {
        let value = self.text(column)?;
        serde_json::from_str(&value).map_err(|_| StoreError::BadValue { column, value })
    }

    pub(super) fn json_if<T: DeserializeOwned>(&self, column: &'static str) -> Result<Option<T>, StoreError> {
        self.text_if(column)?.map(|_| self.json(column)).transpose()
    }

    pub(super) fn blob(&self, column: &'static str) -> Result<BlobId, StoreError> {
        Ok(BlobId::from_digits(self.text(column)?))
    }

    pub(super) fn tenant(&self) -> Result<Tenant, StoreError> {
        Ok(Tenant::new(self.text("tenant")?))
    }

    pub(super) fn state(&self) -> Result<JobState, StoreError> {
        let value = self.text("state")?;
        JobState::find(&value).ok_or(StoreError::BadValue { column: "state", value })
    }

    pub(super) fn origin(&self) -> Result<SemanticsOrigin, StoreError> {
        let value = self.text("origin")?;
        SemanticsOrigin::find(&value).ok_or(StoreError::BadValue { column: "origin", value })
    }
}
