//! The analysed map in memory: built once, shared by all who ask, replaced when something about the map changes.
//!
//! A context is kept with the [`MapState`] it answers for: version of the record, analysis, version of the semantics. Each
//! question reads the state from the store first, so that it sees every change, another process's too.

use std::sync::{Arc, Mutex, PoisonError};

use stillage_core::arrangement::CellFaces;
use stillage_core::layout::{self, Location};
use stillage_core::semantics::{self, Assignment, RuleSet, RuleSetDraft, SemanticMap, Suggestion};
use stillage_core::{Analysis, OccupancyGrid};
use tokio::sync::OnceCell;
use uuid::Uuid;

use super::features::FeatureCache;
use super::rule_sets::DEFAULT_RULE_SET;
use super::{AnalysisRecord, App, AppError, Caller, MapRecord, SemanticsOrigin, SemanticsRecord};
use crate::blocking::off_the_runtime;
use crate::ingest::{self, Limits, MapSource};
use crate::store::{Blob, MapState, Snapshot};

/// An analysed map in memory, ready to answer. Shared, immutable; replaced when the semantics change.
#[derive(Debug)]
pub struct MapContext {
    /// The map.
    pub record: MapRecord,
    /// Its cells.
    pub grid: Arc<OccupancyGrid>,
    /// The analysis in force.
    pub analysis_id: Uuid,
    /// The geometric level.
    pub analysis: Arc<Analysis>,
    /// The face of every cell.
    pub cells: Arc<CellFaces>,
    /// The decision in force, or the suggestion.
    pub semantics: SemanticsRecord,
    /// The human level.
    pub semantic: SemanticMap,
    /// What each category is proposed to be under the rule set in force.
    pub suggestions: Vec<Suggestion>,
    /// The storage locations, by code.
    pub locations: Vec<Location>,
    /// What was written of it so far.
    pub(super) features: FeatureCache,
}

impl App {
    /// The analysed map, from memory or the store. However many ask at once, it is built once.
    pub async fn context(&self, caller: &Caller, map: Uuid) -> Result<Arc<MapContext>, AppError> {
        let state = self.store.map_state(caller.tenant(), map).await?.ok_or_else(|| AppError::not_found("map", map))?;
        let entry = self.contexts.entry(map, state);
        let built = entry.context.get_or_try_init(|| self.build_context(caller, map, entry.previous.clone())).await;
        self.contexts.settle(&entry, built.is_ok());
        built.cloned()
    }

    async fn build_context(
        &self,
        caller: &Caller,
        map: Uuid,
        previous: Option<Arc<MapContext>>,
    ) -> Result<Arc<MapContext>, AppError> {
        let snapshot =
            self.store.snapshot(caller.tenant(), map).await?.ok_or_else(|| AppError::not_found("map", map))?;
        let Snapshot { record, source, analysis, semantics, job } = snapshot;
        let (analysis, blob) = analysis.ok_or(AppError::NotAnalysed { map, job })?;
        let _permit = self.decoders.acquire().await.map_err(|_| AppError::Unavailable)?;
        let geometry = if let Some(previous) = previous.filter(|previous| previous.analysis_id == analysis.id) {
            GeometricLevel::of(&previous)
        } else {
            let (source, blob) = (self.store.blobs().get(&source).await?, self.store.blobs().get(&blob).await?);
            let (limits, record) = (self.config.limits, analysis.clone());
            off_the_runtime(move || GeometricLevel::read(&source, &blob, &record, &limits)).await?
        };
        off_the_runtime(move || geometry.read_under(record, &analysis, semantics).map(Arc::new)).await
    }
}

/// The part of a context that no human decision changes.
struct GeometricLevel {
    grid: Arc<OccupancyGrid>,
    analysis: Arc<Analysis>,
    cells: Arc<CellFaces>,
}

impl GeometricLevel {
    fn of(context: &MapContext) -> Self {
        let MapContext { grid, analysis, cells, .. } = context;
        Self { grid: Arc::clone(grid), analysis: Arc::clone(analysis), cells: Arc::clone(cells) }
    }

    fn read(source: &Blob, blob: &Blob, record: &AnalysisRecord, limits: &Limits) -> Result<Self, AppError> {
        let grid = ingest::decode(&source.decode::<MapSource>()?, &record.options.grid, limits)?.grid;
        let analysis: Analysis = blob.decode()?;
        let cells = CellFaces::rasterize(&analysis.subdivision, grid.width(), grid.height(), grid.resolution());
        Ok(Self { grid: Arc::new(grid), analysis: Arc::new(analysis), cells: Arc::new(cells) })
    }

    /// Adds the human level: the stored decision, or the suggestion under the default rule set.
    fn read_under(
        self,
        record: MapRecord,
        analysis: &AnalysisRecord,
        decision: Option<SemanticsRecord>,
    ) -> Result<MapContext, AppError> {
        let rule_set = decision.as_ref().map_or_else(|| Ok(RuleSet::warehouse()), |made| read_rule_set(&made.draft))?;
        let suggestions = semantics::suggest(&self.analysis, &rule_set);
        let semantics = decision.unwrap_or_else(|| SemanticsRecord {
            rule_set: DEFAULT_RULE_SET.to_owned(),
            draft: rule_set.draft().clone(),
            assignment: Assignment::suggested(&suggestions, &rule_set),
            version: 0,
            origin: SemanticsOrigin::Suggested,
            created: analysis.created,
        });
        let semantic = semantics::apply(&self.analysis, &rule_set, &semantics.assignment)?;
        let locations = layout::locations(&self.analysis, &semantic);
        let Self { grid, analysis: geometric, cells } = self;
        Ok(MapContext {
            record,
            grid,
            analysis_id: analysis.id,
            analysis: geometric,
            cells,
            semantics,
            semantic,
            suggestions,
            locations,
            features: FeatureCache::default(),
        })
    }
}

/// The rule set behind a draft.
pub(super) fn read_rule_set(draft: &RuleSetDraft) -> Result<RuleSet, AppError> {
    Ok(draft.clone().check()?)
}

/// The contexts in memory, those used last first.
#[derive(Debug)]
pub(super) struct ContextCache {
    capacity: usize,
    entries: Mutex<Vec<Arc<Entry>>>,
}

/// A context that is there or being built.
#[derive(Debug)]
pub(super) struct Entry {
    map: Uuid,
    state: MapState,
    context: OnceCell<Arc<MapContext>>,
    /// What was known before the last change: its geometry need not be read again.
    previous: Option<Arc<MapContext>>,
}

impl ContextCache {
    pub(super) const fn new(capacity: usize) -> Self {
        Self { capacity, entries: Mutex::new(Vec::new()) }
    }

    /// Forgets a map.
    pub(super) fn remove(&self, map: Uuid) {
        self.entries().retain(|entry| entry.map != map);
    }

    /// The entry of a map in this state, moved to the front. One of an earlier state gives way to a new one, which keeps
    /// what was built before: whoever is still building it answers those who asked before the change, and nobody else.
    fn entry(&self, map: Uuid, state: MapState) -> Arc<Entry> {
        let mut entries = self.entries();
        let found = entries.iter().position(|entry| entry.map == map).map(|index| entries.remove(index));
        let entry = match found {
            Some(entry) if entry.state == state => entry,
            earlier => {
                let previous = earlier.and_then(|stale| stale.context.get().or(stale.previous.as_ref()).cloned());
                Arc::new(Entry { map, state, context: OnceCell::new(), previous })
            }
        };
        entries.insert(0, Arc::clone(&entry));
        entry
    }

    /// Keeps an entry that holds something, and as many others as fit; drops one that came to nothing, so that questions
    /// about maps that do not exist push nothing out.
    fn settle(&self, settled: &Arc<Entry>, is_built: bool) {
        let mut entries = self.entries();
        if !is_built {
            entries.retain(|entry| !Arc::ptr_eq(entry, settled));
            return;
        }
        let mut kept = 0;
        entries.retain(|entry| {
            let is_kept = entry.context.initialized() || entry.previous.is_some();
            kept += usize::from(is_kept);
            // One that nobody builds any more was given up by whoever asked.
            if is_kept { kept <= self.capacity.max(1) } else { Arc::strong_count(entry) > 1 }
        });
    }

    fn entries(&self) -> std::sync::MutexGuard<'_, Vec<Arc<Entry>>> {
        // Every statement above leaves the list whole.
        self.entries.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
