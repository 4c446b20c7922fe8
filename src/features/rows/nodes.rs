//! Nodes of the adjacency graph.

use std::sync::Arc;

use stillage_core::arrangement::FaceId;

use crate::features::geometry::{Geometry, GeometryType};
use crate::features::property::{Kind, Property};
use crate::features::table::{Column, Table};
use crate::features::view::{AnalysedMap, LabelWords};

/// A node.
#[derive(Debug, Clone, PartialEq)]
pub struct NodeRow {
    /// Its face has the same number.
    id: u32,
    label: Arc<LabelWords>,
    degree: u32,
}

/// The collection.
pub const TABLE: Table<NodeRow> = Table {
    title: "Nodes",
    description: "The nodes of the adjacency graph: one in each face",
    geometry: &[GeometryType::Point],
    columns: &[
        Column::new(Property::new("id", Kind::Integer, "Id", "Number of the node"), |node| node.id.into()),
        Column::new(Property::new("face", Kind::Integer, "Face", "Id of its face"), |node| node.id.into()),
        Column::new(Property::new("label", Kind::Text, "Label", "Id of the label of its face"), |node| {
            node.label.id.as_str().into()
        }),
        Column::new(Property::new("degree", Kind::Integer, "Degree", "Number of its links"), |node| node.degree.into()),
    ],
};

/// The nodes of a map, by id.
#[must_use]
pub fn read(view: &AnalysedMap<'_>) -> Vec<(Geometry, NodeRow)> {
    let graph = &view.analysis.graph;
    let labels = view.labels();
    let row = |face: FaceId| NodeRow {
        id: face.0,
        label: labels.of(view.semantic.labels[face.index()]),
        degree: graph.links(face).len() as u32,
    };
    let faces = view.analysis.subdivision.faces();
    faces.map(|face| (Geometry::Point(view.position(graph.position(face))), row(face))).collect()
}
