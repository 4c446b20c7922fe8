//! Rows of registries.

use async_trait::async_trait;
use stillage_core::registry::Registry;
use uuid::Uuid;

use super::rows::json;
use super::statement::query;
use super::store::SqlStore;
use crate::records::Tenant;
use crate::store::{Registries, SiteRegistry, StoreError};

#[async_trait]
impl Registries for SqlStore {
    async fn registry(&self, tenant: &Tenant, map: Uuid) -> Result<Option<SiteRegistry>, StoreError> {
        let row = query(
            "SELECT maps.site, registries.places, coalesce(registries.version, 0) AS version, \
                 NOT EXISTS (SELECT 1 FROM maps AS newer \
                     WHERE newer.site = maps.site AND newer.tenant = maps.tenant AND newer.id > maps.id AND newer.analysis IS NOT NULL) AS is_newest \
             FROM maps LEFT JOIN registries ON registries.site = maps.site WHERE maps.tenant = $1 AND maps.id = $2",
        )
        .bind(tenant.as_str())
        .bind(map.to_string())
        .fetch_optional(&self.database)
        .await?;
        let Some(row) = row else { return Ok(None) };
        Ok(Some(SiteRegistry {
            site: row.uuid("site")?,
            registry: row.json_if("places")?.unwrap_or_default(),
            version: row.whole("version")?,
            is_newest: row.flag("is_newest")?,
        }))
    }

    async fn put_registry(
        &self,
        tenant: &Tenant,
        map: Uuid,
        registry: &Registry,
        replaces: u64,
        decided: bool,
    ) -> Result<bool, StoreError> {
        let mut transaction = self.database.write().await?;
        transaction.alone_on_site_of(map).await?;
        let written = query(
            "INSERT INTO registries (site, places, version) \
             SELECT site, $3, $4 + 1 FROM maps WHERE tenant = $1 AND id = $2 \
                 AND $4 = coalesce((SELECT version FROM registries WHERE registries.site = maps.site), 0) \
             ON CONFLICT (site) DO UPDATE SET places = excluded.places, version = excluded.version",
        )
        .bind(tenant.as_str())
        .bind(map.to_string())
        .bind(json(registry))
        .bind(replaces as i64)
        .execute(&mut transaction)
        .await?;
        if written == 0 {
            return Ok(false);
        }
        if decided {
            query("UPDATE maps SET version = version + 1 WHERE site = (SELECT site FROM maps WHERE id = $1)")
                .bind(map.to_string())
                .execute(&mut transaction)
                .await?;
        }
        transaction.commit().await?;
        Ok(true)
    }
}
