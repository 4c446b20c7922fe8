//! The corrections of a map.

use serde::Serialize;
use serde_json::Value;
use stillage_core::corrections::{Correction, Outcome};
use utoipa::ToSchema;

use super::carried::LostLabelView;
use super::link::Link;
use crate::app::{CorrectionId, MapContext};
use crate::records::LostDecision;

/// What a person says about a map that no automatic reading got right. Points are metres of the map frame.
#[derive(Debug, ToSchema)]
#[schema(as = Correction)]
#[serde(tag = "kind", rename_all = "camelCase", rename_all_fields = "camelCase")]
#[allow(dead_code, reason = "it describes what the core reads and writes")]
pub enum CorrectionView {
    /// What lies inside a polygon is one face: a rack, a keep-out, a named area.
    Draw {
        /// Its corners; the first one may be repeated at the end.
        #[schema(min_items = 3, example = json!([[1, 1], [3, 1], [3, 2], [1, 2]]))]
        ring: Vec<[f64; 2]>,
        /// Id of its label.
        #[schema(example = "pc")]
        label: String,
        /// Its name.
        #[schema(required = false, nullable = false, example = "Rack 12")]
        name: Option<String>,
    },
    /// The faces that a line crosses are cut along it.
    Split {
        /// Two points or more.
        #[schema(min_items = 2)]
        line: Vec<[f64; 2]>,
    },
    /// Faces that touch become one.
    Merge {
        /// A point inside each of them. The first one gives the label and the name.
        #[schema(min_items = 2)]
        at: Vec<[f64; 2]>,
    },
    /// A rectangle is cut into places. Their number is given, or the distance from one to the next.
    Row {
        /// Its corners; the first side, from the first corner to the second, runs along the row.
        #[schema(value_type = Vec<[f64; 2]>, min_items = 4, max_items = 4)]
        rectangle: [[f64; 2]; 4],
        /// How many places there are side by side.
        #[schema(required = false, nullable = false, minimum = 1)]
        places: Option<u32>,
        /// Distance from place to place, metres; the number of places is the nearest whole one.
        #[schema(rename = "pitchM", required = false, nullable = false)]
        pitch_m: Option<f64>,
        /// How many places there are one behind the other.
        #[schema(required = false, minimum = 1, default = 1)]
        layers: u32,
        /// Id of their label. Without one they have the label of their category.
        #[schema(required = false, nullable = false)]
        label: Option<String>,
    },
    /// What was found inside a polygon is nothing: it joins the ground around it.
    Erase {
        /// Its corners; the first one may be repeated at the end.
        #[schema(min_items = 3)]
        ring: Vec<[f64; 2]>,
    },
    /// A face has a label.
    Label {
        /// A point inside it.
        at: [f64; 2],
        /// Id of its label.
        label: String,
    },
    /// The border along a line is a door, or is shut.
    Door {
        /// From jamb to jamb.
        #[schema(value_type = Vec<[f64; 2]>, min_items = 2, max_items = 2)]
        line: [[f64; 2]; 2],
        /// Whether vehicles may pass.
        #[schema(rename = "isOpen")]
        is_open: bool,
    },
    /// A face has a name.
    Name {
        /// A point inside it.
        at: [f64; 2],
        /// Its name.
        name: String,
    },
}

/// What a correction has of its kind.
#[derive(Debug, ToSchema)]
#[serde(rename_all = "camelCase")]
#[allow(dead_code, reason = "it describes what the core writes")]
struct CorrectionMembers {
    /// Its kind: `draw`, `split`, `merge`, `row`, `erase`, `label`, `door` or `name`.
    #[schema(example = "draw")]
    kind: String,
    #[serde(flatten)]
    members: CorrectionPatch,
}

/// Members of a correction that are to be others; null takes an optional one away. Which there are depends on its kind.
#[derive(Debug, ToSchema)]
#[schema(example = json!({"label": "pc"}))]
#[serde(rename_all = "camelCase")]
#[allow(dead_code, reason = "it describes what the core reads and writes")]
pub struct CorrectionPatch {
    /// The corners of a polygon.
    ring: Option<Vec<[f64; 2]>>,
    /// The points of a cut, or the jambs of a door.
    line: Option<Vec<[f64; 2]>>,
    /// The corners of a row.
    rectangle: Option<Vec<[f64; 2]>>,
    /// A point in the face, or one in each of the faces that become one.
    at: Option<Vec<Value>>,
    /// How many places a row has side by side.
    places: Option<u32>,
    /// Distance from place to place, metres.
    pitch_m: Option<f64>,
    /// How many places a row has one behind the other.
    layers: Option<u32>,
    /// Whether vehicles may pass a door.
    is_open: Option<bool>,
    /// Id of the label.
    label: Option<String>,
    /// The name.
    name: Option<String>,
}

/// A correction, and what became of it on the analysis in force.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "camelCase")]
pub struct ListedCorrection {
    /// Its id, which no other correction of the map ever has; a new one in a preview has none.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(example = "c1", required = false, nullable = false)]
    id: Option<String>,
    #[serde(flatten)]
    #[schema(value_type = CorrectionMembers)]
    correction: Correction,
    /// Whether it fits onto the map. One that does not changes nothing.
    is_applied: bool,
    /// The faces that it made or touched, as far as they are still there.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(required = false, nullable = false)]
    faces: Option<Vec<u32>>,
    /// Why it does not fit.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(required = false, nullable = false)]
    reason: Option<String>,
}

impl ListedCorrection {
    fn new(id: Option<CorrectionId>, correction: &Correction, outcome: &Outcome) -> Self {
        let (faces, reason) = match outcome {
            Outcome::Applied { faces } => (Some(faces.iter().map(|face| face.0).collect()), None),
            Outcome::Unfit(problem) => (None, Some(problem.message.clone())),
        };
        let is_applied = faces.is_some();
        Self { id: id.map(|id| id.to_string()), correction: correction.clone(), is_applied, faces, reason }
    }

    /// The corrections of a map.
    #[must_use]
    pub fn all(context: &MapContext) -> Vec<Self> {
        context.listed_corrections().map(|(id, correction, outcome)| Self::new(Some(id), correction, outcome)).collect()
    }

    /// Those of a map that is not stored, with their ids.
    #[must_use]
    pub fn of_preview(ids: &[Option<CorrectionId>], context: &MapContext) -> Vec<Self> {
        let corrections = &context.corrections;
        let listed = ids.iter().zip(&corrections.list).zip(&corrections.outcomes);
        listed.map(|((&id, correction), outcome)| Self::new(id, correction, outcome)).collect()
    }

    /// One of a map.
    #[must_use]
    pub fn find(context: &MapContext, id: CorrectionId) -> Option<Self> {
        let mut listed = context.listed_corrections();
        listed.find(|(of, ..)| *of == id).map(|(id, correction, outcome)| Self::new(Some(id), correction, outcome))
    }
}

/// The corrections of a map.
#[derive(Debug, Serialize, ToSchema)]
pub struct CorrectionListView {
    /// The version of the semantics that they are part of.
    version: u64,
    /// In the order in which they are applied.
    corrections: Vec<ListedCorrection>,
    /// After a write: labels of single faces that were lost because their ground is cut otherwise now.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schema(required = false)]
    lost: Vec<LostLabelView>,
    /// Itself, and the semantics.
    links: Vec<Link>,
}

impl CorrectionListView {
    /// The corrections of a map, and the labels that a write of them lost.
    #[must_use]
    pub fn new(context: &MapContext, lost: Vec<LostDecision>, links: Vec<Link>) -> Self {
        let lost = lost.into_iter().map(LostLabelView::from).collect();
        Self { version: context.semantics.version, corrections: ListedCorrection::all(context), lost, links }
    }
}

/// Several corrections. One by itself is read, too: that is not a choice here, because generators of clients cannot write it.
#[derive(Debug, ToSchema)]
#[schema(as = NewCorrections)]
#[allow(dead_code, reason = "it describes what is read")]
pub struct CorrectionsBody {
    /// In the order in which they are applied, after those that there are.
    #[schema(min_items = 1)]
    corrections: Vec<CorrectionView>,
}

/// Corrections as GeoJSON: a feature or a feature collection.
#[derive(Debug, ToSchema)]
#[schema(as = CorrectionFeatures)]
#[allow(dead_code, reason = "it describes what the ingest reads")]
pub struct CorrectionFeaturesBody {
    #[schema(example = "FeatureCollection")]
    r#type: String,
    features: Vec<CorrectionFeatureBody>,
}

/// A shape that corrects something.
#[derive(Debug, ToSchema)]
#[schema(as = CorrectionFeature)]
#[allow(dead_code, reason = "it describes what the ingest reads")]
pub struct CorrectionFeatureBody {
    #[schema(example = "Feature")]
    r#type: String,
    /// Members of the correction, such as `label`, `name` and `kind`. Without a kind, an area is drawn (with the label for
    /// storage, where the rule set has one only), a line splits, a point has a label or a name. Others are left out.
    #[schema(value_type = Object, example = json!({"name": "Rack 12", "label": "pc"}))]
    properties: Value,
    /// An area without holes, a line or a point in the coordinates of `crs`.
    #[schema(value_type = Object, example = json!({"type": "Polygon", "coordinates": [[[1, 1], [3, 1], [3, 2], [1, 2], [1, 1]]]}))]
    geometry: Value,
}
