//! Options of the stages other than the place categorization.

use serde::{Deserialize, Serialize};

use super::categorization::RelaxationOptions;
use super::vehicle_width::VehicleWidth;

/// Overrides of the thresholds in the map's own metadata. Used when the map is read, not by the stages.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct GridOptions {
    /// Replaces `occupied_thresh`, 0 to 1.
    pub occupied_threshold: Option<f64>,
    /// Replaces `free_thresh`, 0 to 1.
    pub free_threshold: Option<f64>,
    /// What is done where the file's own `free_thresh` takes the savers' grey for unknown cells, 205, for free.
    pub semantics: GridSemantics,
}

/// How literally the thresholds of a file are taken.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum GridSemantics {
    /// The grey that map savers write for unknown cells stays unknown.
    #[default]
    Intended,
    /// To the letter, as `nav2_map_server` reads the file.
    Nav2,
}

/// Options of the dominant orientations (paper, II-B).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct OrientationOptions {
    /// How orientations are found.
    pub method: OrientationMethod,
    /// Standard deviation of the Gaussian derivative, metres (at least one cell).
    pub gradient_scale_m: f64,
    /// Number of bins of the histogram over half a turn.
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
    /// Side of a tile, metres: region boundaries run along tiles.
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
    /// Width of the narrowest vehicle that drives in the aisles, metres. Decides what is an aisle.
    pub vehicle_width_m: VehicleWidth,
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
    /// Aisles, then rows, then the places of each row by the evidence for their borders.
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
            vehicle_width_m: VehicleWidth::Auto,
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

/// Options of the removal of clutter, before every other stage.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct DeclutterOptions {
    /// How clutter is told from structure.
    pub method: DeclutterMethod,
}

/// How clutter is told from structure.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum DeclutterMethod {
    /// By size and by the occupied cells around, relative to the rate of speckle of this map.
    #[default]
    Adaptive,
    /// Nothing is removed.
    None,
}
