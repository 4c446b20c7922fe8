//! Lanes that a vehicle leaves the way it came: two vehicles that meet there block each other.
//!
//! Spurs to locations are meant to end and do not count. Cost: O(lanes).

use super::lane_network::LaneNetwork;

/// A stretch of lanes that ends.
#[derive(Debug, Clone, PartialEq)]
pub struct DeadEnd {
    /// The node it ends at.
    pub node: usize,
    /// Length back to where lanes meet, metres; the whole way where they never do.
    pub length: f64,
    /// The node where they meet; `None` where they never do.
    pub meets_at: Option<usize>,
    /// Nodes that serve locations along it, ascending.
    pub approaches: Vec<usize>,
}

/// The dead ends of a graph, the longest first.
pub(super) fn dead_ends(network: &LaneNetwork<'_>) -> Vec<DeadEnd> {
    let is_end = |&node: &usize| network.node(node).location.is_none() && network.ways(node).count() == 1;
    let mut found: Vec<DeadEnd> = (0..network.len()).filter(is_end).map(|node| back_from(network, node)).collect();
    found.sort_by(|one, other| other.length.total_cmp(&one.length).then(one.node.cmp(&other.node)));
    found
}

fn back_from(network: &LaneNetwork<'_>, end: usize) -> DeadEnd {
    let mut dead_end = DeadEnd { node: end, length: 0.0, meets_at: None, approaches: Vec::new() };
    let (mut before, mut node) = (end, end);
    loop {
        let spurs = network.neighbours(node).iter().filter(|other| network.node(other.node).location.is_some());
        dead_end.approaches.extend(spurs.map(|other| other.node));
        let mut onwards = network.ways(node).filter(|other| other.node != before);
        let Some(next) = onwards.next() else { break };
        dead_end.length += network.lane(next.lane).length();
        (before, node) = (node, next.node);
        if network.ways(node).count() > 2 {
            dead_end.meets_at = Some(node);
            break;
        }
    }
    dead_end.approaches.sort_unstable();
    dead_end.approaches.dedup();
    dead_end
}
