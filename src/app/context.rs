//! The analysed map in memory: built once, shared by all who ask, replaced when something about the map changes.
//!
//! A context is kept with the [`MapState`] it answers for: version of the record, analysis,
//! version of the semantics. Each question asks for the state first, so that it sees every change.

use std::sync::Arc;

use jiff::Timestamp;
use stillage_core::Analysis;
use stillage_core::layout::{self, LayoutOptions, LayoutSpec};
use stillage_core::semantics::{self, Assignment, RuleSet, RuleSetDraft};
use uuid::Uuid;

use super::geometric_level::GeometricLevel;
use super::map_context::{FeatureCache, MapContext};
use super::registries::{numbered, site_to_grid};
use super::routers::RouterCache;
use super::{App, AppError, Caller, MapRecord, SemanticsOrigin, SemanticsRecord};
use crate::blocking::off_the_runtime;
use crate::features::MapNames;
use crate::records::CorrectionId;
use crate::store::{MapState, Snapshot};

impl App {
    /// The analysed map, from memory or the store. However many ask at once, it is built once.
    pub async fn context(&self, caller: &Caller, map: Uuid) -> Result<Arc<MapContext>, AppError> {
        let state = self.map_state(caller, map).await?.ok_or_else(|| AppError::not_found("map", map))?;
        let entry = self.contexts.entry(map, state);
        let built = entry.context.get_or_try_init(|| self.build_context(caller, map, entry.previous())).await;
        self.contexts.settle(&entry, built.is_ok());
        built.cloned()
    }

    /// The state of a map, if there is one: from memory where nothing was written since it was read.
    pub async fn map_state(&self, caller: &Caller, map: Uuid) -> Result<Option<MapState>, AppError> {
        let writes = self.store.writes();
        if let Some(state) = writes.and_then(|writes| self.states.get(writes, caller.tenant(), map)) {
            return Ok(Some(state));
        }
        let state = self.store.map_state(caller.tenant(), map).await?;
        if let (Some(writes), Some(state)) = (writes, state) {
            self.states.put(writes, caller.tenant(), map, state);
        }
        Ok(state)
    }

    async fn build_context(
        &self,
        caller: &Caller,
        map: Uuid,
        previous: Option<Arc<MapContext>>,
    ) -> Result<Arc<MapContext>, AppError> {
        let snapshot =
            self.store.snapshot(caller.tenant(), map).await?.ok_or_else(|| AppError::not_found("map", map))?;
        let Snapshot { record, source, analysis, semantics, layout, decided_before, job } = snapshot;
        let (analysis, blob) = analysis.ok_or(AppError::NotAnalysed { map, job })?;
        let _permit = self.decoders.acquire().await.map_err(|_| AppError::Unavailable)?;
        let geometry = if let Some(previous) = previous.as_ref().filter(|known| known.analysis_id == analysis.id) {
            previous.geometric_level()
        } else {
            let source = self.stored_upload(map, &source).await?;
            let blob = self.stored_analysis(&source, &analysis, &blob).await?;
            let (limits, record) = (self.config.limits, analysis.clone());
            off_the_runtime(move || GeometricLevel::read(&source, &blob, &record, &limits)).await?
        };
        let (id, created) = (analysis.id, analysis.created);
        let semantics = match (decided_before, semantics) {
            (Some(before), semantics) => self.carry(caller, (map, id), &geometry, before, semantics, previous).await?,
            (None, None) => self.carry_from_site(caller, &record, id, &geometry, &layout).await?,
            (None, semantics) => semantics,
        };
        let (ids, list) = self.corrections_of(caller, map, semantics.as_ref()).await?;
        let geometry = self.last_corrected.take(id, &list).unwrap_or(geometry);
        let read = move || {
            let decided = Decided { semantics, correction_ids: ids };
            geometry.corrected(list).read_under(record, (id, created), decided, layout)
        };
        let context = off_the_runtime(read).await?;
        let (site, codes) = self.carried_registry(caller, &context).await?;
        Ok(Arc::new(off_the_runtime(move || context.with_codes(&site.registry, codes)).await))
    }
}

impl GeometricLevel {
    /// Adds the human level: the stored decision, of which the level has the corrections, or the suggestion under the default
    /// rule set. `analysis` is its id and when it was made; `suggested_layout` goes with the suggestion. The locations have
    /// the codes of a fresh numbering.
    pub(super) fn read_under(
        self,
        record: MapRecord,
        (analysis_id, analysed_at): (Uuid, Timestamp),
        decided: Decided,
        suggested_layout: LayoutOptions,
    ) -> Result<MapContext, AppError> {
        let Decided { semantics: decision, correction_ids } = decided;
        let rule_set = decision.as_ref().map_or_else(|| Ok(RuleSet::default()), |made| read_rule_set(&made.draft))?;
        let suggestions = semantics::suggest(&self.analysed, &rule_set);
        let semantics = decision
            .unwrap_or_else(|| suggested_semantics(&self.analysed, (analysis_id, analysed_at), suggested_layout));
        let assignment = self.corrections.labelled(&semantics.assignment);
        let semantic = semantics::apply(&self.analysis, &rule_set, &assignment)?;
        let names = MapNames { faces: self.corrections.named_faces(), ..MapNames::default() };
        let Self { grid, analysed, analysis: geometric, cells, corrections } = self;
        let frame = *grid.frame();
        let layout_spec = LayoutSpec::wished(&semantics.layout, &geometric.options, &site_to_grid(&record, frame));
        let layout = layout::layout(&cells.map(&grid, &geometric, &semantic), &layout_spec);
        let numbered = numbered(&layout, frame, &record.to_site());
        Ok(MapContext {
            record,
            grid,
            analysis_id,
            analysed_at,
            analysed,
            analysis: geometric,
            cells,
            corrections,
            correction_ids,
            semantics,
            semantic,
            suggestions,
            numbered,
            layout,
            layout_spec,
            names,
            features: FeatureCache::default(),
            routers: RouterCache::default(),
        })
    }
}

/// What people decided on an analysis.
#[derive(Debug, Default)]
pub(super) struct Decided {
    /// The decision; `None` for the suggestion.
    pub(super) semantics: Option<SemanticsRecord>,
    /// The ids of its corrections.
    pub(super) correction_ids: Vec<CorrectionId>,
}

impl MapContext {
    /// The suggestion for its analysis, in the layout in force. Takes milliseconds: keep it off the runtime.
    #[must_use]
    pub fn suggested(&self) -> SemanticsRecord {
        suggested_semantics(&self.analysed, (self.analysis_id, self.analysed_at), self.semantics.layout.clone())
    }
}

/// The suggestion under the default rule set, for an analysis with this id and time.
fn suggested_semantics(
    analysis: &Analysis,
    (id, created): (Uuid, Timestamp),
    layout: LayoutOptions,
) -> SemanticsRecord {
    let rule_set = RuleSet::default();
    SemanticsRecord {
        analysis: id,
        rule_set: RuleSet::DEFAULT_ID.to_owned(),
        assignment: Assignment::suggested(&semantics::suggest(analysis, &rule_set), &rule_set),
        draft: rule_set.draft().clone(),
        layout,
        corrections: None,
        version: 0,
        origin: SemanticsOrigin::Suggested,
        carried: None,
        restores: None,
        created,
    }
}

/// The rule set behind a draft.
pub(super) fn read_rule_set(draft: &RuleSetDraft) -> Result<RuleSet, AppError> {
    Ok(draft.clone().check()?)
}
