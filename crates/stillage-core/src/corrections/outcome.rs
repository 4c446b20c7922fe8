//! What becomes of corrections.

use std::collections::BTreeMap;

use super::check::CorrectionProblem;
use super::draft::Said;
use crate::analysis::Analysis;
use crate::arrangement::{CellFaces, FaceId};

/// What became of one correction.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Outcome {
    /// It holds.
    Applied {
        /// The faces of the corrected arrangement that it made or touched, ascending. Empty where corrections after it
        /// changed all of them.
        faces: Vec<FaceId>,
    },
    /// It does not fit onto this map, and changes nothing.
    Unfit(CorrectionProblem),
}

/// An analysis with corrections.
#[derive(Debug, Clone, PartialEq)]
pub struct Corrected {
    /// The corrected analysis: what the corrections left alone is as it was, under new ids.
    pub analysis: Analysis,
    /// The face of every cell.
    pub faces: CellFaces,
    /// Ids of the labels that people gave to single faces.
    pub labels: BTreeMap<FaceId, String>,
    /// Names that people gave to faces.
    pub names: BTreeMap<FaceId, String>,
    /// What became of each correction, in the order of the list.
    pub outcomes: Vec<Outcome>,
    /// For more corrections.
    pub said: Said,
}
