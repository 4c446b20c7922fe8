//! Size and form of a graph.
//!
//! Method: the diameter by bounds on the eccentricities (F. Takes and W. Kosters, *Determining the diameter of small world
//! networks*, 2011, doi 10.1145/2063576.2063748): each breadth-first search narrows the bounds of all nodes, those that can no
//! longer matter are left out. Cost: O(lanes) for each search, some dozens as a rule, as many as nodes at worst.

use std::collections::VecDeque;

use super::components::GraphComponent;
use super::lane_network::LaneNetwork;
use crate::watch::{Stopped, Watch};

/// Size and form of a graph. Two nodes that lanes join, in one direction or both, are one edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StructureFigures {
    /// Nodes (`num_nodes`).
    pub nodes: usize,
    /// Pairs of nodes that lanes join (`num_edges`).
    pub edges: usize,
    /// Mean number of edges at a node; 0 without nodes (`average_degree`).
    pub average_degree: f64,
    /// Mean length of an edge along its course, metres; `None` without edges (`average_edge_length`, where edges are
    /// straight).
    pub average_edge_length: Option<f64>,
    /// Edges on the longest of the ways with the fewest edges, in the component with the most nodes (`graph_diameter`, which
    /// is infinite there for a graph in several components).
    pub graph_diameter: usize,
    /// Mean over the nodes of the share of the pairs of their neighbours that are neighbours themselves, 0 for nodes with one
    /// neighbour; 0 without nodes (`average_clustering`).
    pub average_clustering: f64,
}

pub(super) fn structure(
    network: &LaneNetwork<'_>,
    components: &[GraphComponent],
    watch: &Watch<'_>,
) -> Result<StructureFigures, Stopped> {
    let lengths: Vec<f64> = network.pairs().map(|(_, other)| network.lane(other.lane).length()).collect();
    let nodes = network.len();
    let largest =
        components.iter().max_by_key(|component| (component.nodes.len(), std::cmp::Reverse(component.nodes[0])));
    let clustering: f64 = (0..nodes).map(|node| clustering(network, node)).sum();
    Ok(StructureFigures {
        nodes,
        edges: lengths.len(),
        average_degree: 2.0 * lengths.len() as f64 / nodes.max(1) as f64,
        average_edge_length: (!lengths.is_empty()).then(|| lengths.iter().sum::<f64>() / lengths.len() as f64),
        graph_diameter: largest.map_or(Ok(0), |component| diameter(network, &component.nodes, watch))?,
        average_clustering: clustering / nodes.max(1) as f64,
    })
}

/// Share of the pairs of a node's neighbours that are neighbours themselves.
fn clustering(network: &LaneNetwork<'_>, node: usize) -> f64 {
    let neighbours = network.neighbours(node);
    let pairs = neighbours.len() * neighbours.len().saturating_sub(1) / 2;
    let is_joined = |one: usize, other: usize| {
        network.neighbours(one).binary_search_by_key(&other, |neighbour| neighbour.node).is_ok()
    };
    let above = |(index, one)| neighbours[index + 1..].iter().map(move |other| (one, *other));
    let all = neighbours.iter().copied().enumerate().flat_map(above);
    let joined =
        all.filter(|&(one, other): &(super::lane_network::Neighbour, _)| is_joined(one.node, other.node)).count();
    joined as f64 / pairs.max(1) as f64
}

/// The longest of the shortest ways between the nodes of a component, in edges.
fn diameter(network: &LaneNetwork<'_>, component: &[usize], watch: &Watch<'_>) -> Result<usize, Stopped> {
    let mut open: Vec<usize> = component.to_vec();
    let mut bounds = vec![[0, usize::MAX]; network.len()];
    let (mut low, mut high) = (0, usize::MAX);
    let mut picks_high = true;
    while low < high && !open.is_empty() {
        watch.check()?;
        let pick = |&&node: &&usize| {
            let [lower, upper] = bounds[node];
            // The node that may be farthest from another, and the one that is nearest to all, in turn; the first of equals.
            (if picks_high { upper } else { usize::MAX - lower }, network.neighbours(node).len(), usize::MAX - node)
        };
        let Some(&node) = open.iter().max_by_key(pick) else { break };
        picks_high = !picks_high;
        let steps = steps_from(network, node);
        let eccentricity = component.iter().map(|&other| steps[other]).max().unwrap_or(0);
        bounds[node] = [eccentricity; 2];
        for &other in &open {
            let [lower, upper] = &mut bounds[other];
            *lower = (*lower).max(eccentricity - steps[other]).max(steps[other]);
            *upper = (*upper).min(eccentricity + steps[other]);
        }
        low = open.iter().map(|&other| bounds[other][0]).max().unwrap_or(low).max(low);
        open.retain(|&other| other != node && bounds[other][1] > low);
        high = open.iter().map(|&other| bounds[other][1]).max().unwrap_or(low);
    }
    Ok(low)
}

/// Edges from a node to every other one; `usize::MAX` where no way leads.
fn steps_from(network: &LaneNetwork<'_>, start: usize) -> Vec<usize> {
    let mut steps = vec![usize::MAX; network.len()];
    steps[start] = 0;
    let mut open = VecDeque::from([start]);
    while let Some(node) = open.pop_front() {
        for next in network.neighbours(node) {
            if steps[next.node] == usize::MAX {
                steps[next.node] = steps[node] + 1;
                open.push_back(next.node);
            }
        }
    }
    steps
}
