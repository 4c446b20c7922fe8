//! The shortest way over portals.
//!
//! Source: A* (Hart, Nilsson and Raphael 1968, doi 10.1109/TSSC.1968.300136) with landmarks for its estimate (A. Goldberg
//! and C. Harrelson, *Computing the shortest path: A\* search meets graph theory*, 2005): the triangle inequality bounds
//! what is left from below, so a search follows the way instead of flooding the map. A way that came through a tile goes on
//! in the other one. Cost: O(portals seen x portals of a tile). Memory: 8 bytes per portal number.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::drive_grid::DriveGrid;
use super::road_map::RoadMap;
use super::tile_ways::PortalId;
use crate::geometry::Point;

/// Landmarks: more find tighter bounds and cost more per portal. No measurement is recorded for this value.
const LANDMARKS: usize = 8;

/// Lengths from some far portals to all portals.
#[derive(Debug, Clone, Default)]
pub(super) struct Landmarks {
    /// By portal, then by landmark, metres; infinite where no way leads.
    lengths: Vec<[f32; LANDMARKS]>,
}

/// What a way costs: its length times a factor for the ground.
pub(super) trait WayCost {
    /// The factor of a way through a tile between two of its cells, at least 1.
    fn factor(&self, tile: usize, from: usize, to: usize) -> f32;
}

/// The length alone.
pub(super) struct PlainLength;

impl WayCost for PlainLength {
    fn factor(&self, _: usize, _: usize, _: usize) -> f32 {
        1.0
    }
}

/// A portal reached from an end: the portal, and the cost of the way to it.
pub(super) type Reached = (PortalId, f32);

/// A portal on a way, and the tile through which the way comes to it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Passage {
    pub portal: PortalId,
    pub through: usize,
}

/// An entry of the open list: smallest total first, then smallest number.
type Open = Reverse<(u32, u32, u32)>;

/// Costs are compared as bits: they are not negative.
fn bits(cost: f32) -> u32 {
    cost.to_bits()
}

/// What a search knows of the portals.
pub(super) struct Search<'a> {
    roads: &'a RoadMap,
    /// Cost to each portal as bits, plus 1; 0 where none was reached.
    costs: Vec<u32>,
    /// The portal before it, plus 1; 0 at the start.
    before: Vec<u32>,
    /// The tile through which the way comes to it.
    through: Vec<u32>,
    open: BinaryHeap<Open>,
}

impl<'a> Search<'a> {
    /// A search that begins at some portals.
    fn new(roads: &'a RoadMap) -> Self {
        let count = roads.count();
        Self { roads, costs: vec![0; count], before: vec![0; count], through: vec![0; count], open: BinaryHeap::new() }
    }

    fn reach(&mut self, portal: PortalId, cost: f32, [before, through]: [u32; 2], estimate: f32) {
        let known = self.costs[portal.index()];
        if known == 0 || bits(cost) + 1 < known {
            self.costs[portal.index()] = bits(cost) + 1;
            self.before[portal.index()] = before;
            self.through[portal.index()] = through;
            self.open.push(Reverse((bits(cost + estimate), bits(cost), portal.0)));
        }
    }

    /// The next portal whose cost is final.
    fn settle(&mut self) -> Option<Reached> {
        while let Some(Reverse((_, cost, portal))) = self.open.pop() {
            if self.costs[portal as usize] == cost + 1 {
                return Some((PortalId(portal), f32::from_bits(cost)));
            }
        }
        None
    }

    /// Goes on from a portal into the tiles on both sides, but not back through the one that led to it.
    fn expand(&mut self, (portal, cost): Reached, ground: &impl WayCost, estimate: impl Fn(PortalId, usize) -> f32) {
        let came_through = self.through[portal.index()] as usize;
        for tile in self.roads.sides(portal).into_iter().filter(|&tile| tile != came_through) {
            let ways = self.roads.ways(tile);
            let Some(place) = ways.place_of(portal) else { continue };
            let from = ways.portals[place].cell;
            for (to, &length) in ways.portals.iter().zip(ways.lengths_from(place)) {
                if length.is_finite() && to.id != portal {
                    let cost = cost + length * ground.factor(tile, from, to.cell);
                    self.reach(to.id, cost, [portal.0 + 1, tile as u32], estimate(to.id, to.cell));
                }
            }
        }
    }

    /// The portals on the way to one that was reached.
    fn way_to(&self, portal: PortalId) -> Vec<Passage> {
        let mut way = Vec::new();
        let mut next = portal.0 + 1;
        while next > 0 {
            let portal = PortalId(next - 1);
            way.push(Passage { portal, through: self.through[portal.index()] as usize });
            next = self.before[portal.index()];
        }
        way.reverse();
        way
    }

    fn cost_to(&self, portal: PortalId) -> Option<f32> {
        let known = self.costs[portal.index()];
        (known > 0).then(|| f32::from_bits(known - 1))
    }
}

impl Landmarks {
    /// Picks portals far from each other in the largest component and measures from each.
    pub fn new(roads: &RoadMap) -> Self {
        if roads.count() == 0 {
            return Self::default();
        }
        let first = roads.hub();
        let mut lengths = vec![[f32::INFINITY; LANDMARKS]; roads.count()];
        let mut nearest = vec![f32::INFINITY; roads.count()];
        // The first one is as far as possible from anywhere.
        let mut from = farthest(roads, &lengths_from(roads, PortalId(first)), first);
        for landmark in 0..LANDMARKS {
            let measured = lengths_from(roads, from);
            for ((own, nearest), &length) in lengths.iter_mut().zip(&mut nearest).zip(&measured) {
                own[landmark] = length;
                *nearest = nearest.min(length);
            }
            from = farthest(roads, &nearest, first);
        }
        Self { lengths }
    }

    /// The most that the landmarks tell of the length between two places, metres: a lower bound.
    fn bound(&self, portal: PortalId, goal: &[f32; LANDMARKS]) -> f32 {
        let Some(own) = self.lengths.get(portal.index()) else { return 0.0 };
        let differences = own.iter().zip(goal).map(|(own, goal)| (own - goal).abs());
        // What is infinite at both ends is no number, and says nothing.
        differences.filter(|difference| difference.is_finite()).fold(0.0, f32::max)
    }

    /// Lengths from the landmarks to a place, from those to the portals around it.
    fn to_place(&self, reached: &[Reached]) -> [f32; LANDMARKS] {
        let mut lengths = [f32::INFINITY; LANDMARKS];
        for (portal, length) in reached {
            let Some(of_portal) = self.lengths.get(portal.index()) else { continue };
            for (best, own) in lengths.iter_mut().zip(of_portal) {
                *best = best.min(own + length);
            }
        }
        lengths
    }
}

fn portals(roads: &RoadMap) -> impl Iterator<Item = PortalId> + use<> {
    (0..roads.count() as u32).map(PortalId)
}

fn lengths_from(roads: &RoadMap, portal: PortalId) -> Vec<f32> {
    let mut search = Search::new(roads);
    // From a landmark the way goes into both tiles.
    search.reach(portal, 0.0, [0, u32::MAX], 0.0);
    while let Some(reached) = search.settle() {
        search.expand(reached, &PlainLength, |_, _| 0.0);
    }
    (0..roads.count() as u32).map(|id| search.cost_to(PortalId(id)).unwrap_or(f32::INFINITY)).collect()
}

/// The portal of a component that is the farthest by a list of lengths.
fn farthest(roads: &RoadMap, lengths: &[f32], component: u32) -> PortalId {
    let members = portals(roads).filter(|&portal| roads.component(portal) == component);
    let finite = members.filter(|portal| lengths[portal.index()].is_finite());
    finite.max_by(|one, other| lengths[one.index()].total_cmp(&lengths[other.index()])).unwrap_or(PortalId(component))
}

/// The portals on the cheapest way between two places that reach some portals.
pub(super) fn cheapest(
    roads: &RoadMap,
    landmarks: &Landmarks,
    grid: &DriveGrid,
    ground: &impl WayCost,
    [from, to]: [&[Reached]; 2],
    start_tile: usize,
    goal: Point,
) -> Option<(Vec<Passage>, f32)> {
    let mut search = Search::new(roads);
    let to_goal = landmarks.to_place(to);
    let estimate = |portal: PortalId, cell: usize| {
        let straight = (grid.center(cell) - goal).norm() as f32 - grid.resolution as f32;
        landmarks.bound(portal, &to_goal).max(straight) * (1.0 - 1e-5)
    };
    let mut ends: std::collections::BTreeMap<PortalId, f32> = std::collections::BTreeMap::new();
    for &(portal, cost) in to {
        ends.insert(portal, cost);
    }
    for &(portal, cost) in from {
        search.reach(portal, cost, [0, start_tile as u32], estimate(portal, roads.cells(portal)[0]).max(0.0));
    }
    let mut best: Option<(PortalId, f32)> = None;
    while let Some((portal, cost)) = search.settle() {
        let total = cost + estimate(portal, roads.cells(portal)[0]).max(0.0);
        if best.is_some_and(|(_, best)| total >= best) {
            break;
        }
        if let Some(rest) = ends.get(&portal) {
            let whole = cost + rest;
            if best.is_none_or(|(_, best)| whole < best) {
                best = Some((portal, whole));
            }
        }
        search.expand((portal, cost), ground, |portal, cell| estimate(portal, cell).max(0.0));
    }
    best.map(|(portal, cost)| (search.way_to(portal), cost))
}

/// The ways from one place to many, each as its portals; `None` where none leads.
pub(super) fn to_many(
    roads: &RoadMap,
    from: &[Reached],
    start_tile: usize,
    goals: &[&[Reached]],
) -> Vec<Option<(Vec<Passage>, f32)>> {
    let mut search = Search::new(roads);
    for &(portal, cost) in from {
        search.reach(portal, cost, [0, start_tile as u32], 0.0);
    }
    let mut missing: std::collections::BTreeSet<PortalId> =
        goals.iter().copied().flatten().map(|&(portal, _)| portal).collect();
    while let Some(reached) = search.settle() {
        missing.remove(&reached.0);
        if missing.is_empty() {
            break;
        }
        search.expand(reached, &PlainLength, |_, _| 0.0);
    }
    let best = |goal: &&[Reached]| {
        let ways = goal.iter().filter_map(|&(portal, rest)| Some((portal, search.cost_to(portal)? + rest)));
        let (portal, cost) = ways.min_by(|one, other| one.1.total_cmp(&other.1).then(one.0.cmp(&other.0)))?;
        Some((search.way_to(portal), cost))
    };
    goals.iter().map(best).collect()
}
