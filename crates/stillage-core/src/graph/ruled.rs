//! The navigation graph under the rules of people.
//!
//! Each place of a rule is taken for the nearest node. Cost: O(rules x nodes + lanes).

use std::collections::{BTreeMap, BTreeSet};

use super::navigation_graph::{Lane, NavigationGraph};
use crate::geometry::Point;
use crate::lane_rule::LaneRule;

/// How far from its place in a rule a node may lie, metres: a new scan moves nodes by some cells, and two nodes on one
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
                LaneRule::NoLane { from, to } => self.lane_between([from, to]).is_some_and(|(from, to)| {
                    closed.extend([(from, to), (to, from)]);
                    true
                }),
                LaneRule::OneWay { from, to } => self.lane_between([from, to]).is_some_and(|(from, to)| {
                    closed.insert((to, from));
                    true
                }),
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

    /// The nodes at two places, if a lane joins them.
    fn lane_between(&self, [from, to]: [Point; 2]) -> Option<(usize, usize)> {
        let (from, to) = (self.node_at(from)?, self.node_at(to)?);
        let joins = |lane: &Lane| (lane.from, lane.to) == (from, to) || (lane.from, lane.to) == (to, from);
        self.lanes.iter().any(joins).then_some((from, to))
    }

    fn without(self, dropped: &BTreeSet<usize>, closed: &BTreeSet<(usize, usize)>) -> Self {
        let kept: Vec<usize> = (0..self.nodes.len()).filter(|node| !dropped.contains(node)).collect();
        let places: BTreeMap<usize, usize> = kept.iter().enumerate().map(|(place, &node)| (node, place)).collect();
        let nodes = kept.iter().map(|&node| self.nodes[node].clone()).collect();
        let is_open = |lane: &Lane| !closed.contains(&(lane.from, lane.to));
        let lane = |lane: Lane| Some(Lane { from: *places.get(&lane.from)?, to: *places.get(&lane.to)?, ..lane });
        let mut lanes: Vec<Lane> = self.lanes.into_iter().filter(is_open).filter_map(lane).collect();
        let index: BTreeMap<(usize, usize), usize> =
            lanes.iter().enumerate().map(|(index, lane)| ((lane.from, lane.to), index)).collect();
        for lane in &mut lanes {
            lane.twin = index.get(&(lane.to, lane.from)).copied();
        }
        Self { nodes, lanes, unmatched_rules: self.unmatched_rules }
    }
}
