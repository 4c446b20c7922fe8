//! Faces that are different in two versions of a map.

use serde::Serialize;
use stillage_core::compare::{FaceDifference, LabelledFace};
use utoipa::ToSchema;

/// What is different about a face.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ToSchema)]
#[schema(as = FaceDifferenceKind)]
#[serde(rename_all = "lowercase")]
pub enum DifferenceWord {
    /// It was not there.
    Added,
    /// It is no longer there.
    Removed,
    /// It has another shape, maybe another label too.
    Reshaped,
    /// It has another label.
    Relabelled,
}

impl DifferenceWord {
    /// What is different.
    #[must_use]
    pub const fn of(difference: &FaceDifference) -> Self {
        match (&difference.before, &difference.now) {
            (None, _) => Self::Added,
            (Some(_), None) => Self::Removed,
            (Some(_), Some(_)) if difference.is_reshaped => Self::Reshaped,
            (Some(_), Some(_)) => Self::Relabelled,
        }
    }
}

/// How many faces are different, by what is different about them.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, ToSchema)]
#[schema(as = FaceDifferenceCounts)]
pub struct DifferenceCounts {
    /// They were not there.
    added: usize,
    /// They are no longer there.
    removed: usize,
    /// They have another shape.
    reshaped: usize,
    /// They have another label.
    relabelled: usize,
}

impl DifferenceCounts {
    /// Counts differences.
    #[must_use]
    pub fn of(differences: &[FaceDifference]) -> Self {
        let mut counts = Self::default();
        for difference in differences {
            *match DifferenceWord::of(difference) {
                DifferenceWord::Added => &mut counts.added,
                DifferenceWord::Removed => &mut counts.removed,
                DifferenceWord::Reshaped => &mut counts.reshaped,
                DifferenceWord::Relabelled => &mut counts.relabelled,
            } += 1;
        }
        counts
    }
}

/// Properties of a face that is different.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct DifferentFace<'a> {
    change: DifferenceWord,
    /// Whether the shape is that of before; a face with another shape is there twice.
    is_before: bool,
    face: Option<u32>,
    previous_face: Option<u32>,
    label: Option<&'a str>,
    previous_label: Option<&'a str>,
}

impl<'a> DifferentFace<'a> {
    /// A difference, shown by the shape of before or of now.
    #[must_use]
    pub fn new(difference: &'a FaceDifference, is_before: bool) -> Self {
        let number = |face: &'a Option<LabelledFace>| face.as_ref().map(|face| face.face.0);
        let label = |face: &'a Option<LabelledFace>| face.as_ref().map(|face| face.label.as_str());
        Self {
            change: DifferenceWord::of(difference),
            is_before,
            face: number(&difference.now),
            previous_face: number(&difference.before),
            label: label(&difference.now),
            previous_label: label(&difference.before),
        }
    }
}

/// What changed from one version of the semantics to another, as GeoJSON (RFC 7946).
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = VersionChanges)]
#[serde(rename_all = "camelCase")]
#[allow(dead_code, reason = "it describes what is written straight to bytes")]
pub struct VersionChangesView {
    /// `FeatureCollection`
    #[schema(example = "FeatureCollection")]
    r#type: String,
    /// The version before; 0 is the suggestion.
    since: u64,
    /// The version after it.
    version: u64,
    /// Features in all.
    number_matched: usize,
    /// Those in `features`.
    number_returned: usize,
    counts: DifferenceCounts,
    #[schema(value_type = Vec<Object>, example = json!([{"type": "Feature", "id": 12,
        "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [0.00001, 0], [0.00001, 0.00001], [0, 0]]]},
        "properties": {"change": "relabelled", "isBefore": false, "face": 12, "previousFace": 12, "label": "ju",
            "previousLabel": "co"}}]))]
    features: Vec<serde_json::Value>,
}
