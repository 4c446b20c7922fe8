//! What a tenant may have.

use clap::Args;

use crate::config::KeyRule;
use crate::store::Quotas;

/// What a tenant may have, where requests need keys and nothing else is said: room for every site of a large operator, and not
/// the whole queue.
const WITH_KEYS: Quotas = Quotas { maps: 10_000, bytes: 64 << 30, queued_jobs: 500, running_jobs: u64::MAX };

/// What a tenant may have. Absent limits are those of `--keys required`; a service without keys has none.
#[derive(Debug, Clone, Args)]
pub(super) struct QuotaArgs {
    /// Maps of a tenant; further uploads are answered 403. 10,000 when absent and keys are required.
    #[arg(long, env = "STILLAGE_TENANT_MAX_MAPS", value_name = "N")]
    tenant_max_maps: Option<u64>,
    /// Uploads and results of a tenant as they are stored, GiB; further ones are answered 403. 64 when absent and keys are
    /// required.
    #[arg(long, env = "STILLAGE_TENANT_MAX_GIB", value_name = "GIB")]
    tenant_max_gib: Option<u64>,
    /// Jobs of a tenant that wait; further ones are answered 429. 500 when absent and keys are required.
    #[arg(long, env = "STILLAGE_TENANT_MAX_QUEUED_JOBS", value_name = "N")]
    tenant_max_queued_jobs: Option<u64>,
    /// Jobs of a tenant that run at the same time; the others wait. As many as there are slots when absent.
    #[arg(long, env = "STILLAGE_TENANT_MAX_RUNNING_JOBS", value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    tenant_max_running_jobs: Option<u64>,
}

impl QuotaArgs {
    /// The quotas that the arguments mean.
    pub(super) fn quotas(&self, keys: KeyRule) -> Quotas {
        let absent = if keys == KeyRule::Required { WITH_KEYS } else { Quotas::UNLIMITED };
        Quotas {
            maps: self.tenant_max_maps.unwrap_or(absent.maps),
            bytes: self.tenant_max_gib.map_or(absent.bytes, |gib| gib.saturating_mul(1 << 30)),
            queued_jobs: self.tenant_max_queued_jobs.unwrap_or(absent.queued_jobs),
            running_jobs: self.tenant_max_running_jobs.unwrap_or(absent.running_jobs),
        }
    }
}
