//! Registries: the codes and names of a site's places.

use async_trait::async_trait;
use stillage_core::registry::Registry;
use uuid::Uuid;

use super::StoreError;
use crate::records::Tenant;

/// The registry of a site, as one of its maps sees it.
#[derive(Debug, Clone, PartialEq)]
pub struct SiteRegistry {
    /// The site.
    pub site: Uuid,
    /// Its places; none before the first map is read.
    pub registry: Registry,
    /// Raised with every change; 0 before the first one.
    pub version: u64,
    /// Whether the map that was asked about is the newest one of the site that is analysed.
    pub is_newest: bool,
}

/// What is kept of sites.
#[async_trait]
pub trait Registries {
    /// The registry of a map's site; `None` when there is no such map.
    async fn registry(&self, tenant: &Tenant, map: Uuid) -> Result<Option<SiteRegistry>, StoreError>;

    /// Replaces the registry of a map's site, when it is still at the version that was read; `false` when it is not, or
    /// the map is gone. Where a person `decided`, the versions of the site's maps are raised: their answers may change.
    async fn put_registry(
        &self,
        tenant: &Tenant,
        map: Uuid,
        registry: &Registry,
        replaces: u64,
        decided: bool,
    ) -> Result<bool, StoreError>;
}
