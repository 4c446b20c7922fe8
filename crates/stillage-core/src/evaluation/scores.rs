//! Figures of agreement between an analysis and the truth.

use std::collections::BTreeMap;

use super::occupancy::OccupancyScores;

/// How places were found: shares of `places`, 0 to 1. See the table of [`super`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlaceScores {
    /// Places that count.
    pub places: usize,
    /// One face labelled pallet cell fits the place.
    pub strict: f64,
    /// The place's centre lies in a face labelled pallet cell of less than twice its area.
    pub lax: f64,
    /// More than half of the place is labelled pallet cell.
    pub area: f64,
    /// One face fits the place, whatever its label.
    pub geometry: f64,
    /// Missed laxly, and empty.
    pub systematic: f64,
}

/// Intersection over union of the area of each label, 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LabelOverlap {
    /// Corridors.
    pub corridor: f64,
    /// Junctions.
    pub junction: f64,
    /// Pallet cells.
    pub pallet_cell: f64,
    /// Corridors and junctions together.
    pub drivable: f64,
}

/// How well labels fit the truth.
#[derive(Debug, Clone, PartialEq)]
pub struct LabelScores {
    /// All places that count; `None` without any.
    pub places: Option<PlaceScores>,
    /// Places by region; regions without a place that counts are left out.
    pub regions: BTreeMap<String, PlaceScores>,
    /// Share of the faces labelled pallet cell (without slivers) that fit a true place.
    pub precision: f64,
    /// Harmonic mean of strict recall and precision.
    pub f1: f64,
    /// Faces labelled pallet cell that fit no true place, without slivers.
    pub false_cells: usize,
    /// Faces labelled pallet cell that are much smaller than a place.
    pub slivers: usize,
    /// Agreement of the labels by area.
    pub overlap: LabelOverlap,
    /// Share of the length of edges whose cogency is that of the true labels; `None` without edges between faces.
    pub cogency: Option<f64>,
}

/// How well the decomposition fits the truth, whatever the labels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GeometryScores {
    /// Faces of the subdivision.
    pub faces: usize,
    /// True places.
    pub places: usize,
    /// Faces for each place; `None` without places.
    pub faces_per_place: Option<f64>,
    /// Share of the borders of true places that are borders of faces.
    pub boundary_recall: Option<f64>,
    /// Share of the borders of faces around true places that are borders of places.
    pub boundary_precision: Option<f64>,
    /// Largest distance of a true direction (along or across rows) from the nearest orientation found, radians.
    pub orientation_error: Option<f64>,
    /// Orientations found that are far from every true direction; `None` where the truth names no region.
    pub false_orientations: Option<usize>,
    /// Occupancy of the places that one face fits; `None` when there is none.
    pub occupancy: Option<OccupancyScores>,
}
