//! The analysed map in memory: everything a question about it needs.

use std::sync::{Arc, OnceLock};

use jiff::Timestamp;
use stillage_core::graph::NavigationGraph;
use stillage_core::layout::{Layout, LayoutSpec};
use stillage_core::registry::NumberedLocation;
use stillage_core::routing::{Blocked, Router};
use stillage_core::semantics::{SemanticMap, Suggestion};
use stillage_core::{Analysis, OccupancyGrid, SiteCells, SiteMap};
use uuid::Uuid;

use super::geometric_level::{AppliedCorrections, GeometricLevel};
use super::routers::RouterCache;
use crate::coordinates::{Crs, Transform};
use crate::features::query::PropertySelection;
use crate::features::{self, AnalysedMap, Collection, Feature, MapNames};
use crate::formats::FeatureTexts;
use crate::records::{CorrectionId, MapRecord, SemanticsRecord};
use crate::store::MapState;

/// An analysed map in memory, ready to answer. Shared, immutable; replaced when the semantics change.
#[derive(Debug)]
pub struct MapContext {
    /// The map.
    pub record: MapRecord,
    /// Its cells.
    pub grid: Arc<OccupancyGrid>,
    /// The analysis in force.
    pub analysis_id: Uuid,
    /// When it was made.
    pub(super) analysed_at: Timestamp,
    /// The geometric level as it was made.
    pub(super) analysed: Arc<Analysis>,
    /// The geometric level under the corrections.
    pub analysis: Arc<Analysis>,
    /// What is read off its cells.
    pub cells: Arc<SiteCells>,
    /// The corrections, and what became of them.
    pub corrections: Arc<AppliedCorrections>,
    /// Their ids, in the same order.
    pub correction_ids: Vec<CorrectionId>,
    /// The decision in force, or the suggestion.
    pub semantics: SemanticsRecord,
    /// The human level.
    pub semantic: SemanticMap,
    /// What each category is proposed to be under the rule set in force.
    pub suggestions: Vec<Suggestion>,
    /// Storage locations, aisles and rows.
    pub layout: Layout,
    /// How they were cut, numbered and approached.
    pub layout_spec: LayoutSpec,
    /// What people call its things.
    pub names: MapNames,
    /// Its locations with the codes of a fresh numbering, in the frame of the site.
    pub(super) numbered: Vec<NumberedLocation>,
    /// Its collections, made when they are first asked for.
    pub(super) features: FeatureCache,
    /// Its routers, likewise.
    pub(super) routers: RouterCache,
}

/// The features of the collections that were asked for, and their texts.
#[derive(Debug, Default)]
pub struct FeatureCache {
    features: [OnceLock<Vec<Feature>>; Collection::ALL.len()],
    texts: [OnceLock<FeatureTexts>; Collection::ALL.len()],
}

impl MapContext {
    /// The state of the map that this answers for.
    #[must_use]
    pub const fn state(&self) -> MapState {
        MapState { version: self.record.version, analysis: Some(self.analysis_id), semantics: self.semantics.version }
    }

    /// What it was made from.
    pub(super) fn geometric_level(&self) -> GeometricLevel {
        GeometricLevel {
            grid: Arc::clone(&self.grid),
            analysed: Arc::clone(&self.analysed),
            analysis: Arc::clone(&self.analysis),
            cells: Arc::clone(&self.cells),
            corrections: Arc::clone(&self.corrections),
        }
    }

    /// The map as [`crate::features`] reads it.
    #[must_use]
    pub fn view(&self) -> AnalysedMap<'_> {
        AnalysedMap { analysis: &self.analysis, semantic: &self.semantic, layout: &self.layout, names: &self.names }
    }

    /// The map as layout, graph and routing read it.
    #[must_use]
    pub fn site(&self) -> SiteMap<'_> {
        self.cells.map(&self.grid, &self.analysis, &self.semantic)
    }

    /// The router for vehicles of a radius in metres around what is blocked. The first call makes it, O(cells): keep it
    /// off the runtime.
    #[must_use]
    pub fn router(&self, radius: f64, blocked: Blocked) -> Arc<Router> {
        self.routers.router(&self.site(), radius, blocked)
    }

    /// The navigation graph for vehicles of a radius in metres. The first call makes it and its router: keep it off the
    /// runtime.
    #[must_use]
    pub fn graph(&self, radius: f64) -> Arc<NavigationGraph> {
        self.routers.graph(&self.site(), &self.layout, &self.layout_spec.lane_rules, radius)
    }

    /// The features of a collection, by id. The first call makes them: keep it off the runtime.
    #[must_use]
    pub fn features(&self, collection: Collection) -> &[Feature] {
        self.features.features[collection as usize].get_or_init(|| features::features(&self.view(), collection))
    }

    /// The texts of those features in degrees, each written when it is first asked for.
    #[must_use]
    pub fn feature_texts(&self, collection: Collection) -> &FeatureTexts {
        let degrees = || Transform::new(Crs::Crs84, self.record.georeference);
        self.features.texts[collection as usize].get_or_init(|| {
            FeatureTexts::new(self.features(collection).len(), PropertySelection::all(collection), degrees())
        })
    }
}
