//! The navigation graph with straight edges, for formats whose vehicles drive straight from node to node.
//!
//! Method: a lane that bends becomes straight edges over nodes at its bends. The two directions of a lane share those
//! nodes. A node at a bend is named after the lane and counted along it, so that it keeps its name as long as the ends of
//! the lane keep theirs. Cost: O(points of all lanes).

use std::borrow::Cow;
use std::collections::BTreeSet;

use stillage_core::graph::{GraphNode, Lane};

use super::source::ExportSource;

/// A node of the graph, or a bend of a lane.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct StraightNode<'a> {
    /// Unique.
    pub name: Cow<'a, str>,
    /// Metres, map frame.
    pub position: [f64; 2],
    /// `None` at a bend.
    pub node: Option<&'a GraphNode>,
}

/// A directed straight edge: a lane, or a part of one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct StraightEdge<'a> {
    /// Node it begins at, by index.
    pub from: usize,
    /// Node it ends at, by index.
    pub to: usize,
    /// The lane.
    pub lane: &'a Lane,
}

/// Nodes and straight edges.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct StraightGraph<'a> {
    /// The nodes of the graph in their order, then bends.
    pub nodes: Vec<StraightNode<'a>>,
    /// The edges, lane by lane.
    pub edges: Vec<StraightEdge<'a>>,
}

impl<'a> StraightGraph<'a> {
    /// Reads the graph of a map.
    pub fn of(source: &ExportSource<'a>) -> Self {
        let node = |node: &'a GraphNode| StraightNode {
            name: Cow::Borrowed(node.name.as_str()),
            position: source.position(node.position),
            node: Some(node),
        };
        let mut graph = Self { nodes: source.graph.nodes.iter().map(node).collect(), edges: Vec::new() };
        let mut names: BTreeSet<Cow<'a, str>> = graph.nodes.iter().map(|node| node.name.clone()).collect();
        let mut bends: Vec<Vec<usize>> = Vec::new();
        for (index, lane) in source.graph.lanes.iter().enumerate() {
            // A twin that came before has the same bends, the other way round.
            let shared = lane.twin.filter(|&twin| twin < index).map(|twin| bends[twin].iter().rev().copied().collect());
            let over = shared.unwrap_or_else(|| graph.add_bends(source, lane, &mut names));
            let stops: Vec<usize> = [lane.from].into_iter().chain(over.iter().copied()).chain([lane.to]).collect();
            graph.edges.extend(stops.windows(2).map(|pair| StraightEdge { from: pair[0], to: pair[1], lane }));
            bends.push(over);
        }
        graph
    }

    /// Length of an edge, metres.
    pub fn length(&self, edge: StraightEdge<'_>) -> f64 {
        let [[x, y], [to_x, to_y]] = [edge.from, edge.to].map(|node| self.nodes[node].position);
        (to_x - x).hypot(to_y - y)
    }

    /// Adds nodes at the bends of a lane, and tells their indices.
    fn add_bends(&mut self, source: &ExportSource<'a>, lane: &Lane, names: &mut BTreeSet<Cow<'a, str>>) -> Vec<usize> {
        let [start, end] = [lane.from, lane.to].map(|node| self.nodes[node].clone());
        let mut before = start.position;
        let mut added = Vec::new();
        for &point in lane.path.get(1..lane.path.len().saturating_sub(1)).unwrap_or_default() {
            let position = source.position(point);
            // Points that fall together when they are rounded would make an edge without length.
            if position == before || position == end.position {
                continue;
            }
            before = position;
            let mut name: Cow<'a, str> = Cow::Owned(format!("{}/{}/{}", start.name, end.name, added.len() + 1));
            while !names.insert(name.clone()) {
                name.to_mut().push('\'');
            }
            added.push(self.nodes.len());
            self.nodes.push(StraightNode { name, position, node: None });
        }
        added
    }
}
