//! Names that people bring along, given all at once or not at all.

use std::collections::HashMap;
use std::sync::Arc;

use stillage_core::Point;
use stillage_core::arrangement::FaceId;
use stillage_core::compare::greatest_overlap;
use stillage_core::geometry::polygon;
use stillage_core::layout::Location;
use stillage_core::registry::{AreaKind, AreaRings, CodeConflict, CodeOwner, Given, Registry};
use stillage_core::whereabouts::nearest_location;
use uuid::Uuid;

use super::error::FieldProblem;
use super::names::{Nameable, conflict_words, grounds, key_of, name_area};
use super::{App, AppError, Caller, MapContext};
use crate::blocking::off_the_runtime;
use crate::ingest::{NameRow, NameTarget, NamedCollection};

/// Problems that are told at most: more are mended one after the other anyway.
const MOST_TOLD: usize = 100;
/// Least ground in common, as a share of the smaller of the two, for a polygon that is meant for something.
const LEAST_COMMON: f64 = 0.5;

/// What an import did, or would do.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct NameReport {
    /// Rows read.
    pub rows: usize,
    /// Things that nobody had named before.
    pub named: usize,
    /// Things that have another code or name than people gave before.
    pub renamed: usize,
    /// Rows that say what was known.
    pub unchanged: usize,
    /// Locations of the map that no row is for.
    pub unmatched: usize,
    /// What changes, by row.
    pub changes: Vec<NameChange>,
}

/// What one row changes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NameChange {
    /// JSON pointer of the row.
    pub row: String,
    /// The collection of what it names.
    pub collection: NamedCollection,
    /// The code or id that this had.
    pub before: String,
    /// The code or id that it has now.
    pub now: String,
    /// The name that it has now.
    pub name: Option<String>,
}

impl App {
    /// Gives names to what lies under the rows. With `dry_run` nothing is written.
    pub async fn import_names(
        &self,
        caller: &Caller,
        map: Uuid,
        rows: Vec<NameRow>,
        dry_run: bool,
    ) -> Result<NameReport, AppError> {
        let rows = Arc::new(rows);
        let change = move |context: &MapContext, registry: &mut Registry| import(context, registry, &rows);
        if !dry_run {
            return self.change_registry(caller, map, None, change).await;
        }
        let context = self.context(caller, map).await?;
        let (mut site, _) = self.carried_registry(caller, &context).await?;
        off_the_runtime(move || change(&context, &mut site.registry)).await
    }
}

fn import(context: &MapContext, registry: &mut Registry, rows: &[NameRow]) -> Result<NameReport, AppError> {
    let ground = NamedGround::of(context, rows);
    let mut problems = Vec::new();
    let mut meant: Vec<(usize, Nameable)> = Vec::new();
    let mut taken: HashMap<Nameable, usize> = HashMap::new();
    for (index, row) in rows.iter().enumerate() {
        match ground.find(&row.target) {
            Ok(what) => match taken.insert(what, index) {
                None => meant.push((index, what)),
                Some(earlier) => {
                    let detail = format!("is for {}, like {}", ground.words(what), rows[earlier].words());
                    problems.push(problem(row, &detail));
                }
            },
            Err(detail) => problems.push(problem(row, &detail)),
        }
    }
    if !problems.is_empty() {
        return Err(refused(rows.len(), problems));
    }
    give(context, registry, rows, &meant).map_err(|problems| refused(rows.len(), problems))
}

/// Gives the names to what is meant; the codes that are taken.
fn give(
    context: &MapContext,
    registry: &mut Registry,
    rows: &[NameRow],
    meant: &[(usize, Nameable)],
) -> Result<NameReport, Vec<FieldProblem>> {
    let mut report = NameReport { rows: rows.len(), ..NameReport::default() };
    let mut gifts = Vec::new();
    let mut of_gift = Vec::new();
    let locations = &context.layout.locations;
    let mut seen = 0;
    for &(index, what) in meant {
        let row = &rows[index];
        match what {
            Nameable::Location(location) => {
                seen += 1;
                let code = row.code.clone().filter(|code| *code != locations[location].code);
                let given = Given { code, name: row.name.clone().map(Some), groups: row.groups.clone() };
                let key = key_of(context, registry, location)
                    .map_err(|_| vec![problem(row, "is for a location without a code")])?;
                let entry = &registry.entries[key as usize - 1];
                let is_known = entry.is_code_given || entry.name.is_some();
                let has_changed = given.code.is_some()
                    || given.name.as_ref().is_some_and(|name| *name != entry.name)
                    || given.groups.as_ref().is_some_and(|groups| *groups != entry.groups);
                let name = given.name.clone().unwrap_or_else(|| entry.name.clone());
                report.count(is_known, has_changed);
                if has_changed {
                    let now = given.code.clone().unwrap_or_else(|| entry.code.clone());
                    report.changes.push(NameChange {
                        row: row.pointer.clone(),
                        collection: NamedCollection::Locations,
                        before: entry.code.clone(),
                        now,
                        name,
                    });
                }
                gifts.push((key, given));
                of_gift.push(index);
            }
            Nameable::Area(kind, area) => {
                let given = Given { code: None, name: row.name.clone().map(Some), groups: row.groups.clone() };
                let before = registry.areas.clone();
                let known = context.area_naming(kind, area);
                name_area(context, registry, (kind, area), &given);
                let has_changed = before != registry.areas;
                report.count(known.name.is_some(), has_changed);
                if has_changed {
                    let id = context.area_id(kind, area).to_string();
                    let name = row.name.clone().or(known.name);
                    let collection = collection_of(kind);
                    report.changes.push(NameChange {
                        row: row.pointer.clone(),
                        collection,
                        before: id.clone(),
                        now: id,
                        name,
                    });
                }
            }
        }
    }
    report.unmatched = locations.len() - seen;
    let told = |conflict: &CodeConflict| {
        let row = &rows[of_gift[conflict.gift]];
        match conflict.taken_by {
            CodeOwner::Gift(gift) => {
                problem(row, &format!("has the code {} of {}", conflict.code, rows[of_gift[gift]].words()))
            }
            _ => problem(row, &conflict_words(conflict)),
        }
    };
    registry.give(&gifts).map_err(|conflicts| conflicts.iter().map(told).collect::<Vec<_>>())?;
    Ok(report)
}

impl NameReport {
    fn count(&mut self, is_known: bool, has_changed: bool) {
        match (is_known, has_changed) {
            (_, false) => self.unchanged += 1,
            (false, true) => self.named += 1,
            (true, true) => self.renamed += 1,
        }
    }
}

/// A problem with a row.
fn problem(row: &NameRow, detail: &str) -> FieldProblem {
    FieldProblem { pointer: row.pointer.clone(), detail: format!("{} {detail}", row.words()) }
}

/// Nothing was changed, and why.
fn refused(rows: usize, mut problems: Vec<FieldProblem>) -> AppError {
    let detail = format!("{} of {rows} rows cannot be used: nothing was named", problems.len());
    problems.truncate(MOST_TOLD);
    AppError::Invalid { detail, fields: problems }
}

/// The collection of a kind of areas.
const fn collection_of(kind: AreaKind) -> NamedCollection {
    match kind {
        AreaKind::Place => NamedCollection::Places,
        AreaKind::Aisle => NamedCollection::Aisles,
        AreaKind::Row => NamedCollection::Rows,
    }
}

/// What there is to name on the ground of a map, in map-frame metres.
struct NamedGround<'a> {
    context: &'a MapContext,
    of_face: HashMap<FaceId, Vec<usize>>,
    /// Locations, places, aisles and rows, where rows are for them.
    areas: [Vec<AreaRings>; 4],
}

impl<'a> NamedGround<'a> {
    fn of(context: &'a MapContext, rows: &[NameRow]) -> Self {
        let mut of_face: HashMap<FaceId, Vec<usize>> = HashMap::new();
        for (index, location) in context.layout.locations.iter().enumerate() {
            of_face.entry(location.face).or_default().push(index);
        }
        let is_wanted = |wanted| {
            rows.iter().any(|row| matches!(row.target, NameTarget::Area { collection, .. } if collection == wanted))
        };
        let back = context.record.to_site().inverse();
        let in_map = |grounds: Vec<AreaRings>| {
            let moved = |ring: Vec<Point>| ring.into_iter().map(|point| back.apply(point)).collect::<Vec<_>>();
            grounds.into_iter().map(|ground| ground.into_iter().map(moved).collect()).collect::<Vec<AreaRings>>()
        };
        let outline = |location: &Location| {
            vec![location.outline.iter().map(|&point| context.analysis.frame.to_map(point)).collect()]
        };
        let collections =
            [NamedCollection::Locations, NamedCollection::Places, NamedCollection::Aisles, NamedCollection::Rows];
        let areas = collections.map(|collection| match kind_of(collection) {
            _ if !is_wanted(collection) => Vec::new(),
            None => context.layout.locations.iter().map(outline).collect(),
            Some(kind) => in_map(grounds(context, kind)),
        });
        Self { context, of_face, areas }
    }

    /// What lies under a row; why nothing does.
    fn find(&self, target: &NameTarget) -> Result<Nameable, String> {
        match target {
            NameTarget::Point(point) => self.at(self.context.analysis.frame.to_grid(*point)).map(Nameable::Location),
            NameTarget::Area { collection, rings } => {
                let found = greatest_overlap(rings, &self.areas[*collection as usize]);
                let index = found.filter(|(_, share)| *share >= LEAST_COMMON).map(|(index, _)| index);
                let index = index.ok_or_else(|| match found {
                    Some((_, share)) => format!("covers nothing by half: the best by {:.0} %", share * 100.0),
                    None => "covers nothing".to_owned(),
                })?;
                Ok(kind_of(*collection).map_or(Nameable::Location(index), |kind| Nameable::Area(kind, index)))
            }
        }
    }

    /// The location that holds a point of the grid frame; which one is nearest where none does.
    fn at(&self, point: Point) -> Result<usize, String> {
        let locations = &self.context.layout.locations;
        let in_face = self.of_face.get(&self.context.site().face_at(point)).map(Vec::as_slice).unwrap_or_default();
        let holds = |&&index: &&usize| polygon::contains(std::slice::from_ref(&locations[index].outline), point);
        if let Some(&index) = in_face.iter().find(holds) {
            return Ok(index);
        }
        match nearest_location(&self.context.layout, point) {
            Some(nearest) if nearest.distance == 0.0 => Ok(nearest.location),
            Some(nearest) => Err(format!(
                "lies in no location: {} is nearest, {:.2} m away",
                locations[nearest.location].code, nearest.distance
            )),
            None => Err("lies in no location: the map has none".to_owned()),
        }
    }

    fn words(&self, what: Nameable) -> String {
        match what {
            Nameable::Location(index) => format!("location {}", self.context.layout.locations[index].code),
            Nameable::Area(kind, index) => {
                let what = match kind {
                    AreaKind::Place => "place",
                    AreaKind::Aisle => "aisle",
                    AreaKind::Row => "row",
                };
                format!("{what} {}", self.context.area_id(kind, index))
            }
        }
    }
}

/// The kind of areas of a collection; `None` for the locations.
const fn kind_of(collection: NamedCollection) -> Option<AreaKind> {
    match collection {
        NamedCollection::Locations => None,
        NamedCollection::Places => Some(AreaKind::Place),
        NamedCollection::Aisles => Some(AreaKind::Aisle),
        NamedCollection::Rows => Some(AreaKind::Row),
    }
}
