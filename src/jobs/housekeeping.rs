//! What is done while no job is, and beside the jobs.

use std::sync::Arc;
use std::time::Duration;

use jiff::{SignedDuration, Timestamp};

use crate::store::{Store, StoreError};

/// How often old entries of the log of changes are looked for.
const PERIOD: Duration = Duration::from_hours(1);

/// Deletes the maps that were deleted by people as long ago as they are kept, or all of them where the disk is short.
pub async fn delete_hidden(store: &dyn Store, keep: Duration) -> Result<(), StoreError> {
    // The clock of this machine may be wrong.
    let now = store.clock().await?;
    let until = if store.check_space().is_ok() { kept_since(keep, now) } else { now };
    let deleted = store.delete_hidden(until).await?;
    if deleted > 0 {
        tracing::info!(deleted, "removed maps that were deleted a while ago");
    }
    Ok(())
}

/// The time after which a map must have been deleted to be kept still.
#[must_use]
pub fn kept_since(keep: Duration, now: Timestamp) -> Timestamp {
    let keep = SignedDuration::try_from(keep).unwrap_or(SignedDuration::MAX);
    now.checked_sub(keep).unwrap_or(Timestamp::MIN)
}

/// Removes entries of the log of changes once they are older than they are kept. Never returns.
pub async fn forget_old_entries(store: Arc<dyn Store>, keep: Duration) {
    loop {
        match forget(&*store, keep).await {
            Ok(0) => {}
            Ok(forgotten) => tracing::info!(forgotten, "removed old entries of the log of changes"),
            Err(error) => tracing::warn!(%error, "old entries of the log of changes could not be removed"),
        }
        tokio::time::sleep(PERIOD).await;
    }
}

async fn forget(store: &dyn Store, keep: Duration) -> Result<u64, StoreError> {
    store.audit().forget_before(kept_since(keep, store.clock().await?)).await
}

/// Fills in the lengths of what an earlier release stored without them. Where that cannot be done, the next start tries again.
pub async fn measure_old_blobs(store: Arc<dyn Store>) {
    match store.measure_unmeasured_blobs().await {
        Ok(0) => {}
        Ok(measured) => tracing::info!(measured, "uploads and results of an earlier release count to quotas now"),
        Err(error) => tracing::warn!(%error, "what an earlier release stored does not all count to quotas yet"),
    }
}
