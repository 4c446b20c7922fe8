//! What errors of the databases mean.

use sqlx::error::DatabaseError;
use sqlx::sqlite::SqliteError;

use super::StoreError;
use super::process_counts::count_busy_call;

impl From<sqlx::Error> for StoreError {
    fn from(error: sqlx::Error) -> Self {
        let error = Self::of(error);
        if matches!(error, Self::Busy) {
            count_busy_call();
        }
        error
    }
}

impl StoreError {
    fn of(error: sqlx::Error) -> Self {
        match &error {
            // The server is gone, or starts; a proxy before it closes connections instead of answering. SQLite's disk errors
            // come as errors of the database.
            sqlx::Error::Io(_)
            | sqlx::Error::Protocol(_)
            | sqlx::Error::Tls(_)
            | sqlx::Error::PoolTimedOut
            | sqlx::Error::PoolClosed => Self::Busy,
            sqlx::Error::Database(fault) => match meaning(&**fault) {
                Meaning::Busy => Self::Busy,
                Meaning::Full => Self::NoSpace,
                Meaning::Other => Self::Database(error),
            },
            _ => Self::Database(error),
        }
    }
}

/// What an error of a database means to whoever asked.
enum Meaning {
    /// The same may succeed a moment later.
    Busy,
    /// There is no room.
    Full,
    /// Something that nobody expects.
    Other,
}

fn meaning(fault: &dyn DatabaseError) -> Meaning {
    let code = fault.code().unwrap_or_default();
    if fault.try_downcast_ref::<SqliteError>().is_some() { of_sqlite(&code) } else { of_postgres(&code) }
}

/// Primary result codes are the low byte: <https://sqlite.org/rescode.html>
fn of_sqlite(code: &str) -> Meaning {
    match code.parse::<i64>().map(|code| code & 0xff) {
        Ok(5 | 6) => Meaning::Busy,
        Ok(13) => Meaning::Full,
        _ => Meaning::Other,
    }
}

/// The classes of `SQLSTATE`: <https://www.postgresql.org/docs/15/errcodes-appendix.html>
fn of_postgres(code: &str) -> Meaning {
    match code {
        "53100" => Meaning::Full,
        // Two transactions waited for one another, or one for something too long. Too many connections. The server is shut
        // down, starts, recovers, or stands by. A transaction stood still for too long.
        "40001" | "40P01" | "55P03" | "57014" | "53300" | "57P01" | "57P02" | "57P03" | "25006" | "25P03" => {
            Meaning::Busy
        }
        // No connection.
        _ if code.starts_with("08") => Meaning::Busy,
        _ => Meaning::Other,
    }
}
