//! What a change of labels and corrections would do.

use std::collections::BTreeMap;

use serde::Serialize;
use stillage_core::arrangement::FaceId;
use stillage_core::semantics::{Cogency, Connectivity};
use utoipa::ToSchema;

use super::carried::LostLabelView;
use super::correction::ListedCorrection;
use super::face_difference::DifferenceCounts;
use crate::app::{LabelPreview, MapContext};
use crate::features::words;

/// The faces that a change of labels and corrections would make, change or take away, as GeoJSON (RFC 7946), and what it
/// would do to the map.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = LabelPreview)]
#[serde(rename_all = "camelCase")]
#[allow(dead_code, reason = "it describes what is written straight to bytes")]
pub struct LabelPreviewView {
    /// `FeatureCollection`
    #[schema(example = "FeatureCollection")]
    r#type: String,
    /// Features in all. A face that would have another shape is there with both.
    number_matched: usize,
    /// Those in `features`.
    number_returned: usize,
    counts: PreviewCounts,
    /// Faces that would be different, counted.
    faces: DifferenceCounts,
    /// The corrections as they would be, and whether they fit.
    corrections: Vec<ListedCorrection>,
    /// Labels of single faces that would be lost because their ground would be cut otherwise.
    lost: Vec<LostLabelView>,
    #[schema(value_type = Vec<Object>, example = json!([{"type": "Feature", "id": 12,
        "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [0.00001, 0], [0.00001, 0.00001], [0, 0]]]},
        "properties": {"change": "relabelled", "isBefore": false, "face": 12, "previousFace": 12, "label": "ju",
            "previousLabel": "co"}}]))]
    features: Vec<serde_json::Value>,
}

/// What there is on the map, and what there would be.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = PreviewCounts)]
#[serde(rename_all = "camelCase")]
pub struct PreviewCounts {
    /// By label: those that some face has, or would have.
    labels: Vec<LabelCounts>,
    /// Edges by cogency: `cogent`, `storage-access`, `invalid`.
    edges: BTreeMap<&'static str, BeforeAfter>,
    /// Links by connectivity: `disconnected`, `storage-access`, `connected`.
    links: BTreeMap<&'static str, BeforeAfter>,
}

/// What there is of one label.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "camelCase")]
pub struct LabelCounts {
    /// Id of the label.
    #[schema(example = "co")]
    label: String,
    /// Faces that have it.
    faces: BeforeAfter,
    /// Storage locations on them.
    locations: BeforeAfter,
    /// Connected links that lead to them.
    connected_links: BeforeAfter,
}

/// How many there are, and how many there would be.
#[derive(Debug, Default, Clone, Copy, Serialize, ToSchema)]
pub struct BeforeAfter {
    before: usize,
    after: usize,
}

/// Which of the two a map is.
#[derive(Debug, Clone, Copy)]
enum Time {
    Before,
    After,
}

impl BeforeAfter {
    fn add(&mut self, time: Time) {
        match time {
            Time::Before => self.before += 1,
            Time::After => self.after += 1,
        }
    }
}

impl PreviewCounts {
    /// Counts a map before and after.
    #[must_use]
    pub fn of(preview: &LabelPreview) -> Self {
        let all = |names: &'static [&'static str]| names.iter().map(|&name| (name, BeforeAfter::default())).collect();
        let mut counts = Self { labels: Vec::new(), edges: all(words::COGENCY), links: all(words::CONNECTIVITY) };
        let mut labels = BTreeMap::new();
        counts.count(&preview.before, Time::Before, &mut labels);
        counts.count(&preview.after, Time::After, &mut labels);
        counts.labels = labels.into_values().collect();
        counts
    }

    fn count<'a>(&mut self, map: &'a MapContext, time: Time, labels: &mut BTreeMap<&'a str, LabelCounts>) {
        let (subdivision, semantic) = (&map.analysis.subdivision, &map.semantic);
        let label = |face: FaceId| semantic.label(face).id.as_str();
        for face in subdivision.faces() {
            of_label(labels, label(face)).faces.add(time);
        }
        for location in &map.layout.locations {
            of_label(labels, label(location.face)).locations.add(time);
        }
        for edge in subdivision.edges() {
            let cogency: Cogency = semantic.cogency[edge.index()];
            self.edges.entry(words::cogency(cogency)).or_default().add(time);
            let Some(connectivity) = semantic.connectivity[edge.index()] else { continue };
            self.links.entry(words::connectivity(connectivity)).or_default().add(time);
            if connectivity == Connectivity::Connected {
                let [left, right] = subdivision.sides(edge).map(label);
                of_label(labels, left).connected_links.add(time);
                if right != left {
                    of_label(labels, right).connected_links.add(time);
                }
            }
        }
    }
}

fn of_label<'a, 'b>(labels: &'b mut BTreeMap<&'a str, LabelCounts>, label: &'a str) -> &'b mut LabelCounts {
    let [faces, locations, connected_links] = [BeforeAfter::default(); 3];
    labels.entry(label).or_insert_with(|| LabelCounts { label: label.to_owned(), faces, locations, connected_links })
}
