//! What is done while no job is.

use std::time::Duration;

use jiff::{SignedDuration, Timestamp};

use crate::store::{Store, StoreError};

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
