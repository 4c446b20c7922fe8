//! The navigation graph under the rules of people.
//!
//! A rule about a node is taken for the nearest one, a rule about a lane for that which leads past both of its places: its
//! nodes, or the bends that some exports show as nodes. Cost: O(rules x (nodes + bends)).

use std::collections::{BTreeMap, BTreeSet};

use super::navigation_graph::{Lane, NavigationGraph};
use crate::geometry::Point;
use crate::lane_rule::LaneRule;

/// How far from its place in a rule a node or a lane may lie, metres: a new scan moves nodes by some cells, and two nodes on one
/// course are at least half a metre apart.
pub const NODE_REACH_M: f64 = 1.0;

impl NavigationGraph {
    /// The node nearest to a point of the grid frame, by index; `None` in an empty graph.
    #[must_use]
    pub fn nearest_node(&self, point: Point) -> Option<usize> {
        let distance = |&node: &usize| (self.nodes[node].position - point).norm_squared();
        (0..self.nodes.len()).min_by(|one, other| distance(one).total_cmp(&distance(other)))
    }

    /// The graph without what the rules, in the grid frame, forbid. Those that no node or lane fits are told in
    /// [`Self::unmatched_rules`].
    #[must_use]
    pub fn ruled(mut self, rules: &[LaneRule]) -> Self {
        let mut dropped = BTreeSet::new();
        let mut closed: BTreeSet<(usize, usize)> = BTreeSet::new();
        for (index, rule) in rules.iter().enumerate() {
            let is_matched = match *rule {
                LaneRule::NoNode { at } => self.node_at(at).map(|node| dropped.insert(node)).is_some(),
                LaneRule::NoLane { from, to } => {
                    let lanes = [self.lane_past([from, to]), self.lane_past([to, from])];
                    closed.extend(lanes.into_iter().flatten());
                    lanes.iter().any(Option::is_some)
                }
                LaneRule::OneWay { from, to } => {
                    let (onwards, back) = (self.lane_past([from, to]), self.lane_past([to, from]));
                    closed.extend(back);
                    onwards.or(back).is_some()
                }
            };
            if !is_matched {
                self.unmatched_rules.push(index);
            }
        }
        self.without(&dropped, &closed)
    }

    fn node_at(&self, point: Point) -> Option<usize> {
        self.nearest_node(point).filter(|&node| (self.nodes[node].position - point).norm() <= NODE_REACH_M)
    }

    /// The ends of the lane that leads past two places, the first one first: of several the one that is nearest to both.
    fn lane_past(&self, [from, to]: [Point; 2]) -> Option<(usize, usize)> {
        let past = |lane: &Lane| {
            let [(near_from, first), (near_to, last)] = [from, to].map(|place| nearest_on(&lane.path, place));
            let is_past = near_from <= NODE_REACH_M && near_to <= NODE_REACH_M && first < last;
            is_past.then_some((near_from + near_to, (lane.from, lane.to)))
        };
        let nearest = self.lanes.iter().filter_map(past).min_by(|one, other| one.0.total_cmp(&other.0));
        nearest.map(|(_, ends)| ends)
    }

    fn without(self, dropped: &BTreeSet<usize>, closed: &BTreeSet<(usize, usize)>) -> Self {
        let kept: Vec<usize> = (0..self.nodes.len()).filter(|node| !dropped.contains(node)).collect();
        let places: BTreeMap<usize, usize> = kept.iter().enumerate().map(|(place, &node)| (node, place)).collect();
        let nodes = kept.iter().map(|&node| self.nodes[node].clone()).collect();
        let is_open = |lane: &Lane| !closed.contains(&(lane.from, lane.to));
        let lane = |lane: Lane| Some(Lane { from: *places.get(&lane.from)?, to: *places.get(&lane.to)?, ..lane });
        let lanes = self.lanes.into_iter().filter(is_open).filter_map(lane).collect();
        Self { nodes, unmatched_rules: self.unmatched_rules, ..Self::of_lanes(lanes) }
    }
}

/// How far a point is from a path, and how far along the path the nearest point of it lies, metres.
fn nearest_on(path: &[Point], point: Point) -> (f64, f64) {
    let mut best = (f64::INFINITY, 0.0);
    let mut along = 0.0;
    for pair in path.windows(2) {
        let way = pair[1] - pair[0];
        let length = way.norm();
        let share = ((point - pair[0]).dot(&way) / length.powi(2).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        let distance = (point - (pair[0] + way * share)).norm();
        if distance < best.0 {
            best = (distance, along + share * length);
        }
        along += length;
    }
    best
}
