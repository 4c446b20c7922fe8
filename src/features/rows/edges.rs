//! Edges of the subdivision.

use stillage_core::arrangement::{EdgeId, EdgeSource, FaceId};

use super::common::ORIENTATION;
use crate::features::geometry::{Geometry, GeometryType};
use crate::features::property::{Kind, Property};
use crate::features::table::{Column, Table};
use crate::features::view::{AnalysedMap, rounded};
use crate::features::words;

/// An edge.
#[derive(Debug, Clone, PartialEq)]
pub struct EdgeRow {
    id: u32,
    /// The faces to its left and right; none for the unbounded face.
    sides: [Option<u32>; 2],
    cogency: &'static str,
    length: f64,
    support: f64,
    open: f64,
    confidence: f64,
    evidence: &'static str,
    disagreement: bool,
    link: Option<u32>,
    orientation: f64,
    line: Option<u32>,
}

/// The collection.
pub const TABLE: Table<EdgeRow> = Table {
    title: "Edges",
    description: "The borders between faces, with their cogency and physical support",
    geometry: &[GeometryType::LineString],
    columns: &[
        Column::new(Property::new("id", Kind::Integer, "Id", "Number of the edge"), |edge| edge.id.into()),
        Column::new(
            Property::new("faceLeft", Kind::Integer, "Left face", "Id of the face to its left").nullable(),
            |edge| edge.sides[0].into(),
        ),
        Column::new(
            Property::new("faceRight", Kind::Integer, "Right face", "Id of the face to its right").nullable(),
            |edge| edge.sides[1].into(),
        ),
        Column::new(
            Property::new(
                "cogency",
                Kind::Word(words::COGENCY),
                "Cogency",
                "Whether it is an obstruction, an access to storage, or open",
            ),
            |edge| edge.cogency.into(),
        ),
        Column::new(Property::new("lengthM", Kind::Number, "Length", "Length").unit("m"), |edge| edge.length.into()),
        Column::new(
            Property::new("support", Kind::Number, "Support", "Share of its length along which obstacles lie"),
            |edge| edge.support.into(),
        ),
        Column::new(
            Property::new("open", Kind::Number, "Open", "Share of its length along which both sides are free"),
            |edge| edge.open.into(),
        ),
        Column::new(
            Property::new("confidence", Kind::Number, "Confidence", "Share of its length that is known"),
            |edge| edge.confidence.into(),
        ),
        Column::new(
            Property::new(
                "evidence",
                Kind::Word(words::EVIDENCE),
                "Evidence",
                "Whether cells show it, or it follows from its surroundings",
            ),
            |edge| edge.evidence.into(),
        ),
        Column::new(
            Property::new(
                "disagreement",
                Kind::Boolean,
                "Disagreement",
                "Whether its cogency and its physical support disagree",
            ),
            |edge| edge.disagreement.into(),
        ),
        Column::new(Property::new("link", Kind::Integer, "Link", "Id of the link across it").nullable(), |edge| {
            edge.link.into()
        }),
        Column::new(ORIENTATION, |edge| edge.orientation.into()),
        Column::new(Property::new("line", Kind::Integer, "Line", "Id of the line it lies on").nullable(), |edge| {
            edge.line.into()
        }),
    ],
};

/// The edges of a map, by id.
#[must_use]
pub fn read(view: &AnalysedMap<'_>) -> Vec<(Geometry, EdgeRow)> {
    let subdivision = &view.analysis.subdivision;
    let row = |edge: EdgeId| {
        let annotation = &view.analysis.edges[edge.index()];
        let [start, end] = subdivision.segment(edge);
        let along = end - start;
        let line = match subdivision.source(edge) {
            EdgeSource::Boundary | EdgeSource::Drawn => None,
            EdgeSource::Line(line) => Some(line),
        };
        let row = EdgeRow {
            id: edge.0,
            sides: subdivision.sides(edge).map(|face| (face != FaceId::OUTER).then_some(face.0)),
            cogency: words::cogency(view.semantic.cogency[edge.index()]),
            length: rounded(along.norm()),
            support: rounded(annotation.support),
            open: rounded(annotation.open),
            confidence: rounded(annotation.confidence),
            evidence: words::evidence(annotation.evidence),
            disagreement: view.semantic.disagreements[edge.index()],
            link: view.has_link(edge).then_some(edge.0),
            orientation: view.orientation_degrees(along.y.atan2(along.x)),
            line,
        };
        (Geometry::LineString([start, end].map(|end| view.position(end)).to_vec()), row)
    };
    subdivision.edges().map(row).collect()
}
