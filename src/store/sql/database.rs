//! The database of a store, of one engine or the other, and its transactions.

use tokio::sync::OwnedRwLockReadGuard;

use crate::config::DatabaseAddress;
use crate::store::StoreError;
#[cfg(feature = "postgres")]
use crate::store::postgres::{Postgres, in_time};
use crate::store::sqlite::Sqlite;

/// An open database.
#[derive(Debug)]
pub enum Database {
    /// A file of this process.
    Sqlite(Sqlite),
    /// A server that processes share.
    #[cfg(feature = "postgres")]
    Postgres(Postgres),
}

/// A transaction, rolled back when it is dropped.
#[derive(Debug)]
pub enum Transaction {
    /// In SQLite, where one that writes is alone.
    Sqlite {
        /// The driver's own.
        transaction: sqlx::Transaction<'static, sqlx::Sqlite>,
        /// Keeps blobs from being removed until it ends.
        gate: Option<OwnedRwLockReadGuard<()>>,
    },
    /// In PostgreSQL.
    #[cfg(feature = "postgres")]
    Postgres(sqlx::Transaction<'static, sqlx::Postgres>),
}

impl Database {
    /// Opens a database for the service, and brings it up to date.
    pub async fn open(address: &DatabaseAddress) -> Result<Self, StoreError> {
        Ok(match address {
            DatabaseAddress::Sqlite(folder) => Self::Sqlite(Sqlite::open(folder).await?),
            #[cfg(feature = "postgres")]
            DatabaseAddress::Postgres(address) => Self::Postgres(Postgres::open(address).await?),
        })
    }

    /// Opens a database that a service may be using, for changes that touch neither jobs nor blobs.
    pub async fn open_beside(address: &DatabaseAddress) -> Result<Self, StoreError> {
        match address {
            DatabaseAddress::Sqlite(folder) => Ok(Self::Sqlite(Sqlite::open_beside(folder).await?)),
            #[cfg(feature = "postgres")]
            DatabaseAddress::Postgres(_) => Self::open(address).await,
        }
    }

    /// Begins a transaction that may write; changes begin by [`Self::write`].
    pub async fn begin(&self) -> Result<Transaction, StoreError> {
        Ok(match self {
            Self::Sqlite(engine) => Transaction::Sqlite { transaction: engine.write().await?, gate: None },
            #[cfg(feature = "postgres")]
            Self::Postgres(engine) => Transaction::Postgres(engine.write().await?),
        })
    }

    /// Begins a read of one committed state.
    pub async fn snapshot(&self) -> Result<Transaction, StoreError> {
        Ok(match self {
            Self::Sqlite(engine) => Transaction::Sqlite { transaction: engine.readers.begin().await?, gate: None },
            #[cfg(feature = "postgres")]
            Self::Postgres(engine) => Transaction::Postgres(engine.snapshot().await?),
        })
    }

    /// Whether other processes may use it at the same time.
    pub const fn is_shared(&self) -> bool {
        !matches!(self, Self::Sqlite(_))
    }

    /// Gives up space that was set aside for a full disk. Answers whether there was any.
    pub fn release_reserve(&self) -> bool {
        match self {
            Self::Sqlite(engine) => engine.folder.release_reserve(),
            #[cfg(feature = "postgres")]
            Self::Postgres(_) => false,
        }
    }

    /// Sets space aside again, where there is enough.
    pub fn restore_reserve(&self) {
        match self {
            Self::Sqlite(engine) => drop(engine.folder.restore_reserve()),
            #[cfg(feature = "postgres")]
            Self::Postgres(_) => {}
        }
    }
}

impl Transaction {
    /// Keeps a gate until it ends. A database of its own locks has none.
    pub fn keep(&mut self, until_the_end: OwnedRwLockReadGuard<()>) {
        match self {
            Self::Sqlite { gate, .. } => *gate = Some(until_the_end),
            #[cfg(feature = "postgres")]
            Self::Postgres(_) => {}
        }
    }

    /// Makes all of it last.
    pub async fn commit(self) -> Result<(), StoreError> {
        match self {
            Self::Sqlite { transaction, gate } => {
                transaction.commit().await?;
                drop(gate);
            }
            #[cfg(feature = "postgres")]
            Self::Postgres(transaction) => in_time(transaction.commit()).await?,
        }
        Ok(())
    }

    /// Whether no other transaction writes.
    pub const fn is_alone(&self) -> bool {
        matches!(self, Self::Sqlite { .. })
    }
}
