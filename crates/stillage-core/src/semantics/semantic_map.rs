//! What an analysis means: labels of faces, cogency of edges, connectivity of links, places.

use serde::{Deserialize, Serialize};

use super::cogency::{Cogency, Connectivity};
use super::label::{Label, LabelId};
use super::rule_set::RuleSet;
use crate::arrangement::{EdgeId, FaceId};

/// Merged faces: a room, or faces of one label that are mutually open (a corridor, a junction, a block of storage).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Place {
    /// Its label; for a room the label of most of its area.
    pub label: LabelId,
    /// The room it is, if walls bound it.
    pub room: Option<u32>,
    /// Its faces, ascending.
    pub faces: Vec<FaceId>,
    /// Area, square metres.
    pub area: f64,
}

/// The semantic map: an analysis read under a rule set and an assignment.
#[derive(Debug, Clone, PartialEq)]
pub struct SemanticMap {
    /// The rule set it was read under.
    pub rule_set: RuleSet,
    /// Label of each face, by face id (entry 0 is the unidentified label).
    pub labels: Vec<LabelId>,
    /// Confidence of that label, 0 to 1, by face id.
    pub confidences: Vec<f64>,
    /// C(e) by edge id.
    pub cogency: Vec<Cogency>,
    /// C(l) by edge id; `None` on the outer boundary, where there is no link.
    pub connectivity: Vec<Option<Connectivity>>,
    /// Edges whose cogency and physical support disagree, by edge id.
    pub disagreements: Vec<bool>,
    /// Place of each face, by face id (`None` for the unbounded face and for unidentified faces outside rooms).
    pub face_places: Vec<Option<u32>>,
    /// Merged faces.
    pub places: Vec<Place>,
}

impl SemanticMap {
    /// The label of a face.
    #[must_use]
    pub fn label(&self, face: FaceId) -> &Label {
        self.rule_set.label(self.labels[face.index()])
    }

    /// Whether a robot may drive over a link: connected, and both faces drivable.
    #[must_use]
    pub fn is_drivable_link(&self, edge: EdgeId, sides: [FaceId; 2]) -> bool {
        self.connectivity[edge.index()] == Some(Connectivity::Connected)
            && sides.iter().all(|&face| self.label(face).is_drivable())
    }
}
