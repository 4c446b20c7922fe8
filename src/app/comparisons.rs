//! What changed: between two maps, and between two versions of the semantics of one.

use std::sync::Arc;

use stillage_core::Watch;
use stillage_core::alignment::{self, SiteAlignment};
use stillage_core::arrangement::FaceId;
use stillage_core::compare::{self, ComparedPlace, Comparison, FaceDifference, Footprint, LabelledFaces};
use stillage_core::geometry::RigidMotion;
use stillage_core::layout::{Location, OccupancyState};
use uuid::Uuid;

use super::context::Decided;
use super::registries::codes_of;
use super::{App, AppError, Caller, MapContext};
use crate::blocking::off_the_runtime;

/// How the second of two maps lies on the first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairAlignment {
    /// From the map frame of the second to that of the first.
    pub motion: RigidMotion,
    /// How surely, where the two were aligned to one another; `None` where they are by way of their site.
    pub found: Option<SiteAlignment>,
}

/// Two maps side by side.
#[derive(Debug)]
pub struct MapComparison {
    /// The places of the first map, in its frame.
    pub before: Vec<ComparedPlace>,
    /// The places of the second map, in the frame of the first.
    pub now: Vec<ComparedPlace>,
    /// How the second lies on the first.
    pub alignment: PairAlignment,
    /// Which places are the same, and what changed about them.
    pub comparison: Comparison,
}

/// Two readings of one map side by side: two versions of the semantics, or two analyses.
#[derive(Debug)]
pub struct ReadingComparison {
    /// The map as it was.
    pub before: Arc<MapContext>,
    /// The map as it is, or was later.
    pub now: Arc<MapContext>,
    /// The faces that came, changed or went.
    pub faces: Vec<FaceDifference>,
}

/// The locations of two readings of a map side by side.
#[derive(Debug)]
pub struct LocationComparison {
    /// The locations then.
    pub before: Vec<ComparedPlace>,
    /// The locations now.
    pub now: Vec<ComparedPlace>,
    /// Which locations are the same, and what changed about them.
    pub comparison: Comparison,
}

impl App {
    /// What changed from one map to another of the same site. Maps that were not uploaded as one site are aligned first.
    pub async fn compare_maps(&self, caller: &Caller, before: Uuid, now: Uuid) -> Result<MapComparison, AppError> {
        let (first, second) = (self.context(caller, before).await?, self.context(caller, now).await?);
        off_the_runtime(move || MapComparison::of(&first, &second)).await
    }

    /// What changed from one version of the semantics to another, both made on the analysis in force; 0 is the suggestion, and
    /// without `version` it is the one in force.
    pub async fn version_changes(
        &self,
        caller: &Caller,
        map: Uuid,
        since: u64,
        version: Option<u64>,
    ) -> Result<ReadingComparison, AppError> {
        let context = self.context(caller, map).await?;
        let before = self.context_of_version(caller, &context, since).await?;
        let now = match version {
            None => context,
            Some(version) => self.context_of_version(caller, &context, version).await?,
        };
        off_the_runtime(move || Ok(ReadingComparison::of(before, now))).await
    }

    /// A map as it was under a version of its semantics. Its locations have the codes that the registry gives them now.
    async fn context_of_version(
        &self,
        caller: &Caller,
        context: &Arc<MapContext>,
        version: u64,
    ) -> Result<Arc<MapContext>, AppError> {
        if version == context.semantics.version {
            return Ok(Arc::clone(context));
        }
        let map = context.record.id;
        let versions = self.store.semantics_versions(caller.tenant(), map).await?;
        let semantics = versions.into_iter().find(|record| record.version == version);
        if semantics.is_none() && version > 0 {
            return Err(AppError::not_found("version", version.to_string()));
        }
        if semantics.as_ref().is_some_and(|record| record.analysis != context.analysis_id) {
            let detail = format!("version {version} is of another analysis of the map: activate that one first");
            return Err(AppError::Conflict(detail));
        }
        let (correction_ids, list) = self.corrections_of(caller, map, semantics.as_ref()).await?;
        let (site, _) = self.carried_registry(caller, context).await?;
        let on = Arc::clone(context);
        off_the_runtime(move || {
            let (analysis, layout) = ((on.analysis_id, on.analysed_at), on.semantics.layout.clone());
            let level = on.geometric_level().corrected(list);
            let decided = Decided { semantics, correction_ids };
            let earlier = level.read_under(on.record.clone(), analysis, decided, layout)?;
            let codes = codes_of(&site.registry, &earlier);
            Ok(Arc::new(earlier.with_codes(&site.registry, codes)))
        })
        .await
    }
}

impl ReadingComparison {
    /// What changed from one reading of a map to another. O(cells): keep it off the runtime.
    #[must_use]
    pub fn of(before: Arc<MapContext>, now: Arc<MapContext>) -> Self {
        Self { faces: face_differences(&before, &now), before, now }
    }

    /// What changed about the locations. Takes milliseconds: keep it off the runtime.
    #[must_use]
    pub fn locations(&self) -> LocationComparison {
        let (before, now) =
            (places(&self.before, &RigidMotion::identity()), places(&self.now, &RigidMotion::identity()));
        let comparison = compare::compare(&before, &now);
        LocationComparison { before, now, comparison }
    }
}

impl MapComparison {
    /// What changed from one map to another.
    pub(crate) fn of(first: &MapContext, second: &MapContext) -> Result<Self, AppError> {
        let alignment = align(first, second)?;
        let (before, now) = (places(first, &RigidMotion::identity()), places(second, &alignment.motion));
        let comparison = compare::compare(&before, &now);
        Ok(Self { before, now, alignment, comparison })
    }
}

/// How the second map lies on the first.
fn align(first: &MapContext, second: &MapContext) -> Result<PairAlignment, AppError> {
    let (one, other) = (&first.record, &second.record);
    if one.site == other.site {
        let found = other.alignment.filter(|record| record.previous == one.id).map(|record| record.found);
        return Ok(PairAlignment { motion: other.to_site().then(&one.to_site().inverse()), found });
    }
    let found = alignment::align(&second.grid, &first.grid, &Watch::unwatched()).expect("nobody stops it");
    let found = found.map_err(|refusal| AppError::NotSameSite(format!("{refusal}: compare maps of one site")))?;
    Ok(PairAlignment { motion: found.motion, found: Some(found) })
}

/// What is different about the faces of a map. O(cells) where it was corrected otherwise.
pub(super) fn face_differences(before: &MapContext, now: &MapContext) -> Vec<FaceDifference> {
    let [of_before, of_now] = [before, now].map(face_labels);
    compare::compare_faces(
        LabelledFaces { cells: &before.cells.faces, labels: &of_before },
        LabelledFaces { cells: &now.cells.faces, labels: &of_now },
    )
}

/// Id of the label of every face.
fn face_labels(context: &MapContext) -> Vec<&str> {
    (0..context.analysis.faces.len() as u32).map(|face| context.semantic.label(FaceId(face)).id.as_str()).collect()
}

/// The locations of a map after a motion of its map frame.
fn places(context: &MapContext, motion: &RigidMotion) -> Vec<ComparedPlace> {
    let motion = context.grid.frame().motion().then(motion);
    let place = |location: &Location| ComparedPlace {
        code: location.code.clone(),
        footprint: Footprint { outline: location.outline.clone(), center: location.center }.moved(&motion),
        label: context.semantic.label(location.face).id.clone(),
        occupied: match location.occupancy.state {
            OccupancyState::Occupied => Some(true),
            OccupancyState::Empty => Some(false),
            OccupancyState::Unknown => None,
        },
    };
    context.layout.locations.iter().map(place).collect()
}
