//! Navigation graph of Open-RMF fleet adapters.
//!
//! Source: `rmf_fleet_adapter`, `parse_graph.cpp`, github.com/open-rmf/rmf_ros2.
//!
//! Method: a vertex for each node, a lane for each lane; both are numbered by their place in the file. Names are
//! unique, as the adapter asks: nodes have unique names, and a vertex that serves a location is named by the location's
//! code. Lanes are straight there, so a lane that bends passes through vertices without a name. Limits: one level;
//! vehicles may drive lanes either way round.

use stillage_core::graph::NodeKind;

use super::rmf_graph::RmfGraph;
use super::source::ExportSource;
use super::yaml::quoted;

/// The graph as YAML.
#[must_use]
pub fn nav_graph(source: &ExportSource<'_>) -> Vec<u8> {
    let graph = RmfGraph::of(source);
    let mut text = format!("building_name: {}\ndoors: {{}}\nlifts: {{}}\nlevels:\n  L1:\n", quoted(source.name));
    let mut line = |line: String| text.extend([line.as_str(), "\n"]);
    line(list_head("vertices", graph.vertices.is_empty()));
    for vertex in &graph.vertices {
        let mut properties =
            if vertex.name.is_empty() { String::new() } else { format!("name: {}", quoted(vertex.name)) };
        if vertex.kind == Some(NodeKind::DeadEnd) {
            // A vehicle that waits there is in nobody's way.
            properties.push_str(", is_holding_point: true");
        }
        let [x, y] = vertex.position;
        line(format!("    - [{x:?}, {y:?}, {{{properties}}}]"));
    }
    line(list_head("lanes", graph.lanes.is_empty()));
    for [from, to] in graph.lanes {
        line(format!("    - [{from}, {to}, {{}}]"));
    }
    text.into_bytes()
}

/// The key of a list; an empty list stands beside its key.
pub(super) fn list_head(name: &str, is_empty: bool) -> String {
    if is_empty { format!("    {name}: []") } else { format!("    {name}:") }
}
