//! The features of an analysed map, made when they are first asked for and kept with it.

use std::sync::OnceLock;

use super::MapContext;
use crate::features::{self, Collection, Feature, AnalysedMap};

/// The features of the collections that were asked for.
#[derive(Debug, Default)]
pub struct FeatureCache([OnceLock<Vec<Feature>>; Collection::ALL.len()]);

impl MapContext {
    /// The map as [`crate::features`] reads it.
    #[must_use]
    pub fn view(&self) -> AnalysedMap<'_> {
        AnalysedMap { analysis: &self.analysis, semantic: &self.semantic, locations: &self.locations }
    }

    /// The features of a collection, by id. The first call makes them: keep it off the runtime.
    #[must_use]
    pub fn features(&self, collection: Collection) -> &[Feature] {
        self.features.0[collection as usize].get_or_init(|| features::features(&self.view(), collection))
    }
}
