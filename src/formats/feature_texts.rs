//! Features of a collection that were written before.

use std::sync::OnceLock;

use super::geojson::{Members, write_collection, write_feature};
use crate::coordinates::Transform;
use crate::features::Feature;
use crate::features::query::PropertySelection;

/// The features of a collection as GeoJSON in some coordinates, each written when it is first asked for: to copy a text takes
/// a tenth of the time that it takes to project and to write it.
#[derive(Debug)]
pub struct FeatureTexts {
    properties: PropertySelection,
    transform: Transform,
    /// By place in the collection.
    texts: Box<[OnceLock<Box<[u8]>>]>,
}

impl FeatureTexts {
    /// Those of so many features with these properties, none of them written yet.
    #[must_use]
    pub fn new(count: usize, properties: PropertySelection, transform: Transform) -> Self {
        Self { properties, transform, texts: (0..count).map(|_| OnceLock::new()).collect() }
    }

    /// Some of the features of `collection` as [`geojson::feature_collection`](super::geojson::feature_collection) writes
    /// them.
    #[must_use]
    pub fn feature_collection(&self, collection: &[Feature], some: &[&Feature], members: Members<'_>) -> Vec<u8> {
        write_collection(some.iter().copied(), members, |feature, out| {
            match collection.element_offset(feature).and_then(|place| self.texts.get(place)) {
                Some(text) => out.extend_from_slice(text.get_or_init(|| self.written(feature))),
                None => write_feature(feature, &self.properties, &self.transform, &[], out),
            }
        })
    }

    fn written(&self, feature: &Feature) -> Box<[u8]> {
        let mut text = Vec::new();
        write_feature(feature, &self.properties, &self.transform, &[], &mut text);
        text.into_boxed_slice()
    }
}
