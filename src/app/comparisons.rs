//! What changed: between two maps, and between two versions of the labels of one.

use std::sync::Arc;

use stillage_core::Watch;
use stillage_core::alignment::{self, SiteAlignment};
use stillage_core::arrangement::FaceId;
use stillage_core::compare::{self, ComparedPlace, Comparison, Footprint, LabelChange};
use stillage_core::geometry::RigidMotion;
use stillage_core::layout::{Location, OccupancyState};
use uuid::Uuid;

use super::context::GeometricLevel;
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

/// Two versions of the labels of one analysis side by side.
#[derive(Debug)]
pub struct LabelComparison {
    /// The version in force.
    pub version: u64,
    /// The faces whose label changed.
    pub faces: Vec<LabelChange>,
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

    /// What changed since a version of the labels that were made on the analysis in force; 0 is the suggestion.
    pub async fn label_changes(&self, caller: &Caller, map: Uuid, since: u64) -> Result<LabelComparison, AppError> {
        let context = self.context(caller, map).await?;
        let versions = self.store.semantics_versions(caller.tenant(), map).await?;
        let decision = versions.into_iter().find(|record| record.version == since);
        if decision.is_none() && since > 0 {
            return Err(AppError::not_found("version", since.to_string()));
        }
        if decision.as_ref().is_some_and(|record| record.analysis != context.analysis_id) {
            let detail = format!("version {since} labels another analysis, whose faces have other numbers");
            return Err(AppError::Conflict(detail));
        }
        let (site, _) = self.carried_registry(caller, &context).await?;
        let now = Arc::clone(&context);
        let earlier = off_the_runtime(move || {
            let analysis = (now.analysis_id, now.semantics.created);
            let (level, layout) = (GeometricLevel::of(&now), now.semantics.layout.clone());
            let earlier = level.read_under(now.record.clone(), analysis, decision, layout)?;
            let codes = codes_of(&site.registry, &earlier);
            Ok::<_, AppError>(earlier.with_codes(&site.registry, codes))
        })
        .await?;
        let (before, now) = (places(&earlier, &RigidMotion::identity()), places(&context, &RigidMotion::identity()));
        let comparison = compare::compare(&before, &now);
        let faces = compare::compare_labels(face_labels(&earlier), face_labels(&context));
        Ok(LabelComparison { version: context.semantics.version, faces, before, now, comparison })
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

/// The label of every face but the unbounded one, number 0.
pub(super) fn face_labels(context: &MapContext) -> impl Iterator<Item = (u32, &str)> {
    (1..context.analysis.faces.len() as u32).map(|face| (face, context.semantic.label(FaceId(face)).id.as_str()))
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
