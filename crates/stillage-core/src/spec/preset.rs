//! Whole sets of options under one name.

use serde::{Deserialize, Serialize};

use super::categorization::{CategoryCount, FeatureProfile, Scaling};
use super::groups::{AnnotationMethod, DeclutterMethod, DecompositionMethod, OrientationMethod, RegionMethod};
use super::options::AnalysisOptions;

/// A set of options under one name. In JSON, `"preset": "paper"`; other options beside it override it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Preset {
    /// Every stage as the paper describes it (ECMR 2015, doi 10.1109/ECMR.2015.7324207), on the map as it is: features
    /// of Table I, k-means, peaks of the gradient histogram, Gabor regions, infinite lines, votes of cells. What the
    /// paper does not say about k-means is taken from the author's code of 2017.
    Paper,
    /// The paper with the place categorization of the author's published code of 2017: its beams and its seventeen
    /// features, two categories.
    Halmstad2017,
}

/// Runs of k-means in the author's published code of 2017 (`n_init`).
const AUTHORS_RESTARTS: usize = 20;
/// Most iterations of a run there (`max_iter`).
const AUTHORS_ITERATIONS: usize = 500;
/// Categories there when no number is given (`n_category`).
const AUTHORS_CATEGORIES: usize = 2;

impl Preset {
    /// Every preset.
    pub const ALL: [Self; 2] = [Self::Paper, Self::Halmstad2017];

    /// The whole set of options.
    #[must_use]
    pub fn options(self) -> AnalysisOptions {
        let mut options = AnalysisOptions::default();
        options.declutter.method = DeclutterMethod::None;
        options.categorization.profile = FeatureProfile::Paper13;
        options.categorization.scaling = Scaling::DivideByMean;
        options.categorization.restarts = AUTHORS_RESTARTS;
        options.categorization.max_iterations = AUTHORS_ITERATIONS;
        options.orientation.method = OrientationMethod::Paper;
        options.orientation.refine = false;
        options.regions.method = RegionMethod::Gabor;
        options.decomposition.method = DecompositionMethod::Paper;
        options.annotation.method = AnnotationMethod::Vote;
        if self == Self::Halmstad2017 {
            options.categorization.profile = FeatureProfile::Halmstad2017;
            options.categorization.k = CategoryCount::Fixed(AUTHORS_CATEGORIES);
        }
        options
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_preset_is_valid() {
        for preset in Preset::ALL {
            assert!(preset.options().check().is_ok(), "{preset:?}");
        }
    }
}
