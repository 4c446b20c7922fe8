//! Whether there is room for something new.

use super::database::Transaction;
use super::statement::query;
use crate::records::Tenant;
use crate::store::{Capacity, Full, Quotas, StoreError};

/// What is to be added beside a job.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Addition {
    /// Maps.
    pub maps: u64,
    /// Bytes.
    pub bytes: u64,
}

impl Transaction {
    /// Waits until no other transaction adds something of a tenant whose quotas are counted.
    pub(super) async fn alone_on_tenant(&mut self, tenant: &Tenant, capacity: &Capacity) -> Result<(), StoreError> {
        let is_counted = capacity.of_tenant != Quotas::UNLIMITED;
        if is_counted { self.alone_on(&format!("tenant {tenant}")).await } else { Ok(()) }
    }

    /// Why a job cannot be queued, with something to be stored beside it.
    pub(super) async fn full(
        &mut self,
        tenant: &Tenant,
        capacity: &Capacity,
        new: Addition,
    ) -> Result<Option<Full>, StoreError> {
        let quotas = capacity.of_tenant;
        let row = query("SELECT count(*) AS waiting FROM jobs WHERE state = 'accepted' AND tenant <> ''");
        if row.fetch_one(&mut *self).await?.whole::<u64>("waiting")? >= capacity.queued_jobs {
            return Ok(Some(Full::Queue));
        }
        let waiting = "SELECT count(*) AS found FROM jobs WHERE tenant = $1 AND state = 'accepted'";
        if !self.has_room(waiting, tenant, quotas.queued_jobs, 1).await? {
            return Ok(Some(Full::QueuedJobs));
        }
        let maps = "SELECT count(*) AS found FROM maps WHERE tenant = $1";
        if new.maps > 0 && !self.has_room(maps, tenant, quotas.maps, new.maps).await? {
            return Ok(Some(Full::Maps));
        }
        let bytes = "SELECT CAST(coalesce(sum(bytes), 0) AS bigint) AS found FROM ( \
                         SELECT bytes FROM maps WHERE tenant = $1 UNION ALL SELECT analyses.bytes FROM analyses \
                             JOIN maps ON maps.id = analyses.map WHERE maps.tenant = $1) AS stored";
        Ok((!self.has_room(bytes, tenant, quotas.bytes, new.bytes).await?).then_some(Full::Bytes))
    }

    /// Whether what a statement finds of a tenant leaves room for some more.
    async fn has_room(&mut self, sql: &'static str, tenant: &Tenant, most: u64, more: u64) -> Result<bool, StoreError> {
        if most == u64::MAX {
            return Ok(true);
        }
        let row = query(sql).bind(tenant.as_str()).fetch_one(self).await?;
        Ok(row.whole::<u64>("found")?.saturating_add(more) <= most)
    }
}
