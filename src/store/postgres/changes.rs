//! What the server tells of jobs that changed.

use std::time::Duration;

use sqlx::postgres::{PgListener, PgPool};
use tokio::sync::Mutex;

use crate::store::StoreError;

/// The channel that the trigger of the table of jobs notifies.
const CHANNEL: &str = "stillage_jobs";

/// A change is told of after this time at the latest, whatever the server told: its word is only a hint.
const POLL: Duration = Duration::from_secs(1);

/// Listens to the server, while it can.
#[derive(Debug)]
pub(super) struct JobChanges {
    pool: PgPool,
    listener: Mutex<Option<PgListener>>,
}

impl JobChanges {
    pub(super) fn of(pool: PgPool) -> Self {
        Self { pool, listener: Mutex::new(None) }
    }

    /// Returns when a job changed, or after [`POLL`].
    pub(super) async fn next(&self) {
        if let Ok(Err(error)) = tokio::time::timeout(POLL, self.notified()).await {
            tracing::debug!(%error, "the database tells nothing of jobs");
            *self.listener.lock().await = None;
            tokio::time::sleep(POLL).await;
        }
    }

    /// Gives the connection back.
    pub(super) async fn close(&self) {
        *self.listener.lock().await = None;
    }

    async fn notified(&self) -> Result<(), StoreError> {
        let mut listener = self.listener.lock().await;
        if listener.is_none() {
            let mut new = PgListener::connect_with(&self.pool).await?;
            // Otherwise a store that is closed would wait for this connection.
            new.ignore_pool_close_event(false);
            new.listen(CHANNEL).await?;
            *listener = Some(new);
        }
        if let Some(listener) = &mut *listener {
            listener.recv().await?;
            // One look tells of all that changed by now.
            while listener.next_buffered().is_some() {}
        }
        Ok(())
    }
}
