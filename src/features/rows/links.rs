//! Links of the adjacency graph.

use stillage_core::arrangement::EdgeId;

use crate::features::geometry::{Geometry, GeometryType};
use crate::features::property::{Kind, Property};
use crate::features::table::{Column, Table};
use crate::features::view::AnalysedMap;
use crate::features::words;

/// A link.
#[derive(Debug, Clone, PartialEq)]
pub struct LinkRow {
    /// Its edge has the same number.
    id: u32,
    /// The nodes at its ends.
    ends: [u32; 2],
    connectivity: Option<&'static str>,
    is_drivable: bool,
}

/// The collection.
pub const TABLE: Table<LinkRow> = Table {
    title: "Links",
    description: "The links of the adjacency graph, with their connectivity",
    geometry: &[GeometryType::LineString],
    columns: &[
        Column::new(Property::new("id", Kind::Integer, "Id", "Number of the link"), |link| link.id.into()),
        Column::new(Property::new("from", Kind::Integer, "From", "Id of the node where it begins"), |link| {
            link.ends[0].into()
        }),
        Column::new(Property::new("to", Kind::Integer, "To", "Id of the node where it ends"), |link| {
            link.ends[1].into()
        }),
        Column::new(
            Property::new(
                "connectivity",
                Kind::Word(words::CONNECTIVITY),
                "Connectivity",
                "What lies between its ends: an obstruction, an access to storage, or nothing",
            ),
            |link| link.connectivity.into(),
        ),
        Column::new(
            Property::new("drivable", Kind::Boolean, "Drivable", "Whether a robot may drive over it"),
            |link| link.is_drivable.into(),
        ),
        Column::new(Property::new("edge", Kind::Integer, "Edge", "Id of the edge it crosses"), |link| link.id.into()),
    ],
};

/// The links of a map, by id. Each runs from node to node through the middle of its edge.
#[must_use]
pub fn read(view: &AnalysedMap<'_>) -> Vec<(Geometry, LinkRow)> {
    let (subdivision, graph) = (&view.analysis.subdivision, &view.analysis.graph);
    let row = |edge: EdgeId| {
        let sides = subdivision.sides(edge);
        let row = LinkRow {
            id: edge.0,
            ends: sides.map(|face| face.0),
            connectivity: view.semantic.connectivity[edge.index()].map(words::connectivity),
            is_drivable: view.semantic.is_drivable_link(edge, sides),
        };
        let [start, end] = subdivision.segment(edge);
        let [from, to] = sides.map(|face| graph.position(face));
        let path = [from, nalgebra::center(&start, &end), to].map(|point| view.position(point));
        (Geometry::LineString(path.to_vec()), row)
    };
    subdivision.edges().filter(|&edge| view.has_link(edge)).map(row).collect()
}
