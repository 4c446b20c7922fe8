//! Who waits for whom, where several transactions write at the same time.
//!
//! SQLite has one writer, so that nothing is to be done there. In PostgreSQL a transaction takes an advisory lock on the
//! name of what it reads before it writes it, and keeps it until it ends. Whoever takes two takes those of sites last.

use uuid::Uuid;

use super::database::Transaction;
use super::statement::query;
#[cfg(feature = "postgres")]
use crate::store::BlobId;
use crate::store::StoreError;

/// A lock on the name in the first parameter.
const ALONE: &str = "SELECT pg_advisory_xact_lock(hashtextextended($1, 0))";

/// A lock that others may have, too, but nobody who wants to be alone.
#[cfg(feature = "postgres")]
const SHARED: &str = "SELECT pg_advisory_xact_lock_shared(hashtextextended($1, 0))";

/// [`ALONE`] on the site of a map.
const ALONE_ON_SITE_OF: &str =
    "SELECT pg_advisory_xact_lock(hashtextextended('site ' || site, 0)) FROM maps WHERE id = $1";

impl Transaction {
    /// Waits until no other transaction is alone on this name.
    pub(super) async fn alone_on(&mut self, name: &str) -> Result<(), StoreError> {
        self.lock(ALONE, name.to_owned()).await
    }

    /// Waits until no other transaction changes a map of this site.
    pub(super) async fn alone_on_site(&mut self, site: Uuid) -> Result<(), StoreError> {
        self.lock(ALONE, format!("site {site}")).await
    }

    /// Waits until no other transaction changes a map of the site of this one. What was read before may be old afterwards.
    pub(super) async fn alone_on_site_of(&mut self, map: Uuid) -> Result<(), StoreError> {
        self.lock(ALONE_ON_SITE_OF, map.to_string()).await
    }

    /// Keeps a blob from being removed.
    #[cfg(feature = "postgres")]
    pub(super) async fn keep_blob(&mut self, blob: &BlobId) -> Result<(), StoreError> {
        self.lock(SHARED, format!("blob {blob}")).await
    }

    /// Waits until no other transaction keeps a blob.
    #[cfg(feature = "postgres")]
    pub(super) async fn alone_on_blob(&mut self, blob: &BlobId) -> Result<(), StoreError> {
        self.lock(ALONE, format!("blob {blob}")).await
    }

    async fn lock(&mut self, sql: &'static str, name: String) -> Result<(), StoreError> {
        if !self.is_alone() {
            query(sql).bind(name).execute(self).await?;
        }
        Ok(())
    }
}
