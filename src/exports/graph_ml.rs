//! The navigation graph as `GraphML`, for networkx, Gephi, yEd and others.
//!
//! Source: *The `GraphML` File Format*, graphml.graphdrawing.org. Method: a directed graph; positions, kinds and widths
//! are data of nodes and edges. Cost: O(nodes + lanes). Limits: the course of a lane between its ends is not told.

use super::nav2_route::class;
use super::source::ExportSource;
use crate::features::rounded;

/// Data of nodes and edges: id, owner and type.
const KEYS: [(&str, &str, &str); 10] = [
    ("x", "node", "double"),
    ("y", "node", "double"),
    ("kind", "node", "string"),
    ("location", "node", "string"),
    ("heading", "node", "double"),
    ("clearance", "node", "double"),
    ("length", "edge", "double"),
    ("width", "edge", "double"),
    ("label", "edge", "string"),
    ("name", "graph", "string"),
];

/// The graph as XML.
#[must_use]
pub fn graph(source: &ExportSource<'_>) -> Vec<u8> {
    let mut out = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    out.push_str("<graphml xmlns=\"http://graphml.graphdrawing.org/xmlns\">\n");
    for (id, owner, kind) in KEYS {
        out.extend([format!("  <key id=\"{id}\" for=\"{owner}\" attr.name=\"{id}\" attr.type=\"{kind}\"/>\n")]);
    }
    out.extend([format!("  <graph id=\"{}\" edgedefault=\"directed\">\n", escaped(source.map_id))]);
    out.extend([format!("    {}\n", data("name", source.name))]);
    for node in &source.graph.nodes {
        let [x, y] = source.position(node.position);
        let location = node.location.and_then(|index| source.layout.locations.get(index));
        let optional = [
            location.map(|location| data("location", &location.code)),
            node.heading.map(|angle| data("heading", &source.heading(angle).to_string())),
        ];
        let known = [
            data("x", &x.to_string()),
            data("y", &y.to_string()),
            data("kind", class(node.kind)),
            data("clearance", &rounded(node.clearance).to_string()),
        ];
        let all: String = known.into_iter().chain(optional.into_iter().flatten()).collect();
        out.extend([format!("    <node id=\"{}\">{all}</node>\n", escaped(&node.name))]);
    }
    push_edges(source, &mut out);
    out.push_str("  </graph>\n</graphml>\n");
    out.into_bytes()
}

fn push_edges(source: &ExportSource<'_>, out: &mut String) {
    for lane in &source.graph.lanes {
        let [from, to] = [lane.from, lane.to].map(|node| escaped(&source.graph.nodes[node].name));
        let length = data("length", &rounded(lane.length()).to_string());
        let width = data("width", &rounded(lane.width).to_string());
        let label = data("label", source.lane_label(lane));
        out.extend([format!("    <edge source=\"{from}\" target=\"{to}\">{length}{width}{label}</edge>\n")]);
    }
}

fn data(key: &str, value: &str) -> String {
    format!("<data key=\"{key}\">{}</data>", escaped(value))
}

/// Text of XML 1.0; characters that it does not allow become the replacement character.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\t' | '\n' | '\r' => out.extend([format!("&#{};", u32::from(character))]),
            '\0'..='\u{1f}' | '\u{fffe}' | '\u{ffff}' => out.push(char::REPLACEMENT_CHARACTER),
            plain => out.push(plain),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::escaped;

    #[test]
    fn every_text_is_xml() {
        assert_eq!(escaped("a<b>&\"c\"\n\u{1}é"), "a&lt;b&gt;&amp;&quot;c&quot;&#10;\u{fffd}é");
    }
}
