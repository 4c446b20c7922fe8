//! Vertices of the subdivision.

use crate::features::geometry::{Geometry, GeometryType};
use crate::features::property::{Kind, Property};
use crate::features::table::{Column, Table};
use crate::features::view::AnalysedMap;

/// A vertex.
#[derive(Debug, Clone, PartialEq)]
pub struct VertexRow {
    id: u32,
    edges: Vec<u32>,
}

/// The collection.
pub const TABLE: Table<VertexRow> = Table {
    title: "Vertices",
    description: "Where edges meet",
    geometry: &[GeometryType::Point],
    columns: &[
        Column::new(Property::new("id", Kind::Integer, "Id", "Number of the vertex"), |vertex| vertex.id.into()),
        Column::new(
            Property::new("edges", Kind::Integers, "Edges", "Ids of the edges that end here, ascending"),
            |vertex| vertex.edges.as_slice().into(),
        ),
    ],
};

/// The vertices of a map, by id.
#[must_use]
pub fn read(view: &AnalysedMap<'_>) -> Vec<(Geometry, VertexRow)> {
    let subdivision = &view.analysis.subdivision;
    let mut edges = vec![Vec::new(); subdivision.vertex_count()];
    for edge in subdivision.edges() {
        for vertex in subdivision.ends(edge) {
            edges[vertex.index()].push(edge.0);
        }
    }
    let rows = subdivision.vertices().zip(edges).map(|(vertex, edges)| {
        let position = view.position(subdivision.position(vertex));
        (Geometry::Point(position), VertexRow { id: vertex.0, edges })
    });
    rows.collect()
}
