//! Building file of Open-RMF, for its traffic editor and its generators of maps and worlds.
//!
//! Source: `rmf_building_map_tools`, github.com/open-rmf/rmf_traffic_editor. Coordinates are metres of the map frame
//! (`coordinate_system: cartesian_meters`). A property is a pair of a type and a value: 1 text, 2 integer, 3 number,
//! 4 truth.
//!
//! Method: vertices and lanes as in the navigation graph; two lanes in opposite directions become one that is
//! bidirectional. Cost: O(lanes log lanes). Limits: no walls, no doors and no models.

use std::collections::BTreeSet;

use super::rmf_nav_graph::{is_holding_point, list_head, vertex_name};
use super::source::ExportSource;
use super::straight_graph::StraightGraph;
use super::yaml::{number, quoted};

/// What a file without people, without other levels and with one level on the ground has.
const CROWD: &str = "crowd_sim: {agent_groups: [], agent_profiles: [], enable: 0, goal_sets: [], model_types: [], \
                     obstacle_set: {}, states: [], transitions: [], update_time_step: 0.1}";

/// The building as YAML.
#[must_use]
pub fn building(source: &ExportSource<'_>) -> Vec<u8> {
    let graph = StraightGraph::of(source);
    let mut text = head(source);
    let mut line = |line: String| text.extend([line.as_str(), "\n"]);
    line(list_head("vertices", graph.nodes.is_empty()));
    for vertex in &graph.nodes {
        let properties = if is_holding_point(vertex) { "is_holding_point: [4, true]" } else { "" };
        let ([x, y], name) = (vertex.position.map(number), quoted(vertex_name(vertex)));
        line(format!("      - [{x}, {y}, 0, {name}, {{{properties}}}]"));
    }
    line(list_head("lanes", graph.edges.is_empty()));
    let all: BTreeSet<[usize; 2]> = graph.edges.iter().map(|edge| [edge.from, edge.to]).collect();
    for &[from, to] in &all {
        let is_both = all.contains(&[to, from]);
        if from < to || !is_both {
            let ways = format!("bidirectional: [4, {is_both}], graph_idx: [2, 0], orientation: [1, \"\"]");
            line(format!("      - [{from}, {to}, {{{ways}}}]"));
        }
    }
    for empty in ["walls", "floors", "doors", "models", "measurements"] {
        line(list_head(empty, true));
    }
    line("lifts: {}".to_owned());
    text.into_bytes()
}

/// Everything before the vertices.
fn head(source: &ExportSource<'_>) -> String {
    let cell = source.grid.resolution();
    let [width, height] = [source.grid.width(), source.grid.height()].map(|cells| number(cells as f64 * cell));
    let building = format!("name: {}\ncoordinate_system: cartesian_meters\n{CROWD}\n", quoted(source.name));
    let level = "graphs: {}\nlevels:\n  L1:\n    elevation: 0\n    layers: {}\n";
    let size = format!("    x_meters: {width}\n    y_meters: {height}\n");
    let offset = "    flattened_x_offset: 0\n    flattened_y_offset: 0\n    fiducials: []\n";
    [&building, level, &size, offset].concat()
}
