//! What waits for changes of jobs.

use tokio::sync::{Notify, watch};

/// What happens to jobs of this process, for those who wait for it. A hint only: jobs of other processes change, too.
#[derive(Debug)]
pub struct Signals {
    changes: watch::Sender<u64>,
    queued: Notify,
}

impl Default for Signals {
    fn default() -> Self {
        Self { changes: watch::Sender::new(0), queued: Notify::new() }
    }
}

impl Signals {
    /// Waits until a job is queued.
    pub(super) async fn wait_for_a_job(&self) {
        self.queued.notified().await;
    }

    /// A job was queued.
    pub fn queued(&self) {
        self.queued.notify_one();
        self.changed();
    }

    /// Some job changed.
    pub fn changed(&self) {
        self.changes.send_modify(|count| *count = count.wrapping_add(1));
    }

    /// Wakes whenever some job changed.
    #[must_use]
    pub fn changes(&self) -> watch::Receiver<u64> {
        self.changes.subscribe()
    }
}
