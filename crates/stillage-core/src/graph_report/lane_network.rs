//! The lanes of a graph by node, in their direction and in either.

use crate::graph::{GraphNode, Lane, LaneKind, NavigationGraph};

/// A node that a lane joins with another, in one direction or both.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Neighbour {
    pub node: usize,
    /// The lane that leads there, or else the one that comes from there.
    pub lane: usize,
    pub kind: LaneKind,
}

/// The lanes of a graph by node.
pub(super) struct LaneNetwork<'a> {
    pub graph: &'a NavigationGraph,
    /// By node: its first lane; one more at the end.
    firsts: Vec<usize>,
    /// By node, ascending.
    neighbours: Vec<Vec<Neighbour>>,
}

impl<'a> LaneNetwork<'a> {
    pub fn new(graph: &'a NavigationGraph) -> Self {
        let firsts = (0..=graph.nodes.len()).map(|node| graph.lanes.partition_point(|lane| lane.from < node)).collect();
        let mut neighbours = vec![Vec::new(); graph.nodes.len()];
        for (index, lane) in graph.lanes.iter().enumerate() {
            neighbours[lane.from].push(Neighbour { node: lane.to, lane: index, kind: lane.kind });
            if lane.twin.is_none() {
                neighbours[lane.to].push(Neighbour { node: lane.from, lane: index, kind: lane.kind });
            }
        }
        for beside in &mut neighbours {
            beside.sort_by_key(|neighbour| (neighbour.node, neighbour.lane));
            beside.dedup_by_key(|neighbour| neighbour.node);
        }
        Self { graph, firsts, neighbours }
    }

    pub fn node(&self, node: usize) -> &'a GraphNode {
        &self.graph.nodes[node]
    }

    pub fn lane(&self, lane: usize) -> &'a Lane {
        &self.graph.lanes[lane]
    }

    /// How many nodes there are.
    pub fn len(&self) -> usize {
        self.graph.nodes.len()
    }

    /// The lanes that begin at a node, by index.
    pub fn lanes_from(&self, node: usize) -> std::ops::Range<usize> {
        self.firsts[node]..self.firsts[node + 1]
    }

    /// The nodes that lanes join with a node, whatever their direction.
    pub fn neighbours(&self, node: usize) -> &[Neighbour] {
        &self.neighbours[node]
    }

    /// Those that are no spurs.
    pub fn ways(&self, node: usize) -> impl Iterator<Item = Neighbour> + Clone + '_ {
        self.neighbours[node].iter().copied().filter(|neighbour| neighbour.kind == LaneKind::Way)
    }

    /// Pairs of nodes that lanes join, each once: the lower node, the other one and a lane between them.
    pub fn pairs(&self) -> impl Iterator<Item = (usize, Neighbour)> + '_ {
        self.neighbours.iter().enumerate().flat_map(|(node, neighbours)| {
            neighbours.iter().filter(move |other| other.node > node).map(move |&other| (node, other))
        })
    }
}
