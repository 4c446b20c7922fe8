//! Analyses of a map as they would answer if they were in force.

use std::sync::Arc;

use uuid::Uuid;

use super::carrying::is_to_be_carried;
use super::context::Decided;
use super::geometric_level::GeometricLevel;
use super::registries::codes_of;
use super::{AnalysisRecord, App, AppError, Caller, MapContext, ReadingComparison, SemanticsRecord};
use crate::blocking::off_the_runtime;
use crate::records::CarryRecord;
use crate::store::{BlobId, now};

/// An analysis as it would answer.
#[derive(Debug)]
pub struct Proposal {
    /// The map under this analysis, with the codes and names that the registry gives now; what answers now, where it is in
    /// force.
    pub context: Arc<MapContext>,
    /// What would become of the labels that people gave on another analysis; none where there are none, or where this
    /// analysis has labels of its own.
    pub carried: Option<CarryRecord>,
}

impl App {
    /// An analysis of a map by its id.
    pub async fn analysis(&self, caller: &Caller, map: Uuid, analysis: Uuid) -> Result<AnalysisRecord, AppError> {
        let found = self.analyses(caller, map).await?.into_iter().find(|record| record.id == analysis);
        found.ok_or_else(|| AppError::not_found("analysis", analysis))
    }

    /// A map as it would answer if an analysis was activated now. Nothing is stored, and nothing is kept in memory: it takes
    /// as long as the first question after an activation.
    pub async fn proposal(&self, caller: &Caller, map: Uuid, analysis: Uuid) -> Result<Proposal, AppError> {
        let in_force = self.context(caller, map).await?;
        let record = self.analysis(caller, map, analysis).await?;
        if in_force.analysis_id == analysis {
            return Ok(Proposal { context: in_force, carried: None });
        }
        let mut geometry = self.geometry_of(caller, record.clone()).await?;
        let versions = self.semantics_versions(caller, map).await?;
        let own = versions.iter().find(|version| version.analysis == analysis).cloned();
        let before = decided(&in_force.semantics, &versions).clone();
        let semantics = if is_to_be_carried(&before, analysis, own.as_ref()) {
            let known = (before.analysis == in_force.analysis_id).then(|| Arc::clone(&in_force));
            let blob = self.analysis_blob(caller, map, before.analysis).await?;
            let earlier = self.earlier_analysis(known, &blob, &geometry).await?;
            let (onto, replaces) = ((map, analysis), own.map_or(0, |version| version.version));
            let (row, level) = self.carried_row(caller, onto, &geometry, (before, earlier), replaces).await?;
            geometry = level;
            Some(row.unsaved(now()))
        } else {
            own
        };
        let carried = semantics.as_ref().and_then(|version| version.carried.clone());
        let (correction_ids, list) = self.corrections_of(caller, map, semantics.as_ref()).await?;
        let (site, _) = self.carried_registry(caller, &in_force).await?;
        let (seen, layout) = (in_force.record.clone(), in_force.semantics.layout.clone());
        let read = move || {
            let decided = Decided { semantics, correction_ids };
            let read = geometry.corrected(list).read_under(seen, (record.id, record.created), decided, layout)?;
            let codes = codes_of(&site.registry, &read);
            Ok::<_, AppError>(read.with_codes(&site.registry, codes))
        };
        Ok(Proposal { context: Arc::new(off_the_runtime(read).await?), carried })
    }

    /// What would change if an analysis was activated now. Nothing changes where it is in force.
    pub async fn analysis_changes(
        &self,
        caller: &Caller,
        map: Uuid,
        analysis: Uuid,
    ) -> Result<ReadingComparison, AppError> {
        let (before, now) = (self.context(caller, map).await?, self.proposal(caller, map, analysis).await?.context);
        off_the_runtime(move || Ok(ReadingComparison::of(before, now))).await
    }

    /// The part of an analysis that no decision changes, from the store, when it is its turn.
    async fn geometry_of(&self, caller: &Caller, record: AnalysisRecord) -> Result<GeometricLevel, AppError> {
        let _permit = self.decoders.acquire().await.map_err(|_| AppError::Unavailable)?;
        self.stored_geometry(caller, record).await
    }

    /// The part of an analysis that no decision changes, from the store.
    pub(super) async fn stored_geometry(
        &self,
        caller: &Caller,
        record: AnalysisRecord,
    ) -> Result<GeometricLevel, AppError> {
        let source = self.store.map_source(caller.tenant(), record.map).await?;
        let source = source.ok_or_else(|| AppError::not_found("map", record.map))?;
        let blob = self.analysis_blob(caller, record.map, record.id).await?;
        let source = self.stored_upload(record.map, &source).await?;
        let blob = self.stored_analysis(&source, &record, &blob).await?;
        let limits = self.config.limits;
        off_the_runtime(move || GeometricLevel::read(&source, &blob, &record, &limits)).await
    }

    async fn analysis_blob(&self, caller: &Caller, map: Uuid, analysis: Uuid) -> Result<BlobId, AppError> {
        let blob = self.store.analysis_blob(caller.tenant(), map, analysis).await?;
        blob.ok_or_else(|| AppError::not_found("analysis by this version of the algorithms", analysis))
    }
}

/// The decision that a person made: the one in force, or where that was carried over, the one that it comes from.
fn decided<'a>(in_force: &'a SemanticsRecord, versions: &'a [SemanticsRecord]) -> &'a SemanticsRecord {
    let from = in_force.carried.as_ref().filter(|carried| carried.map.is_none()).map(|carried| carried.from);
    versions.iter().find(|version| Some(version.version) == from).unwrap_or(in_force)
}
