//! What is seen from the cells of a category, by its mean features.

use crate::categorization::CategoryMap;

/// What is seen from the cells of a cluster; unknown for the other categories.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct View {
    /// Mean beam length over that of the whole map.
    pub(super) relative_beam: Option<f64>,
    /// Long over short principal axis of the end points of the beams.
    pub(super) elongation: Option<f64>,
}

/// Feature of both profiles: the mean beam length.
pub(super) const MEAN_BEAM: &str = "meanBeamLength";

/// Feature of both profiles: the ratio of the principal axes of the end points of the beams.
pub(super) const AXIS_RATIO: &str = "pcRatio";

impl View {
    pub(super) fn of(categories: &CategoryMap, category: usize, mean_beam: Option<f64>) -> Self {
        let feature = |name| mean_feature(categories, category, name);
        Self {
            relative_beam: feature(MEAN_BEAM).zip(mean_beam).map(|(beam, mean)| beam / mean),
            elongation: feature(AXIS_RATIO),
        }
    }
}

fn mean_feature(categories: &CategoryMap, category: usize, name: &str) -> Option<f64> {
    let index = categories.feature_names.iter().position(|feature| feature == name)?;
    let value = *categories.categories.get(category)?.mean_features.get(index)?;
    value.is_finite().then_some(value)
}

/// Mean beam length over all categorized cells; `None` where it is unknown or zero.
pub(super) fn mean_beam_of_map(categories: &CategoryMap) -> Option<f64> {
    let cells: usize = categories.categories.iter().map(|category| category.cells).sum();
    let weighted = (0..categories.categories.len())
        .filter(|&index| categories.categories[index].cells > 0)
        .map(|index| Some(mean_feature(categories, index, MEAN_BEAM)? * categories.categories[index].cells as f64))
        .sum::<Option<f64>>()?;
    let mean = weighted / cells as f64;
    (mean > 0.0).then_some(mean)
}
