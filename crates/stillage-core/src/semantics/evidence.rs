//! What the faces of a category have in common: occupancy, shape, borders, and what they were cut out as.
//!
//! Cost: O(faces + edges).

use serde::{Deserialize, Serialize};

use crate::analysis::Analysis;
use crate::arrangement::FaceId;
use crate::plot::PlotKind;

/// Share of an edge with obstacles above which it is lined by structure, and share of free cells below which the face
/// behind it is: the majority.
const MAJORITY: f64 = 0.5;

/// Aggregates over the faces of one category (area-weighted means).
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct CategoryEvidence {
    /// Number of faces.
    pub faces: usize,
    /// Their area, square metres.
    pub area: f64,
    /// Share of their cells that are free.
    pub free_fraction: f64,
    /// Share of their cells that are occupied.
    pub occupied_fraction: f64,
    /// Share of their cells that are unknown.
    pub unknown_fraction: f64,
    /// Long over short side.
    pub elongation: f64,
    /// Median face area, square metres.
    pub median_area: f64,
    /// Share of the length of their edges that is open (passable on both sides).
    pub open_fraction: f64,
    /// Share of the length of their edges with an obstacle along it, or without a free face behind it.
    pub lined_fraction: f64,
    /// Share of their area that was cut out as places.
    pub place_fraction: f64,
    /// Share of their area that was cut out as aisles, or is corridors between rooms.
    pub aisle_fraction: f64,
    /// Share of their area that was cut out as open floor or passages, or is junctions of corridors.
    pub floor_fraction: f64,
    /// Share of their area that lies in rooms, or in bays behind the gates of a hall.
    pub room_fraction: f64,
    /// Share of their area that was cut out as something else.
    pub rest_fraction: f64,
}

/// Aggregates the faces and edges of each category.
pub(super) fn category_evidence(analysis: &Analysis) -> Vec<CategoryEvidence> {
    let count = analysis.face_categories.count();
    let borders = BorderLengths::measure(analysis);
    let mut sums = vec![CategoryEvidence::default(); count];
    let mut areas: Vec<Vec<f64>> = vec![Vec::new(); count];
    let mut lengths = vec![0.0; count];
    for face in analysis.subdivision.faces().map(FaceId::index) {
        let annotation = &analysis.faces[face];
        let category = usize::from(annotation.category);
        let (sum, weight) = (&mut sums[category], annotation.area);
        sum.faces += 1;
        sum.area += weight;
        sum.free_fraction += weight * annotation.free_fraction;
        sum.occupied_fraction += weight * annotation.occupied_fraction;
        sum.unknown_fraction += weight * annotation.unknown_fraction;
        sum.elongation += weight * annotation.elongation;
        match annotation.kind {
            Some(PlotKind::Place) => sum.place_fraction += weight,
            Some(PlotKind::Aisle | PlotKind::Corridor) => sum.aisle_fraction += weight,
            Some(PlotKind::OpenFloor | PlotKind::Passage | PlotKind::Junction) => sum.floor_fraction += weight,
            Some(PlotKind::Room) => sum.room_fraction += weight,
            Some(PlotKind::Other) => sum.rest_fraction += weight,
            None => {}
        }
        sum.open_fraction += borders.open[face];
        sum.lined_fraction += borders.lined[face];
        lengths[category] += borders.length[face];
        areas[category].push(annotation.area);
    }
    for ((sum, areas), length) in sums.iter_mut().zip(&mut areas).zip(lengths) {
        let share = |value: f64, whole: f64| if whole > 0.0 { value / whole } else { 0.0 };
        let area = sum.area;
        for mean in [
            &mut sum.free_fraction,
            &mut sum.occupied_fraction,
            &mut sum.unknown_fraction,
            &mut sum.elongation,
            &mut sum.place_fraction,
            &mut sum.aisle_fraction,
            &mut sum.floor_fraction,
            &mut sum.room_fraction,
            &mut sum.rest_fraction,
        ] {
            *mean = share(*mean, area);
        }
        sum.open_fraction = share(sum.open_fraction, length);
        sum.lined_fraction = share(sum.lined_fraction, length);
        sum.median_area = median(areas);
    }
    sums
}

/// Lower median; 0 without values.
fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len().saturating_sub(1) / 2).copied().unwrap_or(0.0)
}

/// Lengths along the boundary of each face, metres.
struct BorderLengths {
    length: Vec<f64>,
    open: Vec<f64>,
    /// With an obstacle on the edge, or no free face behind it.
    lined: Vec<f64>,
}

impl BorderLengths {
    fn measure(analysis: &Analysis) -> Self {
        let faces = analysis.faces.len();
        let mut borders = Self { length: vec![0.0; faces], open: vec![0.0; faces], lined: vec![0.0; faces] };
        for edge in analysis.subdivision.edges() {
            let length = analysis.subdivision.length(edge);
            let annotation = &analysis.edges[edge.index()];
            let [left, right] = analysis.subdivision.sides(edge).map(FaceId::index);
            for (face, behind) in [(left, right), (right, left)] {
                let is_lined = annotation.support > MAJORITY || analysis.faces[behind].free_fraction < MAJORITY;
                borders.length[face] += length;
                borders.open[face] += length * annotation.open;
                borders.lined[face] += if is_lined { length } else { 0.0 };
            }
        }
        borders
    }
}
