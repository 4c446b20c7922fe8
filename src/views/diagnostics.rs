//! The signals behind an analysis, and what it cost.

use std::collections::BTreeMap;

use serde::Serialize;
use stillage_core::declutter::Removed;
use utoipa::ToSchema;

use super::id::Id;
use super::remarks::{DiagnosticView, StageView};
use crate::app::MapContext;

/// All that a plot of the analysis needs. Lengths and angles are those of the grid frame.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "camelCase")]
#[allow(clippy::struct_field_names, reason = "the remarks are called so wherever there are any")]
pub struct Diagnostics {
    analysis_id: Id,
    frame: FrameView,
    clutter: ClutterView,
    orientations: OrientationsView,
    radiograms: Vec<RadiogramView>,
    /// What each stage cost.
    stages: Vec<StageView>,
    /// Counts of the result: faces, edges, lines ...
    counts: BTreeMap<&'static str, usize>,
    /// Remarks on the result.
    diagnostics: Vec<DiagnosticView>,
    /// Remarks of the upload.
    warnings: Vec<DiagnosticView>,
}

/// Where the grid frame lies in the map frame.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Frame)]
#[serde(rename_all = "camelCase")]
pub struct FrameView {
    /// Side of a cell, metres.
    resolution_m: f64,
    /// Lower left corner of the grid in the map frame, metres.
    origin_m: [f64; 2],
    /// Counter-clockwise turn of the grid in the map frame, radians.
    yaw_rad: f64,
}

/// What was taken for clutter before the first stage, in runs of cells: the first one (row by row from the lower left
/// corner of the grid) and their number.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Clutter)]
#[serde(rename_all = "camelCase")]
pub struct ClutterView {
    /// Share of the floor's cells that carry a lone hit.
    rate: f64,
    /// Number of occupied cells taken for speckle.
    occupied_cells: usize,
    /// Number of unknown cells taken for holes in free space.
    unknown_cells: usize,
    /// Runs of occupied cells taken for speckle.
    occupied_runs: Vec<[u32; 2]>,
    /// Runs of unknown cells taken for holes in free space.
    unknown_runs: Vec<[u32; 2]>,
}

impl From<&Removed> for ClutterView {
    fn from(removed: &Removed) -> Self {
        Self {
            rate: removed.rate,
            occupied_cells: removed.occupied.len(),
            unknown_cells: removed.unknown.len(),
            occupied_runs: runs(&removed.occupied),
            unknown_runs: runs(&removed.unknown),
        }
    }
}

/// Ascending numbers as the first of each run and its length.
fn runs(cells: &[u32]) -> Vec<[u32; 2]> {
    cells.chunk_by(|one, next| one + 1 == *next).map(|run| [run[0], run.len() as u32]).collect()
}

/// The dominant orientations and the signals they were read from.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Orientations)]
#[serde(rename_all = "camelCase")]
pub struct OrientationsView {
    /// Directions of lines in [-pi/2, pi/2), ascending.
    angles_rad: Vec<f64>,
    /// Weighted histogram over [-pi/2, pi/2), evenly spaced bins, sum 1.
    histogram: Vec<f64>,
    /// The histogram after the low-pass: density of the mixture at the same bins.
    mixture: Vec<f64>,
}

/// Projection of the occupied cells of a region on the normal of an orientation.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Radiogram)]
#[serde(rename_all = "camelCase")]
pub struct RadiogramView {
    region: u8,
    /// Direction of projection.
    orientation_rad: f64,
    /// Offset of the lower edge of the first bin along the normal.
    start_m: f64,
    /// Width of a bin.
    bin_m: f64,
    /// Occupied length per bin, metres.
    values_m: Vec<f64>,
}

impl Diagnostics {
    /// Those of the analysis in force.
    #[must_use]
    pub fn new(context: &MapContext, stages: Vec<StageView>) -> Self {
        let analysis = &context.analysis;
        let radiogram = |radiogram: &stillage_core::radiography::Radiogram| RadiogramView {
            region: radiogram.region,
            orientation_rad: radiogram.orientation,
            start_m: radiogram.start,
            bin_m: radiogram.bin,
            values_m: radiogram.values.clone(),
        };
        Self {
            analysis_id: Id(context.analysis_id),
            frame: FrameView {
                resolution_m: analysis.frame.resolution,
                origin_m: [analysis.frame.origin.x, analysis.frame.origin.y],
                yaw_rad: analysis.frame.yaw,
            },
            clutter: ClutterView::from(&analysis.clutter),
            orientations: OrientationsView {
                angles_rad: analysis.orientations.angles.clone(),
                histogram: analysis.orientations.histogram.clone(),
                mixture: analysis.orientations.mixture.clone(),
            },
            radiograms: analysis.radiograms.iter().map(radiogram).collect(),
            stages,
            counts: BTreeMap::from([
                ("categories", analysis.categories.categories.len()),
                ("regions", analysis.regions.regions.len()),
                ("lines", analysis.lines.len()),
                ("vertices", analysis.subdivision.vertex_count()),
                ("edges", analysis.subdivision.edge_count()),
                ("faces", analysis.subdivision.faces().len()),
                ("places", context.semantic.places.len()),
                ("locations", context.layout.locations.len()),
            ]),
            diagnostics: analysis.diagnostics.iter().map(Into::into).collect(),
            warnings: context.record.warnings.iter().map(Into::into).collect(),
        }
    }
}
