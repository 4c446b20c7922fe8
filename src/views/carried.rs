//! What became of labels that were carried over from another analysis.

use serde::Serialize;
use stillage_core::semantics::LabelSubject;
use utoipa::ToSchema;

use super::id::Id;
use crate::features::rounded;
use crate::records::{CarryRecord, LostDecision};

/// What became of what people decided on another analysis of the map, or on an earlier map of the site. A label is kept where
/// most of its ground has it again, however that is cut into faces now.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = CarriedLabels)]
pub struct CarriedView {
    /// The earlier map of the site that they come from; absent where it is the map itself.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(required = false, nullable = false)]
    map: Option<Id>,
    /// The version that they come from.
    from: u64,
    /// Labels of categories and faces that were kept; from an earlier map, corrections that fit, too.
    kept: usize,
    /// Those that could not be carried over.
    lost: Vec<LostLabelView>,
}

/// A label that could not be carried over.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = LostLabel)]
pub struct LostLabelView {
    /// The face that had it, by its id on the analysis that it was given on.
    #[serde(skip_serializing_if = "Option::is_none")]
    face: Option<u32>,
    /// The category that had it, likewise.
    #[serde(skip_serializing_if = "Option::is_none")]
    category: Option<u8>,
    /// Id of the label.
    #[schema(example = "ju")]
    label: String,
    /// A point inside that face, or inside the largest one of that category, in metres of the map frame.
    at: [f64; 2],
}

impl From<CarryRecord> for CarriedView {
    fn from(CarryRecord { map, from, kept, lost }: CarryRecord) -> Self {
        Self { map: map.map(Id), from, kept, lost: lost.into_iter().map(LostLabelView::from).collect() }
    }
}

impl From<LostDecision> for LostLabelView {
    fn from(LostDecision { subject, label, at }: LostDecision) -> Self {
        let (face, category) = match subject {
            LabelSubject::Face(face) => (Some(face), None),
            LabelSubject::Category(category) => (None, Some(category)),
        };
        Self { face, category, label, at: at.map(rounded) }
    }
}
