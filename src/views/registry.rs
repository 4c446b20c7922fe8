//! The registry of a site.

use serde::{Deserialize, Serialize};
use stillage_core::Point;
use stillage_core::geometry::{RigidMotion, polygon};
use stillage_core::registry::{AreaKind, NamedArea, PlaceState, RegistryEntry};
use utoipa::ToSchema;

use super::id::Id;
use super::link::Link;
use crate::features::rounded;
use crate::store::SiteRegistry;

/// Every place that ever had a code at a site.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Registry)]
#[serde(rename_all = "camelCase")]
pub struct RegistryView {
    /// The site.
    site: Id,
    /// Raised with every change.
    version: u64,
    /// How many places the newest map of the site shows.
    current: usize,
    /// How many wait for a person to confirm them.
    stale: usize,
    /// How many the newest map does not show. Their codes are never given to others.
    lost: usize,
    /// The places, by code.
    entries: Vec<RegistryEntryView>,
    /// The places in the sense of the collection `places`, aisles and rows that have names or groups.
    areas: Vec<NamedAreaView>,
    links: Vec<Link>,
}

/// A place of a site.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = RegistryEntry)]
#[serde(rename_all = "camelCase")]
pub struct RegistryEntryView {
    /// Number that never changes and is never given again.
    key: u32,
    #[schema(example = "03-012")]
    code: String,
    /// Whether a person gave the code.
    code_given: bool,
    /// The name that people gave it.
    #[serde(skip_serializing_if = "Option::is_none")]
    name: Option<String>,
    /// The groups that people put it in.
    groups: Vec<String>,
    state: PlaceStateView,
    /// Its centre where it was first seen or last confirmed, x and y, metres of this map's frame.
    centre: [f64; 2],
    /// Where it was seen since, when that is not confirmed yet.
    #[serde(skip_serializing_if = "Option::is_none")]
    seen_at: Option<[f64; 2]>,
}

/// Ground that has a name or groups.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = NamedArea)]
pub struct NamedAreaView {
    /// What it is.
    kind: AreaKindView,
    #[serde(skip_serializing_if = "Option::is_none")]
    name: Option<String>,
    groups: Vec<String>,
    /// Its middle when it was named, x and y, metres of this map's frame.
    centre: [f64; 2],
}

/// What an area is.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = AreaKind)]
#[serde(rename_all = "lowercase")]
pub enum AreaKindView {
    /// A place: a room, a corridor, a junction.
    Place,
    /// An aisle.
    Aisle,
    /// A row of locations.
    Row,
}

/// How surely a place is where its code says.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = PlaceState)]
#[serde(rename_all = "lowercase")]
pub enum PlaceStateView {
    /// The newest map of the site shows it.
    Current,
    /// Something was found that may be it; a person has to confirm.
    Stale,
    /// The newest map does not show it.
    Lost,
}

/// Which stale codes are right: some, or all.
#[derive(Debug, Deserialize, ToSchema)]
#[schema(as = Confirmation)]
#[serde(deny_unknown_fields)]
pub struct ConfirmationBody {
    /// The codes; all stale ones when absent.
    #[schema(example = json!(["03-012"]))]
    pub codes: Option<Vec<String>>,
}

impl From<PlaceState> for PlaceStateView {
    fn from(state: PlaceState) -> Self {
        match state {
            PlaceState::Current => Self::Current,
            PlaceState::Stale => Self::Stale,
            PlaceState::Lost => Self::Lost,
        }
    }
}

impl RegistryView {
    /// A registry, in the frame of a map that `to_site` carries to that of the site.
    #[must_use]
    pub fn new(site: SiteRegistry, to_site: &RigidMotion, links: Vec<Link>) -> Self {
        let back = to_site.inverse();
        let position = |point| {
            let place = back.apply(point);
            [rounded(place.x), rounded(place.y)]
        };
        let count = |state| site.registry.entries.iter().filter(|entry| entry.state == state).count();
        let [current, stale, lost] = [PlaceState::Current, PlaceState::Stale, PlaceState::Lost].map(count);
        let entry = |entry: RegistryEntry| RegistryEntryView {
            key: entry.key,
            code: entry.code,
            code_given: entry.is_code_given,
            name: entry.name,
            groups: entry.groups,
            state: entry.state.into(),
            centre: position(entry.center),
            seen_at: entry.seen.map(|(_, center)| position(center)),
        };
        let mut entries: Vec<RegistryEntryView> = site.registry.entries.into_iter().map(entry).collect();
        entries.sort_by(|one, other| one.code.cmp(&other.code));
        let area = |area: NamedArea| NamedAreaView {
            kind: match area.kind {
                AreaKind::Place => AreaKindView::Place,
                AreaKind::Aisle => AreaKindView::Aisle,
                AreaKind::Row => AreaKindView::Row,
            },
            name: area.name,
            groups: area.groups,
            centre: position(polygon::centroid(&area.rings).unwrap_or_else(Point::origin)),
        };
        let areas = site.registry.areas.into_iter().map(area).collect();
        Self { site: Id(site.site), version: site.version, current, stale, lost, entries, areas, links }
    }
}
