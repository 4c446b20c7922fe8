//! What both files of Open-RMF tell: vertices, and straight lanes between them.
//!
//! Method: a lane that bends becomes straight lanes over vertices at its bends. The two directions of a lane share
//! those vertices. Cost: O(points of all lanes).

use stillage_core::graph::{Lane, NodeKind};

use super::source::ExportSource;

/// A vertex.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct RmfVertex<'a> {
    /// Metres, map frame.
    pub position: [f64; 2],
    /// Empty at a bend.
    pub name: &'a str,
    /// What its node is for; `None` at a bend.
    pub kind: Option<NodeKind>,
}

/// Vertices and directed straight lanes.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct RmfGraph<'a> {
    /// The nodes of the graph, then bends.
    pub vertices: Vec<RmfVertex<'a>>,
    /// From and to, by index.
    pub lanes: Vec<[usize; 2]>,
}

impl<'a> RmfGraph<'a> {
    /// Reads the graph of a map.
    pub fn of(source: &ExportSource<'a>) -> Self {
        let vertex = |node: &'a stillage_core::graph::GraphNode| RmfVertex {
            position: source.position(node.position),
            name: &node.name,
            kind: Some(node.kind),
        };
        let mut graph = Self { vertices: source.graph.nodes.iter().map(vertex).collect(), lanes: Vec::new() };
        let mut bends: Vec<Vec<usize>> = Vec::new();
        for (index, lane) in source.graph.lanes.iter().enumerate() {
            // A twin that came before has the same bends, the other way round.
            let shared = lane.twin.filter(|&twin| twin < index).map(|twin| bends[twin].iter().rev().copied().collect());
            let over = shared.unwrap_or_else(|| graph.add_bends(source, lane));
            let stops: Vec<usize> = [lane.from].into_iter().chain(over.iter().copied()).chain([lane.to]).collect();
            graph.lanes.extend(stops.windows(2).map(|pair| [pair[0], pair[1]]));
            bends.push(over);
        }
        graph
    }

    fn add_bends(&mut self, source: &ExportSource<'a>, lane: &Lane) -> Vec<usize> {
        let inner = lane.path.get(1..lane.path.len().saturating_sub(1)).unwrap_or_default();
        let first = self.vertices.len();
        self.vertices.extend(inner.iter().map(|&point| RmfVertex {
            position: source.position(point),
            name: "",
            kind: None,
        }));
        (first..self.vertices.len()).collect()
    }
}
