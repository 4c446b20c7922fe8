//! What changed.

use serde::Serialize;
use stillage_core::compare::{ComparedPlace, Comparison, FaceDifference, LabelledFace, PlaceChange, PlaceMatch};
use utoipa::ToSchema;

use super::alignment::PairAlignmentView;
use super::face_difference::DifferenceCounts;
use super::id::Id;
use crate::app::{LocationComparison, MapComparison, ReadingComparison};
use crate::features::rounded;

/// What changed from one map to another.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = MapComparison)]
#[serde(rename_all = "camelCase")]
pub struct MapComparisonView {
    /// The map before. All coordinates are metres of its map frame.
    from: Id,
    /// The map now.
    to: Id,
    alignment: PairAlignmentView,
    locations: LocationChanges,
}

/// What changed since a version of the labels.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = LabelComparison)]
#[serde(rename_all = "camelCase")]
pub struct LabelComparisonView {
    /// The version before; 0 is the suggestion.
    since: u64,
    /// The version in force.
    version: u64,
    /// Faces with another label, by id. Those that corrections made or took away have one label only.
    faces: Vec<FaceChange>,
    locations: LocationChanges,
}

/// What would change if an analysis was put in force.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = AnalysisComparison)]
#[serde(rename_all = "camelCase")]
pub struct AnalysisComparisonView {
    /// The analysis in force.
    from: Id,
    /// The other one.
    to: Id,
    /// How many faces would be others.
    faces: DifferenceCounts,
    locations: LocationChanges,
}

/// A face with another label.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "camelCase")]
pub struct FaceChange {
    /// Id of the face; of one that is gone, its id before.
    face: u32,
    /// Label before.
    #[schema(example = "un")]
    before: Option<String>,
    /// Label now.
    #[schema(example = "pc")]
    now: Option<String>,
}

/// Storage locations that came, went or changed.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "camelCase")]
pub struct LocationChanges {
    /// Those that were not there.
    added: Vec<LocationMark>,
    /// Those that are no longer there.
    removed: Vec<LocationMark>,
    /// Those about which something is different.
    changed: Vec<LocationChange>,
    /// How many stayed as they were.
    unchanged: usize,
}

/// A location, by its code.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "camelCase")]
pub struct LocationMark {
    #[schema(example = "03-012")]
    code: String,
    /// Its centre, x and y, metres.
    centre: [f64; 2],
}

/// What is different about a location.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "camelCase")]
pub struct LocationChange {
    /// Its code now.
    #[schema(example = "03-012")]
    code: String,
    /// Its code before.
    code_before: String,
    /// What is different.
    changes: Vec<ChangeWord>,
    /// Its centre now, x and y, metres.
    centre: [f64; 2],
    /// How far its centre is from where it was, x and y, metres.
    shift_m: [f64; 2],
    /// Area in common as a share of the area of both together; 0 for one that is known by its code alone.
    overlap: f64,
    /// Its label before.
    label_before: String,
    /// Its label now.
    label: String,
}

/// A kind of change.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "lowercase")]
pub enum ChangeWord {
    /// Its centre is elsewhere.
    Moved,
    /// It has another label.
    Relabelled,
    /// It has another code.
    Recoded,
    /// It was empty and is occupied.
    Filled,
    /// It was occupied and is empty.
    Emptied,
}

impl From<&PlaceChange> for ChangeWord {
    fn from(change: &PlaceChange) -> Self {
        match change {
            PlaceChange::Moved => Self::Moved,
            PlaceChange::Relabelled => Self::Relabelled,
            PlaceChange::Recoded => Self::Recoded,
            PlaceChange::Filled => Self::Filled,
            PlaceChange::Emptied => Self::Emptied,
        }
    }
}

impl From<FaceDifference> for FaceChange {
    fn from(FaceDifference { before, now, .. }: FaceDifference) -> Self {
        let face = now.as_ref().or(before.as_ref()).map_or(0, |face| face.face.0);
        let label = |face: Option<LabelledFace>| face.map(|face| face.label);
        Self { face, before: label(before), now: label(now) }
    }
}

impl LocationChanges {
    fn of(made: &ReadingComparison) -> Self {
        let LocationComparison { before, now, comparison } = made.locations();
        Self::new(&before, &now, &comparison)
    }

    fn new(before: &[ComparedPlace], now: &[ComparedPlace], comparison: &Comparison) -> Self {
        let marks = |places: &[ComparedPlace], indices: &[usize]| {
            let mut marks: Vec<LocationMark> = indices.iter().map(|&index| LocationMark::of(&places[index])).collect();
            marks.sort_by(|one, other| one.code.cmp(&other.code));
            marks
        };
        let is_changed = |pair: &&PlaceMatch| !pair.changes.is_empty();
        let changed = comparison.matched.iter().filter(is_changed);
        let mut changed: Vec<LocationChange> =
            changed.map(|pair| LocationChange::of(&before[pair.old], &now[pair.new], pair)).collect();
        changed.sort_by(|one, other| one.code.cmp(&other.code));
        let unchanged = comparison.matched.len() - changed.len();
        Self { added: marks(now, &comparison.added), removed: marks(before, &comparison.removed), changed, unchanged }
    }
}

impl LocationMark {
    fn of(place: &ComparedPlace) -> Self {
        Self { code: place.code.clone(), centre: centre(place) }
    }
}

impl LocationChange {
    fn of(before: &ComparedPlace, now: &ComparedPlace, pair: &PlaceMatch) -> Self {
        Self {
            code: now.code.clone(),
            code_before: before.code.clone(),
            changes: pair.changes.iter().map(Into::into).collect(),
            centre: centre(now),
            shift_m: [rounded(pair.shift.x), rounded(pair.shift.y)],
            overlap: rounded(pair.share),
            label_before: before.label.clone(),
            label: now.label.clone(),
        }
    }
}

fn centre(place: &ComparedPlace) -> [f64; 2] {
    [rounded(place.footprint.center.x), rounded(place.footprint.center.y)]
}

impl MapComparisonView {
    /// The comparison of two maps.
    #[must_use]
    pub fn new(from: Id, to: Id, made: &MapComparison) -> Self {
        let locations = LocationChanges::new(&made.before, &made.now, &made.comparison);
        Self { from, to, alignment: made.alignment.into(), locations }
    }
}

impl AnalysisComparisonView {
    /// What would change. Takes milliseconds: keep it off the runtime.
    #[must_use]
    pub fn new(made: &ReadingComparison) -> Self {
        Self {
            from: Id(made.before.analysis_id),
            to: Id(made.now.analysis_id),
            faces: DifferenceCounts::of(&made.faces),
            locations: LocationChanges::of(made),
        }
    }
}

impl LabelComparisonView {
    /// What changed since a version.
    #[must_use]
    pub fn new(since: u64, made: ReadingComparison) -> Self {
        let locations = LocationChanges::of(&made);
        let is_relabelled = |face: &FaceDifference| {
            let label = |face: &Option<LabelledFace>| face.as_ref().map(|face| face.label.clone());
            label(&face.before) != label(&face.now)
        };
        let faces = made.faces.into_iter().filter(is_relabelled).map(Into::into).collect();
        Self { since, version: made.now.semantics.version, faces, locations }
    }
}
