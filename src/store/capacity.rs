//! How much there may be: in all, and of a tenant.

/// What one tenant may have. Deleted maps that can be restored do not count.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Quotas {
    /// Maps.
    pub maps: u64,
    /// Bytes of uploads and results, as they are stored. What other maps share counts for each of them.
    pub bytes: u64,
    /// Jobs that wait.
    pub queued_jobs: u64,
    /// Jobs that run at the same time.
    pub running_jobs: u64,
}

impl Quotas {
    /// No limits.
    pub const UNLIMITED: Self = Self { maps: u64::MAX, bytes: u64::MAX, queued_jobs: u64::MAX, running_jobs: u64::MAX };
}

/// How much there may be when something is added.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Capacity {
    /// Jobs of all tenants that wait.
    pub queued_jobs: u64,
    /// What the tenant may have.
    pub of_tenant: Quotas,
}

impl Capacity {
    /// No limits.
    pub const UNLIMITED: Self = Self::queue(u64::MAX);

    /// A limit on the queue alone.
    #[must_use]
    pub const fn queue(queued_jobs: u64) -> Self {
        Self { queued_jobs, of_tenant: Quotas::UNLIMITED }
    }
}

/// Why nothing can be added.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Full {
    /// As many jobs of all tenants wait as may.
    Queue,
    /// As many jobs of the tenant wait as may.
    QueuedJobs,
    /// The tenant has as many maps as it may.
    Maps,
    /// What the tenant has stored is as long as it may be.
    Bytes,
}
