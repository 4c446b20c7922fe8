//! Navigation graph of Open-RMF fleet adapters.
//!
//! Source: `rmf_fleet_adapter`, `parse_graph.cpp`, github.com/open-rmf/rmf_ros2.
//!
//! Method: a vertex for each node, a lane for each lane; both are numbered by their place in the file. Names are
//! unique, as the adapter asks: nodes have unique names, and a vertex that serves a location is named by the location's
//! code. Lanes are straight there, so a lane that bends passes through vertices without a name. Limits: one level;
//! vehicles may drive lanes either way round.

use stillage_core::graph::NodeKind;

use super::source::ExportSource;
use super::straight_graph::{StraightGraph, StraightNode};
use super::yaml::{number, quoted};

/// The graph as YAML.
#[must_use]
pub fn nav_graph(source: &ExportSource<'_>) -> Vec<u8> {
    let graph = StraightGraph::of(source);
    let mut text = format!("building_name: {}\ndoors: {{}}\nlifts: {{}}\nlevels:\n  L1:\n", quoted(source.name));
    let mut line = |line: String| text.extend([line.as_str(), "\n"]);
    line(list_head("vertices", graph.nodes.is_empty()));
    for vertex in &graph.nodes {
        let name = vertex_name(vertex);
        let mut properties = if name.is_empty() { String::new() } else { format!("name: {}", quoted(name)) };
        if is_holding_point(vertex) {
            properties.push_str(", is_holding_point: true");
        }
        let [x, y] = vertex.position.map(number);
        line(format!("    - [{x}, {y}, {{{properties}}}]"));
    }
    line(list_head("lanes", graph.edges.is_empty()));
    for edge in graph.edges {
        line(format!("    - [{}, {}, {{}}]", edge.from, edge.to));
    }
    text.into_bytes()
}

/// Name of a vertex; empty at a bend, which is no place to send a vehicle to.
pub(super) fn vertex_name<'a>(vertex: &StraightNode<'a>) -> &'a str {
    vertex.node.map_or("", |node| &node.name)
}

/// Whether a vehicle may wait there: at the end of a lane it is in nobody's way.
pub(super) fn is_holding_point(vertex: &StraightNode<'_>) -> bool {
    vertex.node.is_some_and(|node| node.kind == NodeKind::DeadEnd)
}

/// The key of a list; an empty list stands beside its key.
pub(super) fn list_head(name: &str, is_empty: bool) -> String {
    if is_empty { format!("    {name}: []") } else { format!("    {name}:") }
}
