//! The ways between random pairs of nodes.
//!
//! Method: A* over the lanes in their direction, with the distance as the crow flies; samples in parallel. Cost: O(samples x
//! lanes x log nodes) at worst.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::f64::consts::PI;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use rayon::prelude::*;

use super::lane_network::LaneNetwork;
use super::options::ReportOptions;
use crate::geometry::Point;
use crate::graph::Lane;
use crate::site_map::SiteMap;
use crate::watch::{Stopped, Watch};

/// The ways between random pairs of nodes; means over the ways found, `None` without any (0 there).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathFigures {
    /// Mean length, metres (`average_path_length`).
    pub average_path_length: Option<f64>,
    /// Mean over the ways of one less their mean turn as a share of a half turn: 1 straight, 0 there and back
    /// (`average_path_smoothness`). Turns are those at nodes and at the bends of lanes; there at nodes only.
    pub average_path_smoothness: Option<f64>,
    /// Share of the pairs between which a way leads, 0 to 1; `None` with fewer than two nodes (`path_success_rate`).
    pub path_success_rate: Option<f64>,
    /// Mean over the ways of their mean distance to the nearest obstacle, metres (`average_path_clearance`, in pixels there
    /// and to the middle of the cell instead of its border).
    pub average_path_clearance: Option<f64>,
}

/// One way.
struct SampledPath {
    length: f64,
    smoothness: f64,
    clearance: f64,
}

pub(super) fn paths(
    map: &SiteMap<'_>,
    network: &LaneNetwork<'_>,
    options: &ReportOptions,
    watch: &Watch<'_>,
) -> Result<PathFigures, Stopped> {
    let pairs = random_pairs(network.len(), options);
    let clearances: Vec<f64> = network.graph.lanes.par_iter().map(|lane| mean_clearance(map, lane)).collect();
    let sampled = |search: &mut LaneSearch<'_>, &[from, to]: &[usize; 2]| {
        watch.check()?;
        Ok(search.between(from, to).map(|lanes| SampledPath::new(network, &lanes, &clearances)))
    };
    let found: Result<Vec<Option<SampledPath>>, Stopped> =
        pairs.par_iter().map_init(|| LaneSearch::new(network), sampled).collect();
    let found: Vec<SampledPath> = found?.into_iter().flatten().collect();
    let mean = |value: fn(&SampledPath) -> f64| {
        (!found.is_empty()).then(|| found.iter().map(value).sum::<f64>() / found.len() as f64)
    };
    Ok(PathFigures {
        average_path_length: mean(|path| path.length),
        average_path_smoothness: mean(|path| path.smoothness),
        path_success_rate: (!pairs.is_empty()).then(|| found.len() as f64 / pairs.len() as f64),
        average_path_clearance: mean(|path| path.clearance),
    })
}

/// Pairs of different nodes.
fn random_pairs(nodes: usize, options: &ReportOptions) -> Vec<[usize; 2]> {
    if nodes < 2 {
        return Vec::new();
    }
    let mut random = ChaCha8Rng::seed_from_u64(options.seed);
    let mut below = |end: usize| ((u128::from(random.next_u64()) * end as u128) >> u64::BITS) as usize;
    let mut pair = || {
        let (from, to) = (below(nodes), below(nodes - 1));
        [from, to + usize::from(to >= from)]
    };
    (0..options.samples).map(|_| pair()).collect()
}

/// Mean distance to the nearest obstacle along a lane, metres: at points a cell apart.
fn mean_clearance(map: &SiteMap<'_>, lane: &Lane) -> f64 {
    let (mut sum, mut length) = (0.0, 0.0);
    for pair in lane.path.windows(2) {
        let way = pair[1] - pair[0];
        let steps = (way.norm() / map.grid.resolution()).ceil().max(1.0) as usize;
        let at = |step: usize| pair[0] + way * ((step as f64 + 0.5) / steps as f64);
        let mean = (0..steps).map(|step| map.clearance.at(at(step))).sum::<f64>() / steps as f64;
        sum += mean * way.norm();
        length += way.norm();
    }
    if length > 0.0 { sum / length } else { lane.path.first().map_or(0.0, |&point| map.clearance.at(point)) }
}

impl SampledPath {
    fn new(network: &LaneNetwork<'_>, lanes: &[usize], clearances: &[f64]) -> Self {
        let lengths = || lanes.iter().map(|&lane| network.lane(lane).length());
        let length: f64 = lengths().sum();
        let clearance: f64 = lengths().zip(lanes).map(|(length, &lane)| length * clearances[lane]).sum();
        let mut points: Vec<Point> = lanes.iter().flat_map(|&lane| network.lane(lane).path.iter().copied()).collect();
        points.dedup();
        let turns: Vec<f64> =
            points.windows(3).map(|corner| (corner[1] - corner[0]).angle(&(corner[2] - corner[1]))).collect();
        let mean_turn = turns.iter().sum::<f64>() / turns.len().max(1) as f64;
        Self {
            length,
            smoothness: 1.0 - mean_turn / PI,
            clearance: if length > 0.0 { clearance / length } else { 0.0 },
        }
    }
}

/// Looks for the shortest ways over lanes.
struct LaneSearch<'a> {
    network: &'a LaneNetwork<'a>,
    /// By node: its length from the start, metres, and the lane it is reached over.
    reached: Vec<(f64, usize)>,
    touched: Vec<usize>,
}

impl<'a> LaneSearch<'a> {
    fn new(network: &'a LaneNetwork<'a>) -> Self {
        Self { network, reached: vec![(f64::INFINITY, usize::MAX); network.len()], touched: Vec::new() }
    }

    /// The lanes of the shortest way between two nodes; `None` where none leads.
    fn between(&mut self, from: usize, to: usize) -> Option<Vec<usize>> {
        for node in self.touched.drain(..) {
            self.reached[node] = (f64::INFINITY, usize::MAX);
        }
        let goal = self.network.node(to).position;
        // Lengths are not negative, so their bits sort like them.
        let rank = |length: f64, node: usize| (length + (self.network.node(node).position - goal).norm()).to_bits();
        let mut open = BinaryHeap::from([Reverse((rank(0.0, from), from))]);
        self.reached[from].0 = 0.0;
        self.touched.push(from);
        while let Some(Reverse((ranked, node))) = open.pop() {
            let length = self.reached[node].0;
            if node == to {
                return Some(self.lanes_to(from, to));
            }
            if ranked > rank(length, node) {
                continue;
            }
            for lane in self.network.lanes_from(node) {
                let next = self.network.lane(lane).to;
                let longer = length + self.network.lane(lane).length();
                if longer < self.reached[next].0 {
                    self.reached[next] = (longer, lane);
                    self.touched.push(next);
                    open.push(Reverse((rank(longer, next), next)));
                }
            }
        }
        None
    }

    fn lanes_to(&self, from: usize, mut node: usize) -> Vec<usize> {
        let mut lanes = Vec::new();
        while node != from {
            let (_, lane) = self.reached[node];
            lanes.push(lane);
            node = self.network.lane(lane).from;
        }
        lanes.reverse();
        lanes
    }
}
