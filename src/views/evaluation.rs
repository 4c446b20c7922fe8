//! How well a map fits the truth of its site.

use std::collections::BTreeMap;

use serde::Serialize;
use stillage_core::evaluation::{Evaluation, GeometryScores, LabelScores, OccupancyScores, PlaceScores};
use utoipa::ToSchema;

/// How well an analysis fits the truth. Shares and ratios lie between 0 and 1.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Evaluation)]
pub struct EvaluationView {
    geometry: GeometryScoresView,
    /// Under the suggested labels: what comes out without a human.
    automatic: LabelScoresView,
    /// Under the decision below: what a person can make of it.
    decided: LabelScoresView,
    /// The best decision: each category has the label that most of its area has in the truth.
    #[schema(value_type = BTreeMap<String, String>, example = json!({"0": "co", "1": "pc"}))]
    decision: BTreeMap<u8, String>,
    /// Under the labels in force, where a person assigned them.
    #[serde(skip_serializing_if = "Option::is_none")]
    assigned: Option<LabelScoresView>,
}

/// How well the decomposition fits, whatever the labels.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = GeometryScores)]
#[serde(rename_all = "camelCase")]
pub struct GeometryScoresView {
    faces: usize,
    /// True places.
    places: usize,
    faces_per_place: Option<f64>,
    /// Share of the borders of true places with a border of a face within 0.15 m.
    boundary_recall: Option<f64>,
    /// Share of the borders of faces around true places with a border of a place within 0.15 m.
    boundary_precision: Option<f64>,
    /// Largest distance of a true direction, along or across rows, from the nearest orientation found.
    orientation_error_deg: Option<f64>,
    /// Orientations found that are 2 degrees or more from every true direction.
    false_orientations: Option<usize>,
    /// Whether goods stand on places; null where no place is found.
    occupancy: Option<OccupancyScoresView>,
}

/// How the occupancy of places agrees with the truth: over the places that count and that one face fits.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = OccupancyScores)]
pub struct OccupancyScoresView {
    /// Those places.
    places: usize,
    /// Share of them that were read right; not to know is wrong.
    accuracy: f64,
    /// How those that hold goods were read.
    occupied: OccupancyCountsView,
    /// How those that are empty were read.
    empty: OccupancyCountsView,
}

/// Numbers of places.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = OccupancyCounts)]
pub struct OccupancyCountsView {
    /// Read as occupied.
    occupied: usize,
    /// Read as empty.
    empty: usize,
    /// Read as unknown.
    unknown: usize,
}

impl From<&OccupancyScores> for OccupancyScoresView {
    fn from(scores: &OccupancyScores) -> Self {
        let counts = |[occupied, empty, unknown]: [usize; 3]| OccupancyCountsView { occupied, empty, unknown };
        Self {
            places: scores.places,
            accuracy: rounded(scores.accuracy),
            occupied: counts(scores.occupied),
            empty: counts(scores.empty),
        }
    }
}

/// How well labels fit.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = LabelScores)]
#[serde(rename_all = "camelCase")]
pub struct LabelScoresView {
    /// All true places whose surroundings were seen; null when there is none.
    places: Option<PlaceScoresView>,
    /// The same by region of the truth.
    regions: BTreeMap<String, PlaceScoresView>,
    /// Share of the faces labelled pallet cell (without slivers) that are a true place.
    precision: f64,
    /// Harmonic mean of strict recall and precision: the figure to go by.
    f1: f64,
    /// Faces labelled pallet cell that are no true place.
    false_cells: usize,
    /// Faces labelled pallet cell below a quarter of the median place.
    slivers: usize,
    iou: LabelOverlapView,
    /// Share of the length of edges whose cogency is that of the true labels.
    cogency: Option<f64>,
}

/// How places were found.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = PlaceScores)]
pub struct PlaceScoresView {
    /// Places that count.
    places: usize,
    /// Share of them that one face labelled pallet cell fits (intersection over union above one half).
    strict: f64,
    /// Share whose centre lies in a face labelled pallet cell of less than twice their area.
    lax: f64,
    /// Share of which more than half is labelled pallet cell.
    area: f64,
    /// Share that one face fits, whatever its label.
    geometry: f64,
    /// Share that is missed laxly and was empty: no shape shows it.
    systematic: f64,
}

/// Intersection over union of the area of each label.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = LabelOverlap)]
pub struct LabelOverlapView {
    /// Corridors.
    co: f64,
    /// Junctions.
    ju: f64,
    /// Pallet cells.
    pc: f64,
    /// Corridors and junctions together.
    drivable: f64,
}

/// Four decimals say more than any truth can.
fn rounded(value: f64) -> f64 {
    (value * 1e4).round() / 1e4
}

impl From<&Evaluation> for EvaluationView {
    fn from(evaluation: &Evaluation) -> Self {
        Self {
            geometry: (&evaluation.geometry).into(),
            automatic: (&evaluation.automatic).into(),
            decided: (&evaluation.decided).into(),
            decision: evaluation.decision.assignment.clone(),
            assigned: evaluation.assigned.as_ref().map(Into::into),
        }
    }
}

impl From<&GeometryScores> for GeometryScoresView {
    fn from(scores: &GeometryScores) -> Self {
        Self {
            faces: scores.faces,
            places: scores.places,
            faces_per_place: scores.faces_per_place.map(rounded),
            boundary_recall: scores.boundary_recall.map(rounded),
            boundary_precision: scores.boundary_precision.map(rounded),
            orientation_error_deg: scores.orientation_error.map(|error| rounded(error.to_degrees())),
            false_orientations: scores.false_orientations,
            occupancy: scores.occupancy.as_ref().map(Into::into),
        }
    }
}

impl From<&LabelScores> for LabelScoresView {
    fn from(scores: &LabelScores) -> Self {
        let overlap = &scores.overlap;
        Self {
            places: scores.places.as_ref().map(Into::into),
            regions: scores.regions.iter().map(|(name, places)| (name.clone(), places.into())).collect(),
            precision: rounded(scores.precision),
            f1: rounded(scores.f1),
            false_cells: scores.false_cells,
            slivers: scores.slivers,
            iou: LabelOverlapView {
                co: rounded(overlap.corridor),
                ju: rounded(overlap.junction),
                pc: rounded(overlap.pallet_cell),
                drivable: rounded(overlap.drivable),
            },
            cogency: scores.cogency.map(rounded),
        }
    }
}

impl From<&PlaceScores> for PlaceScoresView {
    fn from(scores: &PlaceScores) -> Self {
        Self {
            places: scores.places,
            strict: rounded(scores.strict),
            lax: rounded(scores.lax),
            area: rounded(scores.area),
            geometry: rounded(scores.geometry),
            systematic: rounded(scores.systematic),
        }
    }
}
