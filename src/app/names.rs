//! Names for people: what a person calls a location, a place, an aisle or a row, kept in the registry of the site.

use std::sync::Arc;

use stillage_core::layout::{Layout, check_code};
use stillage_core::registry::{AreaKind, AreaRings, CodeConflict, CodeOwner, Given, GivenCode, NamedArea, Registry};
use uuid::Uuid;

use super::registries::{ATTEMPTS, kept};
use super::{App, AppError, Caller, MapContext};
use crate::blocking::off_the_runtime;
use crate::features::{self, Collection, FeatureId, Geometry, MapNames, Naming};

/// Something of a map that can have a name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Nameable {
    /// A location, by its index in the layout.
    Location(usize),
    /// A place, aisle or row, by its index.
    Area(AreaKind, usize),
}

/// The kind of areas that a collection has, if they can have names.
#[must_use]
pub const fn area_kind(collection: Collection) -> Option<AreaKind> {
    match collection {
        Collection::Places => Some(AreaKind::Place),
        Collection::Aisles => Some(AreaKind::Aisle),
        Collection::Rows => Some(AreaKind::Row),
        _ => None,
    }
}

impl MapContext {
    /// The map with these codes for its locations, in their order, and the names that the registry of its site has.
    pub(super) fn with_codes(mut self, registry: &Registry, codes: Vec<GivenCode>) -> Self {
        self.names = names_of(&self, registry, &codes);
        for (location, given) in self.layout.locations.iter_mut().zip(codes) {
            location.code = given.code;
        }
        self
    }

    /// What a feature is, if it is there and can have a name.
    #[must_use]
    pub fn nameable(&self, collection: Collection, id: &FeatureId) -> Option<Nameable> {
        let layout = &self.layout;
        match (collection, id) {
            (Collection::Locations, FeatureId::Text(code)) => {
                layout.locations.iter().position(|location| location.code == *code).map(Nameable::Location)
            }
            (_, FeatureId::Number(number)) => {
                let kind = area_kind(collection)?;
                let index = match kind {
                    AreaKind::Place => {
                        usize::try_from(*number).ok().filter(|&index| index < self.semantic.places.len())
                    }
                    AreaKind::Aisle => layout.aisles.iter().position(|aisle| u64::from(aisle.number) == *number),
                    AreaKind::Row => layout.rows.iter().position(|row| u64::from(row.number) == *number),
                };
                index.map(|index| Nameable::Area(kind, index))
            }
            _ => None,
        }
    }

    /// All that has this name.
    #[must_use]
    pub fn find_name(&self, name: &str) -> Vec<Nameable> {
        let named = self.names.all().filter(|(_, naming)| naming.name.as_deref() == Some(name));
        let what = |(collection, index)| match area_kind(collection) {
            Some(kind) => Nameable::Area(kind, index),
            None => Nameable::Location(index),
        };
        named.map(|(place, _)| what(place)).collect()
    }

    /// What people call an area.
    #[must_use]
    pub fn area_naming(&self, kind: AreaKind, index: usize) -> Naming {
        match kind {
            AreaKind::Place => self.names.place(index),
            AreaKind::Aisle => self.names.aisle(index),
            AreaKind::Row => self.names.row(index),
        }
    }

    /// The id of an area in its collection.
    #[must_use]
    pub fn area_id(&self, kind: AreaKind, index: usize) -> u32 {
        match kind {
            AreaKind::Place => index as u32,
            AreaKind::Aisle => self.layout.aisles[index].number,
            AreaKind::Row => self.layout.rows[index].number,
        }
    }

    /// Whether two contexts answer for the same state of the map.
    fn is_as(&self, other: &Self) -> bool {
        let state = |context: &Self| (context.record.version, context.analysis_id, context.semantics.version);
        state(self) == state(other)
    }
}

impl App {
    /// Names a feature of a map, as long as the map is as `seen`. Answers the map as it is now and the feature's id in it.
    pub async fn name_feature(
        &self,
        caller: &Caller,
        seen: &Arc<MapContext>,
        (collection, id): (Collection, FeatureId),
        given: Given,
    ) -> Result<(Arc<MapContext>, FeatureId), AppError> {
        let map = seen.record.id;
        let what = seen.nameable(collection, &id).ok_or_else(|| AppError::not_found("feature", id.to_string()))?;
        let id = given.code.clone().map_or(id, FeatureId::Text);
        if let Some(code) = &given.code {
            if !matches!(what, Nameable::Location(_)) {
                let detail = format!("{} have no codes: name and groups may be written", collection.id());
                return Err(AppError::invalid("/code", detail));
            }
            check_code(code).map_err(|problem| AppError::invalid("/code", problem.to_string()))?;
        }
        let change = move |context: &MapContext, registry: &mut Registry| match what {
            Nameable::Location(location) => {
                let key = key_of(context, registry, location)?;
                registry.give(&[(key, given.clone())]).map_err(|conflicts| taken(&conflicts))
            }
            Nameable::Area(kind, index) => {
                name_area(context, registry, (kind, index), &given);
                Ok(())
            }
        };
        self.change_registry(caller, map, Some(seen), change).await?;
        Ok((self.context(caller, map).await?, id))
    }

    /// Changes the registry of a map's site: all of the change or nothing. With `seen`, only while the map is as it was then.
    pub(super) async fn change_registry<T: Send + 'static>(
        &self,
        caller: &Caller,
        map: Uuid,
        seen: Option<&Arc<MapContext>>,
        change: impl Fn(&MapContext, &mut Registry) -> Result<T, AppError> + Clone + Send + 'static,
    ) -> Result<T, AppError> {
        for _ in 0..ATTEMPTS {
            // The registry first: whoever changes it after this is found out when it is written.
            let site = self.store.registry(caller.tenant(), map).await?;
            let context = self.context(caller, map).await?;
            if seen.is_some_and(|seen| !context.is_as(seen)) {
                return Err(AppError::PreconditionFailed { current: context.record.version });
            }
            let site = site.ok_or_else(|| AppError::not_found("map", map))?;
            let (mut registry, change) = (site.registry.clone(), change.clone());
            let (registry, made) = off_the_runtime(move || {
                let made = change(&context, &mut registry)?;
                Ok::<_, AppError>((registry, made))
            })
            .await?;
            let is_same = registry == site.registry;
            if is_same || self.store.put_registry(caller.tenant(), map, &registry, site.version, true).await? {
                return Ok(made);
            }
        }
        Err(AppError::Unavailable)
    }
}

/// The key of a location in the registry of its site.
pub(super) fn key_of(context: &MapContext, registry: &Registry, location: usize) -> Result<u32, AppError> {
    // A registry that was read before the map wrote its codes has none: another attempt finds them.
    registry.find(&context.layout.locations[location].code).map(|entry| entry.key).ok_or(AppError::Unavailable)
}

/// Writes the name and the groups of a place, aisle or row.
pub(super) fn name_area(
    context: &MapContext,
    registry: &mut Registry,
    (kind, index): (AreaKind, usize),
    given: &Given,
) {
    let grounds = grounds(context, kind);
    let at = registry.areas_of(kind, &grounds)[index];
    let known = at.map(|at| &registry.areas[at]);
    let name = given.name.clone().unwrap_or_else(|| known.and_then(|area| area.name.clone()));
    let groups = given.groups.clone().or_else(|| known.map(|area| area.groups.clone())).unwrap_or_default();
    registry.put_area(at, NamedArea { kind, name, groups, rings: grounds[index].clone() });
}

/// The areas of a kind in the frame of the site, by their indices.
pub(super) fn grounds(context: &MapContext, kind: AreaKind) -> Vec<AreaRings> {
    let (to_site, from_grid) =
        (context.record.to_site(), context.grid.frame().motion().then(&context.record.to_site()));
    let placed = |ring: &[stillage_core::Point]| ring.iter().map(|&point| kept(from_grid.apply(point))).collect();
    let Layout { aisles, rows, .. } = &context.layout;
    match kind {
        AreaKind::Aisle => aisles.iter().map(|aisle| vec![placed(&aisle.outline())]).collect(),
        AreaKind::Row => rows.iter().map(|row| vec![placed(&row.outline())]).collect(),
        AreaKind::Place => {
            let rings = |geometry| match geometry {
                Geometry::Polygon(rings) => rings,
                Geometry::MultiPolygon(polygons) => polygons.into_iter().flatten().collect(),
                _ => Vec::new(),
            };
            let moved = |ring: Vec<_>| ring.into_iter().map(|point| kept(to_site.apply(point))).collect();
            let ground = |place| rings(features::place_shape(&context.view(), place)).into_iter().map(moved).collect();
            (0..context.semantic.places.len() as u32).map(ground).collect()
        }
    }
}

/// What people call the things of a map.
pub(super) fn names_of(context: &MapContext, registry: &Registry, codes: &[GivenCode]) -> MapNames {
    let areas = |kind| {
        if registry.areas.iter().all(|area| area.kind != kind) {
            return Vec::new();
        }
        let found = registry.areas_of(kind, &grounds(context, kind)).into_iter();
        let naming = |index: Option<usize>| {
            let area = index.map(|index| &registry.areas[index]);
            area.map_or_else(Naming::default, |area| Naming { name: area.name.clone(), groups: area.groups.clone() })
        };
        found.map(naming).collect()
    };
    let naming = |given: &GivenCode| Naming { name: given.name.clone(), groups: given.groups.clone() };
    MapNames {
        locations: codes.iter().map(naming).collect(),
        stale: codes.iter().map(|given| given.is_stale).collect(),
        places: areas(AreaKind::Place),
        aisles: areas(AreaKind::Aisle),
        rows: areas(AreaKind::Row),
        faces: context.corrections.named_faces(),
    }
}

/// Why a code cannot be given.
fn taken(conflicts: &[CodeConflict]) -> AppError {
    let told = conflicts.iter().map(conflict_words).collect::<Vec<_>>();
    AppError::Conflict(told.join("; "))
}

/// Why a code cannot be given, for people.
pub(super) fn conflict_words(conflict: &CodeConflict) -> String {
    let code = &conflict.code;
    match conflict.taken_by {
        CodeOwner::Place(_) => format!("another location has the code {code}: give that one another code first"),
        CodeOwner::LostPlace(_) => {
            format!(
                "the code {code} belongs to a location that the newest map does not show; GET .../registry lists it"
            )
        }
        CodeOwner::Gift(_) => format!("the code {code} is given twice"),
    }
}
