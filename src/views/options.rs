//! The options of an analysis as the document shows them: a view of [`stillage_core::AnalysisOptions`], which reads and
//! checks them. A test keeps the two alike; the defaults are put in from the core.

#![allow(dead_code, reason = "it describes; the core reads")]

use serde::Serialize;
use utoipa::ToSchema;

/// Everything that decides the result of an analysis beside the map itself. Every field is optional.
#[derive(Debug, Default, Serialize, ToSchema)]
#[schema(as = AnalysisOptions)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct AnalysisOptionsView {
    /// A set of options under one name; what stands beside it overrides it. Results do not have it: there, every option
    /// is written out.
    #[schema(write_only)]
    #[serde(skip_serializing)]
    preset: Option<Preset>,
    /// Seed of every random choice.
    seed: u64,
    grid: GridOptionsView,
    categorization: CategorizationOptionsView,
    orientation: OrientationOptionsView,
    regions: RegionOptionsView,
    decomposition: DecompositionOptionsView,
    annotation: AnnotationOptionsView,
    declutter: DeclutterOptionsView,
}

/// `paper`: every stage as the paper describes it, and nothing else touches the map. `halmstad2017`: the same, with the
/// place categorization of the author's published code of 2017.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "lowercase")]
enum Preset {
    Paper,
    Halmstad2017,
}

/// Overrides of the thresholds in the map's own metadata.
#[derive(Debug, Default, Serialize, ToSchema)]
#[schema(as = GridOptions)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct GridOptionsView {
    /// Replaces `occupied_thresh`.
    #[schema(minimum = 0, maximum = 1)]
    occupied_threshold: Option<f64>,
    /// Replaces `free_thresh`.
    #[schema(minimum = 0, maximum = 1)]
    free_threshold: Option<f64>,
    /// Where the file's own `free_thresh` takes the grey that map savers write for unknown cells, 205, for free:
    /// `intended` reads it as unknown and says so in the warnings, `nav2` keeps the letter of the file.
    semantics: GridSemantics,
}

#[derive(Debug, Default, Serialize, ToSchema)]
#[serde(rename_all = "camelCase")]
enum GridSemantics {
    #[default]
    Intended,
    Nav2,
}

/// Place categories (paper, II-A).
#[derive(Debug, Default, Serialize, ToSchema)]
#[schema(as = CategorizationOptions)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct CategorizationOptionsView {
    /// `paper13`: the thirteen features of the paper's Table I. `halmstad2017`: those of the author's code of 2017.
    profile: FeatureProfile,
    /// Beams per cell.
    #[schema(minimum = 8, maximum = 3600)]
    beams: u32,
    /// Longest beam, metres; unlimited when absent.
    #[schema(minimum = 0.1, maximum = 10_000)]
    max_range_m: Option<f64>,
    /// Whether unknown cells stop beams.
    unknown_blocks: bool,
    /// Every how many columns and rows a free cell is measured.
    #[schema(minimum = 1, maximum = 64)]
    stride: u32,
    /// Smallest difference of consecutive beams that counts as a gap, metres.
    #[schema(minimum = 0, maximum = 1000)]
    gap_m: f64,
    /// Number of categories, or `auto`: as many as the features tell apart reliably.
    k: CategoryCount,
    /// Most categories when their number is found.
    #[schema(minimum = 2, maximum = 32)]
    max_k: u32,
    /// How features are made comparable.
    scaling: Scaling,
    /// `kMeans`: the nearest of k centroids. `gaussianMixture`: the likeliest of k normal distributions.
    clustering: ClusteringMethod,
    /// Covariances of the components of a Gaussian mixture.
    covariance: Covariance,
    /// Restarts of k-means.
    #[schema(minimum = 1, maximum = 100)]
    restarts: u32,
    /// Most iterations of one run of k-means or of expectation-maximization.
    #[schema(minimum = 1, maximum = 10_000)]
    max_iterations: u32,
    /// Probabilistic relaxation of the cells; none when absent.
    relaxation: Option<RelaxationOptionsView>,
}

/// A number, 2 to 32, or `auto`.
#[derive(Debug, Serialize, ToSchema)]
#[serde(untagged)]
enum CategoryCount {
    Auto(#[schema(inline)] Auto),
    Fixed(u32),
}

impl Default for CategoryCount {
    fn default() -> Self {
        Self::Auto(Auto::Auto)
    }
}

/// It is found.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "camelCase")]
enum Auto {
    Auto,
}

/// What kind of clusters categories are.
#[derive(Debug, Default, Serialize, ToSchema)]
#[serde(rename_all = "camelCase")]
enum ClusteringMethod {
    #[default]
    KMeans,
    GaussianMixture,
}

/// Shape of the components of a Gaussian mixture.
#[derive(Debug, Default, Serialize, ToSchema)]
#[serde(rename_all = "camelCase")]
enum Covariance {
    #[default]
    Diagonal,
    Full,
}

/// Probabilistic relaxation: neighbours settle on categories that go together.
#[derive(Debug, Default, Serialize, ToSchema)]
#[schema(as = RelaxationOptions)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct RelaxationOptionsView {
    /// Most iterations, 10 when absent; it ends earlier when nothing moves.
    #[schema(minimum = 1, maximum = 100)]
    iterations: u32,
}

/// Set of features.
#[derive(Debug, Default, Serialize, ToSchema)]
#[serde(rename_all = "lowercase")]
enum FeatureProfile {
    #[default]
    Paper13,
    Halmstad2017,
}

/// How features are made comparable.
#[derive(Debug, Default, Serialize, ToSchema)]
#[serde(rename_all = "camelCase")]
enum Scaling {
    #[default]
    None,
    DivideByMean,
    ZScore,
    LogZScore,
}

/// Dominant orientations (paper, II-B).
#[derive(Debug, Default, Serialize, ToSchema)]
#[schema(as = OrientationOptions)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct OrientationOptionsView {
    /// `energy`: maxima of the radiogram energy. `paper`: gradient histogram, mixture, wavelet peaks.
    method: OrientationMethod,
    /// Standard deviation of the Gaussian derivative, metres.
    #[schema(minimum = 0.001, maximum = 10)]
    gradient_scale_m: f64,
    /// Bins of the histogram over half a turn.
    #[schema(minimum = 36, maximum = 7200)]
    bins: u32,
    /// Most components of the mixture.
    #[schema(minimum = 1, maximum = 32)]
    max_components: u32,
    /// Smallest height of a peak above the floor, as a share of the highest.
    #[schema(minimum = 0, maximum = 1)]
    min_peak: f64,
    /// Smallest angle between two orientations, degrees.
    #[schema(minimum = 0.1, maximum = 89)]
    min_separation_deg: f64,
    /// Whether each orientation is refined to the nearby maximum of radiogram energy.
    refine: bool,
}

/// How dominant orientations are found.
#[derive(Debug, Default, Serialize, ToSchema)]
#[serde(rename_all = "camelCase")]
enum OrientationMethod {
    #[default]
    Energy,
    Paper,
}

/// Regions (paper, II-D).
#[derive(Debug, Default, Serialize, ToSchema)]
#[schema(as = RegionOptions)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct RegionOptionsView {
    /// `energy`: by the direction of structure. `gabor`: by texture. `single`: the whole map is one region.
    method: RegionMethod,
    /// Number of texture clusters; chosen automatically when absent.
    #[schema(minimum = 1, maximum = 16)]
    count: Option<u32>,
    /// Most texture clusters when the number is chosen automatically.
    #[schema(minimum = 1, maximum = 16)]
    max_count: u32,
    /// Shortest and longest wavelength of the Gabor bank, metres.
    #[schema(min_items = 2, max_items = 2)]
    wavelengths_m: Vec<f64>,
    /// Smoothing of the texture energy, metres.
    #[schema(minimum = 0.1, maximum = 100)]
    smoothing_m: f64,
    /// Side of a tile, the grain of region boundaries, metres.
    #[schema(minimum = 0.1, maximum = 100)]
    tile_m: f64,
    /// Smallest region, as a share of the known area.
    #[schema(minimum = 0, maximum = 1)]
    min_share: f64,
}

/// How regions are found.
#[derive(Debug, Default, Serialize, ToSchema)]
#[serde(rename_all = "camelCase")]
enum RegionMethod {
    #[default]
    Energy,
    Single,
    Gabor,
}

/// Radiography and lines (paper, II-B).
#[derive(Debug, Default, Serialize, ToSchema)]
#[schema(as = DecompositionOptions)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct DecompositionOptionsView {
    /// `adaptive`: aisles, rows, then cells by the evidence for their borders. `paper`: infinite lines.
    method: DecompositionMethod,
    /// Width of the narrowest vehicle that drives in the aisles, metres, or `auto`: the one for which the site has aisles
    /// between its rows; the warnings say which.
    vehicle_width_m: VehicleWidth,
    /// Hint: narrowest and widest place along its aisle, metres.
    #[schema(min_items = 2, max_items = 2)]
    pitch_m: Option<Vec<f64>>,
    /// Hint: shallowest and deepest place, metres.
    #[schema(min_items = 2, max_items = 2)]
    depth_m: Option<Vec<f64>>,
    /// Width of the Hann window over a radiogram, metres.
    #[schema(minimum = 0, maximum = 10)]
    smoothing_m: f64,
    /// Smallest distance between two parallel lines, metres.
    #[schema(minimum = 0.01, maximum = 100)]
    min_distance_m: f64,
    /// Smallest peak, as a share of the highest of its radiogram.
    #[schema(minimum = 0, maximum = 1)]
    min_peak: f64,
}

/// A number of metres, 0.2 to 20, or `auto`.
#[derive(Debug, Serialize, ToSchema)]
#[serde(untagged)]
enum VehicleWidth {
    Auto(#[schema(inline)] Auto),
    Fixed(f64),
}

impl Default for VehicleWidth {
    fn default() -> Self {
        Self::Auto(Auto::Auto)
    }
}

/// How a region is cut into faces.
#[derive(Debug, Default, Serialize, ToSchema)]
#[serde(rename_all = "camelCase")]
enum DecompositionMethod {
    #[default]
    Adaptive,
    Paper,
}

/// Categories of faces (paper, II-B).
#[derive(Debug, Default, Serialize, ToSchema)]
#[schema(as = AnnotationOptions)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct AnnotationOptionsView {
    /// `faces`: clusters of faces. `vote`: the category of most of its free cells.
    method: AnnotationMethod,
    /// Number of categories of faces (with `faces`).
    #[schema(minimum = 2, maximum = 64)]
    categories: u32,
    /// Half width of the strip along an edge in which occupied cells support it, metres.
    #[schema(minimum = 0, maximum = 10)]
    support_width_m: f64,
    /// Probabilistic relaxation of the faces over the adjacency graph; none when absent.
    relaxation: Option<RelaxationOptionsView>,
}

/// How a face gets its category.
#[derive(Debug, Default, Serialize, ToSchema)]
#[serde(rename_all = "camelCase")]
enum AnnotationMethod {
    #[default]
    Faces,
    Vote,
}

/// Removal of clutter, before every other stage.
#[derive(Debug, Default, Serialize, ToSchema)]
#[schema(as = DeclutterOptions)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct DeclutterOptionsView {
    /// `adaptive`: lone hits and small holes, by what is around them. `none`: the stages see the map as it is.
    method: DeclutterMethod,
}

/// How clutter is told from structure.
#[derive(Debug, Default, Serialize, ToSchema)]
#[serde(rename_all = "camelCase")]
enum DeclutterMethod {
    #[default]
    Adaptive,
    None,
}

#[cfg(test)]
mod tests {
    use serde_json::Value;
    use stillage_core::AnalysisOptions;

    use super::*;

    /// Every path to a value that is no object.
    fn paths(prefix: &str, value: &Value) -> Vec<String> {
        match value {
            Value::Object(members) => {
                members.iter().flat_map(|(name, value)| paths(&format!("{prefix}/{name}"), value)).collect()
            }
            _ => vec![prefix.to_owned()],
        }
    }

    #[test]
    fn the_view_has_the_fields_of_the_options_and_no_others() {
        let view = serde_json::to_value(AnalysisOptionsView::default()).expect("can be written");
        let options = serde_json::to_value(AnalysisOptions::default()).expect("can be written");
        assert_eq!(paths("", &view), paths("", &options));
    }

    #[test]
    fn the_view_names_the_presets() {
        let names =
            [Preset::Paper, Preset::Halmstad2017].map(|name| serde_json::to_value(name).expect("can be written"));
        let known = stillage_core::spec::Preset::ALL.map(|name| serde_json::to_value(name).expect("can be written"));
        assert_eq!(names, known);
    }

    #[test]
    fn every_choice_of_the_view_can_be_read() {
        for (pointer, choices) in [
            ("/categorization/profile", vec!["paper13", "halmstad2017"]),
            ("/categorization/scaling", vec!["none", "divideByMean", "zScore", "logZScore"]),
            ("/categorization/k", vec!["auto"]),
            ("/categorization/clustering", vec!["kMeans", "gaussianMixture"]),
            ("/categorization/covariance", vec!["diagonal", "full"]),
            ("/orientation/method", vec!["energy", "paper"]),
            ("/regions/method", vec!["energy", "single", "gabor"]),
            ("/decomposition/method", vec!["adaptive", "paper"]),
            ("/decomposition/vehicleWidthM", vec!["auto"]),
            ("/annotation/method", vec!["faces", "vote"]),
            ("/declutter/method", vec!["adaptive", "none"]),
        ] {
            for choice in choices {
                let mut options = serde_json::to_value(AnalysisOptions::default()).expect("can be written");
                *options.pointer_mut(pointer).expect("is there") = choice.into();
                assert!(serde_json::from_value::<AnalysisOptions>(options).is_ok(), "{pointer} = {choice}");
            }
        }
        let width = |text: &str| serde_json::from_str::<stillage_core::spec::VehicleWidth>(text);
        assert_eq!(width("2").expect("a number"), stillage_core::spec::VehicleWidth::Fixed(2.0));
        assert!(width("\"wide\"").is_err_and(|error| error.to_string().contains("a number of metres or \"auto\"")));
        let written = |value| serde_json::to_value(value).expect("can be written");
        assert_eq!(written(FeatureProfile::Halmstad2017), "halmstad2017");
        assert_eq!(serde_json::to_value(Scaling::LogZScore).expect("can be written"), "logZScore");
    }
}
