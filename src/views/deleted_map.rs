//! Deleted maps that can be restored.

use jiff::Timestamp;
use serde::Serialize;
use utoipa::ToSchema;

use super::id::Id;
use super::link::Link;
use crate::app::DeletedMap;

/// A deleted map.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = DeletedMap)]
#[serde(rename_all = "camelCase")]
pub struct DeletedMapView {
    id: Id,
    /// Name for people.
    name: String,
    /// When it was uploaded.
    #[schema(value_type = String, format = DateTime)]
    created: Timestamp,
    /// When it was deleted.
    #[schema(value_type = String, format = DateTime)]
    deleted: Timestamp,
    /// Until when it can be restored, unless the disk is short before.
    #[schema(value_type = String, format = DateTime)]
    restorable_until: Timestamp,
    /// Where a `POST` restores it.
    links: Vec<Link>,
}

impl DeletedMapView {
    /// A deleted map with its links.
    #[must_use]
    pub fn new(DeletedMap { map, deleted, restorable_until }: DeletedMap, links: Vec<Link>) -> Self {
        Self { id: Id(map.id), name: map.name, created: map.created, deleted, restorable_until, links }
    }
}

/// A page of deleted maps.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "camelCase")]
pub struct DeletedMapList {
    /// The newest map first.
    pub maps: Vec<DeletedMapView>,
    /// Itself, and the next page.
    pub links: Vec<Link>,
}
