//! What a user may ask for ([`AnalysisOptions`]) and what the stages rely on ([`AnalysisSpec`]).
//!
//! The options are one JSON object, the same for the API and the command line: every field is optional, unknown
//! fields are refused, and the whole object with its defaults is echoed in the result. [`AnalysisOptions::check`]
//! turns the wish into a spec; functions that take a spec, or one of its groups, assume that it is valid.

use serde::de::{self, Deserializer, Unexpected, Visitor};
use serde::{Deserialize, Serialize, Serializer};

/// Everything that decides the result of an analysis beside the map itself.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct AnalysisOptions {
    /// Seed of every random choice (k-means, jitter).
    pub seed: u64,
    /// How grey levels become occupancy.
    pub grid: GridOptions,
    /// Place categories.
    pub categorization: CategorizationOptions,
    /// Dominant orientations.
    pub orientation: OrientationOptions,
    /// Texture regions.
    pub regions: RegionOptions,
    /// Radiography and lines.
    pub decomposition: DecompositionOptions,
    /// Categories of faces.
    pub annotation: AnnotationOptions,
}

/// Overrides of the thresholds in the map's own metadata. Used when the map is read, not by the stages.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct GridOptions {
    /// Replaces `occupied_thresh`, 0 to 1.
    pub occupied_threshold: Option<f64>,
    /// Replaces `free_thresh`, 0 to 1. Set 0.196 where a file's 0.25 turns unknown cells (grey 205) free.
    pub free_threshold: Option<f64>,
}

/// Options of the place categorization (paper, II-A).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct CategorizationOptions {
    /// Which features.
    pub profile: FeatureProfile,
    /// Beams per cell, evenly around, the first along x.
    pub beams: usize,
    /// Longest beam, metres; unlimited when absent.
    pub max_range_m: Option<f64>,
    /// Whether unknown cells stop beams.
    pub unknown_blocks: bool,
    /// Every how many columns and rows a free cell is measured; the cells between take the category of the nearest.
    pub stride: usize,
    /// Smallest difference of consecutive beams that counts as a gap, metres.
    pub gap_m: f64,
    /// Number of categories.
    pub k: CategoryCount,
    /// Most categories when their number is found.
    pub max_k: usize,
    /// How features are made comparable.
    pub scaling: Scaling,
    /// What kind of clusters categories are.
    pub clustering: ClusteringMethod,
    /// Covariances of the components of a Gaussian mixture.
    pub covariance: Covariance,
    /// Restarts of k-means, the best one wins.
    pub restarts: usize,
    /// Most iterations of one run of k-means or of expectation-maximization.
    pub max_iterations: usize,
    /// Probabilistic relaxation of the cells; none when absent.
    pub relaxation: Option<RelaxationOptions>,
}

/// A number of categories: in JSON a number or `"auto"`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CategoryCount {
    /// As many as the features tell apart reliably.
    Auto,
    /// So many.
    Fixed(usize),
}

/// What kind of clusters categories are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum ClusteringMethod {
    /// The nearest of k centroids, as in the paper.
    KMeans,
    /// The likeliest of k normal distributions.
    GaussianMixture,
}

/// The shape of the components of a Gaussian mixture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Covariance {
    /// Features are independent within a component: ellipsoids along the axes.
    Diagonal,
    /// Any ellipsoid.
    Full,
}

/// Options of a probabilistic relaxation: neighbours settle on categories that go together.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct RelaxationOptions {
    /// Most iterations; it ends earlier when nothing moves.
    pub iterations: usize,
}

/// A set of features.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum FeatureProfile {
    /// The thirteen features of the paper's Table I, in metres, over closed scans.
    Paper13,
    /// The seventeen numbers of the author's published code of 2017, in pixels, with its rays.
    Halmstad2017,
}

/// How features are made comparable before clustering.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Scaling {
    /// As they are.
    None,
    /// Divided by their mean, as the author did.
    DivideByMean,
    /// Zero mean, unit variance.
    ZScore,
    /// `sign(x) ln(1 + |x|)`, then zero mean and unit variance.
    LogZScore,
}

/// Options of the dominant orientations (paper, II-B).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct OrientationOptions {
    /// How orientations are found.
    pub method: OrientationMethod,
    /// Standard deviation of the Gaussian derivative, metres (at least one cell).
    pub gradient_scale_m: f64,
    /// Bins of the histogram over half a turn.
    pub bins: usize,
    /// Most components of the circular Gaussian mixture; their number is chosen by BIC.
    pub max_components: usize,
    /// Smallest height of a peak above the floor, as a share of the highest.
    pub min_peak: f64,
    /// Smallest angle between two orientations, degrees.
    pub min_separation_deg: f64,
    /// Whether each orientation is refined to the nearby maximum of radiogram energy.
    pub refine: bool,
}

/// How dominant orientations are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum OrientationMethod {
    /// Maxima of the radiogram energy, of all structure and of what is no wall.
    Energy,
    /// Gradient histogram, Gaussian mixture, wavelet peaks.
    Paper,
}

/// Options of the region segmentation (paper, II-D).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct RegionOptions {
    /// How regions are found.
    pub method: RegionMethod,
    /// Number of texture clusters; chosen automatically when absent.
    pub count: Option<usize>,
    /// Most texture clusters when the number is chosen automatically.
    pub max_count: usize,
    /// Shortest and longest wavelength of the Gabor bank, metres.
    pub wavelengths_m: [f64; 2],
    /// Smoothing of the texture energy, metres.
    pub smoothing_m: f64,
    /// Side of a tile, the grain of region boundaries, metres.
    pub tile_m: f64,
    /// Smallest region, as a share of the known area.
    pub min_share: f64,
}

/// How regions are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum RegionMethod {
    /// By direction: radiogram energy of the dominant directions around each tile.
    Energy,
    /// The whole map is one region.
    Single,
    /// Gabor texture (5 frequencies, 8 orientations), PCA, k-means.
    Gabor,
}

/// Options of radiography and lines (paper, II-B).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct DecompositionOptions {
    /// How a region is cut into faces.
    pub method: DecompositionMethod,
    /// Width of the narrowest vehicle that drives in the aisles, metres. Decides what is drivable.
    pub vehicle_width_m: f64,
    /// Narrowest and widest place along its aisle, metres; a wide range when absent.
    pub pitch_m: Option<[f64; 2]>,
    /// Shallowest and deepest place, metres; a wide range when absent.
    pub depth_m: Option<[f64; 2]>,
    /// Width of the Hann window over a radiogram, metres.
    pub smoothing_m: f64,
    /// Smallest distance between two parallel lines, metres.
    pub min_distance_m: f64,
    /// Smallest peak, as a share of the highest of its radiogram.
    pub min_peak: f64,
}

/// How a region is cut into faces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum DecompositionMethod {
    /// Aisles first, then rows, then the cells of each row by the evidence for their borders.
    Adaptive,
    /// Infinite lines through the peaks of the radiograms.
    Paper,
}

/// Options of the annotation of faces (paper, II-B).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct AnnotationOptions {
    /// How a face gets its category.
    pub method: AnnotationMethod,
    /// Number of categories of faces (with `faces`).
    pub categories: usize,
    /// Half width of the strip along an edge in which occupied cells support it, metres.
    pub support_width_m: f64,
    /// Probabilistic relaxation of the faces over the adjacency graph; none when absent.
    pub relaxation: Option<RelaxationOptions>,
}

/// How a face gets its category.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum AnnotationMethod {
    /// Clusters of faces by occupancy, shape and position among their neighbours.
    Faces,
    /// The category of most of its free cells; a face without free cells is `occupied` or `unknown`.
    Vote,
}

impl Default for AnalysisOptions {
    fn default() -> Self {
        Self {
            seed: 1,
            grid: GridOptions::default(),
            categorization: CategorizationOptions::default(),
            orientation: OrientationOptions::default(),
            regions: RegionOptions::default(),
            decomposition: DecompositionOptions::default(),
            annotation: AnnotationOptions::default(),
        }
    }
}

impl Default for CategorizationOptions {
    fn default() -> Self {
        Self {
            profile: FeatureProfile::Paper13,
            beams: 360,
            max_range_m: None,
            unknown_blocks: true,
            stride: 1,
            gap_m: 0.5,
            k: CategoryCount::Fixed(5),
            max_k: 8,
            scaling: Scaling::ZScore,
            clustering: ClusteringMethod::KMeans,
            covariance: Covariance::Full,
            restarts: 16,
            max_iterations: 300,
            relaxation: None,
        }
    }
}

impl Default for RelaxationOptions {
    fn default() -> Self {
        Self { iterations: 10 }
    }
}

impl Serialize for CategoryCount {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        // Formats for programs do not tell a number from a word: there, automatic is none.
        match (*self, serializer.is_human_readable()) {
            (Self::Auto, true) => serializer.serialize_str(AUTO),
            (Self::Fixed(count), true) => serializer.serialize_u64(count as u64),
            (Self::Auto, false) => None::<u64>.serialize(serializer),
            (Self::Fixed(count), false) => Some(count as u64).serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for CategoryCount {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        if deserializer.is_human_readable() {
            return deserializer.deserialize_any(NumberOrAuto);
        }
        let count = Option::<u64>::deserialize(deserializer)?;
        Ok(count.map_or(Self::Auto, |count| Self::Fixed(count as usize)))
    }
}

/// The word for a number that is found.
const AUTO: &str = "auto";

/// Reads a [`CategoryCount`].
struct NumberOrAuto;

impl Visitor<'_> for NumberOrAuto {
    type Value = CategoryCount;

    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(formatter, "a whole number or \"{AUTO}\"")
    }

    fn visit_u64<E: de::Error>(self, count: u64) -> Result<Self::Value, E> {
        Ok(CategoryCount::Fixed(usize::try_from(count).unwrap_or(usize::MAX)))
    }

    fn visit_i64<E: de::Error>(self, count: i64) -> Result<Self::Value, E> {
        match u64::try_from(count) {
            Ok(count) => self.visit_u64(count),
            Err(_) => Err(E::invalid_value(Unexpected::Signed(count), &self)),
        }
    }

    fn visit_str<E: de::Error>(self, word: &str) -> Result<Self::Value, E> {
        if word == AUTO { Ok(CategoryCount::Auto) } else { Err(E::invalid_value(Unexpected::Str(word), &self)) }
    }
}

impl Default for OrientationOptions {
    fn default() -> Self {
        Self {
            method: OrientationMethod::Energy,
            gradient_scale_m: 0.1,
            bins: 900,
            max_components: 10,
            min_peak: 0.15,
            min_separation_deg: 6.0,
            refine: true,
        }
    }
}

impl Default for RegionOptions {
    fn default() -> Self {
        Self {
            method: RegionMethod::Energy,
            count: None,
            max_count: 4,
            wavelengths_m: [1.2, 9.6],
            smoothing_m: 8.0,
            tile_m: 2.0,
            min_share: 0.05,
        }
    }
}

impl Default for DecompositionOptions {
    fn default() -> Self {
        Self {
            method: DecompositionMethod::Adaptive,
            vehicle_width_m: 1.7,
            pitch_m: None,
            depth_m: None,
            smoothing_m: 0.25,
            min_distance_m: 0.5,
            min_peak: 0.15,
        }
    }
}

impl Default for AnnotationOptions {
    fn default() -> Self {
        Self { method: AnnotationMethod::Faces, categories: 16, support_width_m: 0.1, relaxation: None }
    }
}

/// One option that cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{pointer}: {message}")]
pub struct OptionProblem {
    /// JSON pointer to the option.
    pub pointer: &'static str,
    /// What is wrong and what would be right.
    pub message: String,
}

/// Options that were checked: each value is within its range.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
#[serde(transparent)]
pub struct AnalysisSpec(AnalysisOptions);

impl AnalysisSpec {
    /// The options behind the spec, with every default filled in.
    #[must_use]
    pub const fn options(&self) -> &AnalysisOptions {
        &self.0
    }
}

impl AnalysisOptions {
    /// Checks every option against its range.
    ///
    /// # Errors
    /// One problem for each option out of range.
    pub fn check(self) -> Result<AnalysisSpec, Vec<OptionProblem>> {
        let mut check = Check::default();
        let grid = &self.grid;
        check.share_if("/grid/occupiedThreshold", grid.occupied_threshold);
        check.share_if("/grid/freeThreshold", grid.free_threshold);
        if let (Some(occupied), Some(free)) = (grid.occupied_threshold, grid.free_threshold) {
            check.that("/grid/freeThreshold", free < occupied, "must be below occupiedThreshold");
        }

        let categorization = &self.categorization;
        check.whole("/categorization/beams", categorization.beams, 8, 3600);
        if let Some(range) = categorization.max_range_m {
            check.number("/categorization/maxRangeM", range, 0.1, 10_000.0);
        }
        check.whole("/categorization/stride", categorization.stride, 1, 64);
        check.number("/categorization/gapM", categorization.gap_m, 0.0, 1_000.0);
        if let CategoryCount::Fixed(count) = categorization.k {
            check.whole("/categorization/k", count, 2, 32);
        }
        check.whole("/categorization/maxK", categorization.max_k, 2, 32);
        check.whole("/categorization/restarts", categorization.restarts, 1, 100);
        check.whole("/categorization/maxIterations", categorization.max_iterations, 1, 10_000);
        if let Some(relaxation) = categorization.relaxation {
            check.whole("/categorization/relaxation/iterations", relaxation.iterations, 1, 100);
        }

        let orientation = &self.orientation;
        check.number("/orientation/gradientScaleM", orientation.gradient_scale_m, 0.001, 10.0);
        check.whole("/orientation/bins", orientation.bins, 36, 7_200);
        check.whole("/orientation/maxComponents", orientation.max_components, 1, 32);
        check.number("/orientation/minPeak", orientation.min_peak, 0.0, 1.0);
        check.number("/orientation/minSeparationDeg", orientation.min_separation_deg, 0.1, 89.0);

        let regions = &self.regions;
        if let Some(count) = regions.count {
            check.whole("/regions/count", count, 1, 16);
        }
        check.whole("/regions/maxCount", regions.max_count, 1, 16);
        for wavelength in regions.wavelengths_m {
            check.number("/regions/wavelengthsM", wavelength, 0.1, 100.0);
        }
        let [shortest, longest] = regions.wavelengths_m;
        check.that("/regions/wavelengthsM", shortest < longest, "must be the shortest, then the longest wavelength");
        check.number("/regions/smoothingM", regions.smoothing_m, 0.1, 100.0);
        check.number("/regions/tileM", regions.tile_m, 0.1, 100.0);
        check.number("/regions/minShare", regions.min_share, 0.0, 1.0);

        let decomposition = &self.decomposition;
        check.number("/decomposition/vehicleWidthM", decomposition.vehicle_width_m, 0.2, 20.0);
        check.range_if("/decomposition/pitchM", decomposition.pitch_m, 0.3, 10.0);
        check.range_if("/decomposition/depthM", decomposition.depth_m, 0.3, 10.0);
        check.number("/decomposition/smoothingM", decomposition.smoothing_m, 0.0, 10.0);
        check.number("/decomposition/minDistanceM", decomposition.min_distance_m, 0.01, 100.0);
        check.number("/decomposition/minPeak", decomposition.min_peak, 0.0, 1.0);

        check.whole("/annotation/categories", self.annotation.categories, 2, 64);
        check.number("/annotation/supportWidthM", self.annotation.support_width_m, 0.0, 10.0);
        if let Some(relaxation) = self.annotation.relaxation {
            check.whole("/annotation/relaxation/iterations", relaxation.iterations, 1, 100);
        }

        if check.problems.is_empty() { Ok(AnalysisSpec(self)) } else { Err(check.problems) }
    }
}

/// Collects what is out of range.
#[derive(Default)]
struct Check {
    problems: Vec<OptionProblem>,
}

impl Check {
    fn that(&mut self, pointer: &'static str, holds: bool, message: &str) {
        if !holds {
            self.problems.push(OptionProblem { pointer, message: message.to_owned() });
        }
    }

    fn number(&mut self, pointer: &'static str, value: f64, low: f64, high: f64) {
        // Written so that NaN is out of range.
        let inside = value >= low && value <= high;
        self.that(pointer, inside, &format!("{value} is outside {low} to {high}"));
    }

    fn share_if(&mut self, pointer: &'static str, value: Option<f64>) {
        if let Some(value) = value {
            self.number(pointer, value, 0.0, 1.0);
        }
    }

    fn range_if(&mut self, pointer: &'static str, range: Option<[f64; 2]>, low: f64, high: f64) {
        if let Some([least, most]) = range {
            self.number(pointer, least, low, high);
            self.number(pointer, most, low, high);
            self.that(pointer, least <= most, "must be the least, then the greatest");
        }
    }

    fn whole(&mut self, pointer: &'static str, value: usize, low: usize, high: usize) {
        self.that(pointer, (low..=high).contains(&value), &format!("{value} is outside {low} to {high}"));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_defaults_are_valid() {
        assert!(AnalysisOptions::default().check().is_ok());
    }

    #[test]
    fn every_problem_is_named_with_its_pointer() {
        let mut options = AnalysisOptions::default();
        options.categorization.relaxation = Some(RelaxationOptions { iterations: 0 });
        options.categorization.k = CategoryCount::Fixed(0);
        options.decomposition.min_distance_m = f64::NAN;
        options.regions.wavelengths_m = [4.0, 2.0];
        let problems = options.check().unwrap_err();
        let pointers: Vec<&str> = problems.iter().map(|problem| problem.pointer).collect();
        let expected = [
            "/categorization/k",
            "/categorization/relaxation/iterations",
            "/regions/wavelengthsM",
            "/decomposition/minDistanceM",
        ];
        assert_eq!(pointers, expected);
    }
}
