//! Which features of a collection, in which order, how many at a time, and which of their properties.

mod filterable;
mod nearest;
mod properties;
mod selection;
mod sort;
#[cfg(test)]
mod tests;

use std::collections::BTreeSet;

use super::feature::Feature;
use super::id::FeatureId;
use crate::cql2::Filter;

pub use filterable::{GEOMETRY, queryables};
pub use nearest::{NearFeature, nearest};
pub use properties::PropertySelection;
pub use selection::BoxSelection;
pub use sort::SortKey;

/// A question about a collection. What is absent selects everything.
#[derive(Debug, Default)]
pub struct FeatureQuery {
    /// Only these.
    pub ids: Option<BTreeSet<FeatureId>>,
    /// Only those that meet this box.
    pub within: Option<BoxSelection>,
    /// Only those that all of these select.
    pub filters: Vec<Filter>,
    /// By which properties they are sorted; by id when empty, and where these are equal.
    pub sort: Vec<SortKey>,
    /// The last feature of the page before.
    pub after: Option<FeatureId>,
    /// How many are left out before the page.
    pub offset: usize,
    /// Most features of a page.
    pub limit: usize,
}

/// A page of the features that were selected.
#[derive(Debug)]
pub struct Page<'a> {
    /// The features of the page.
    pub features: Vec<&'a Feature>,
    /// Number of features that were selected, on this page and all others.
    pub matched: usize,
    /// Whether more come after this page.
    pub has_more: bool,
}

/// Pages of a sorted list go on after a feature, and this one is not in the collection any more.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct VanishedFeature;

impl FeatureQuery {
    /// The page of `features`, which are a whole collection by id, that answers the question.
    ///
    /// Pages go on after an id, so that nothing is skipped or repeated when features come and go between them. O(n),
    /// and O(n log n) where `sort` is not empty.
    ///
    /// # Errors
    /// When the list is sorted and `after` is in the collection no more.
    pub fn select<'a>(&self, features: &'a [Feature]) -> Result<Page<'a>, VanishedFeature> {
        let is_selected = |feature: &&Feature| {
            self.ids.as_ref().is_none_or(|ids| ids.contains(&feature.id))
                && self.within.as_ref().is_none_or(|within| within.meets(feature))
                && self.filters.iter().all(|filter| filter.selects(*feature))
        };
        let mut matched: Vec<&Feature> = features.iter().filter(is_selected).collect();
        let start = if self.sort.is_empty() {
            self.after.as_ref().map_or(0, |after| matched.partition_point(|feature| feature.id <= *after))
        } else {
            matched.sort_by(|first, second| sort::compare(&self.sort, first, second));
            match self.after.as_ref().map(|after| find(features, after).ok_or(VanishedFeature)).transpose()? {
                Some(after) => matched.partition_point(|feature| sort::compare(&self.sort, feature, after).is_le()),
                None => 0,
            }
        };
        let start = matched.len().min(start.saturating_add(self.offset));
        let end = matched.len().min(start.saturating_add(self.limit));
        Ok(Page { features: matched[start..end].to_vec(), matched: matched.len(), has_more: end < matched.len() })
    }
}

/// The feature with an id among the features of a collection, which are sorted by id.
#[must_use]
pub fn find<'a>(features: &'a [Feature], id: &FeatureId) -> Option<&'a Feature> {
    features.binary_search_by(|feature| feature.id.cmp(id)).ok().map(|index| &features[index])
}
