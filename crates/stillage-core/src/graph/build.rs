//! The navigation graph of a map.
//!
//! Method: a gate lies in the middle of the widest free stretch of the edges that two drivable faces share; within each
//! face its course joins gates and the places where vehicles stand. A lane is straight where nothing stands in the way,
//! else it is a route. Cost: O(faces + edges + locations), each a line of sight or a short route. Limits: one lane for each
//! direction on the same course, also where two would have room side by side.

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::face_ways::Course;
use super::navigation_graph::{GraphNode, Lane, LaneKind, NavigationGraph, NodeKind};
use crate::arrangement::{EdgeId, FaceId};
use crate::geometry::Point;
use crate::layout::{Layout, approach_before};
use crate::routing::Router;
use crate::site_map::SiteMap;

/// Least distance between two nodes on the course of a face, metres: a vehicle does not stop twice within half a metre.
const LEAST_DISTANCE_M: f64 = 0.5;
/// A lane is given up that is this many times as long as the straight way: it leads around something.
const LONGEST_DETOUR: f64 = 3.0;

/// A pair of nodes that a lane in each direction joins.
type Joint = (usize, usize, LaneKind);

/// Builds the navigation graph for the vehicles of a router.
#[must_use]
pub fn navigation_graph(map: &SiteMap<'_>, layout: &Layout, router: &Router) -> NavigationGraph {
    let mut draft = GraphDraft { map, router, nodes: Vec::new(), joints: Vec::new() };
    let mut attached: BTreeMap<FaceId, Vec<(usize, LaneKind)>> = BTreeMap::new();
    for (faces, point) in gates(map, router.radius()) {
        let node = draft.add(point, None);
        for face in faces {
            attached.entry(face).or_default().push((node, LaneKind::Way));
        }
    }
    // Locations behind others are served from where those in front are.
    let served = layout.locations.iter().enumerate().filter(|(_, location)| location.depth_in_row == 1);
    for (index, location) in served {
        let known = location.approach.filter(|pose| map.clearance.at(pose.position) >= router.radius());
        let Some(pose) = known.or_else(|| approach_before(map, location, router.radius())) else { continue };
        let node = draft.add(pose.position, Some((index, location.code.clone(), pose.heading)));
        attached.entry(map.face_at(pose.position)).or_default().push((node, LaneKind::Spur));
    }
    for (face, nodes) in attached {
        draft.join_within(face, nodes);
    }
    draft.finish()
}

/// The gates between drivable faces: the faces on both sides, and the middle of the widest free stretch between them.
fn gates(map: &SiteMap<'_>, radius: f64) -> Vec<([FaceId; 2], Point)> {
    let subdivision = &map.analysis.subdivision;
    let mut shared: BTreeMap<[FaceId; 2], Vec<EdgeId>> = BTreeMap::new();
    for edge in subdivision.edges() {
        let mut sides = subdivision.sides(edge);
        if map.semantic.is_drivable_link(edge, sides) && !sides.contains(&FaceId::OUTER) {
            sides.sort_unstable();
            shared.entry(sides).or_default().push(edge);
        }
    }
    let pairs: Vec<_> = shared.into_iter().collect();
    let gate = |(sides, edges): &([FaceId; 2], Vec<EdgeId>)| {
        let best = edges.iter().filter_map(|&edge| widest_stretch(map, edge, radius));
        best.max_by(|one, other| one.0.total_cmp(&other.0)).map(|(_, point)| (*sides, point))
    };
    pairs.par_iter().filter_map(gate).collect()
}

/// The longest stretch of an edge on which a vehicle fits: its length, and the middle of the cell at its middle.
fn widest_stretch(map: &SiteMap<'_>, edge: EdgeId, radius: f64) -> Option<(f64, Point)> {
    let [start, end] = map.analysis.subdivision.segment(edge);
    let steps = ((end - start).norm() / map.grid.resolution()).ceil().max(1.0) as usize;
    let at = |step: usize| start + (end - start) * (step as f64 / steps as f64);
    let fits = |step: usize| map.clearance.at(at(step)) >= radius;
    let (mut best, mut begun): (Option<(usize, usize)>, Option<usize>) = (None, None);
    for step in 0..=steps + 1 {
        match (step <= steps && fits(step), begun) {
            (true, None) => begun = Some(step),
            (false, Some(from)) => {
                if best.is_none_or(|(first, last)| step - from > last - first) {
                    best = Some((from, step));
                }
                begun = None;
            }
            _ => {}
        }
    }
    let (first, last) = best?;
    let (column, row) = map.grid.cell_at(at(usize::midpoint(first, last - 1)))?;
    Some((map.grid.resolution() * (last - first) as f64, map.grid.center(column, row)))
}

/// A graph in the making.
struct GraphDraft<'a> {
    map: &'a SiteMap<'a>,
    router: &'a Router,
    nodes: Vec<GraphNode>,
    joints: Vec<Joint>,
}

impl GraphDraft<'_> {
    fn add(&mut self, position: Point, served: Option<(usize, String, f64)>) -> usize {
        let (location, name, heading) = match served {
            Some((index, code, heading)) => (Some(index), code, Some(heading)),
            None => (None, String::new(), None),
        };
        let kind = if location.is_some() { NodeKind::Approach } else { NodeKind::Waypoint };
        let face = self.map.face_at(position);
        let clearance = self.map.clearance.at(position);
        self.nodes.push(GraphNode { name, position, kind, face, location, heading, clearance });
        self.nodes.len() - 1
    }

    /// Joins the nodes that are attached to a face.
    fn join_within(&mut self, face: FaceId, mut attached: Vec<(usize, LaneKind)>) {
        let course = Course::of(self.map, face);
        attached.sort_by(|one, other| {
            let at = |node: usize| course.abscissa(self.nodes[node].position);
            at(one.0).total_cmp(&at(other.0)).then(one.0.cmp(&other.0))
        });
        // The node on the course before, and how far along it lies.
        let mut last: Option<(usize, f64)> = None;
        for (node, kind) in attached {
            let at = course.abscissa(self.nodes[node].position);
            let near = last.filter(|(_, before)| at - before < LEAST_DISTANCE_M);
            let on_course = near.map_or_else(|| self.node_on_course(&course, face, (node, kind)), |(before, _)| before);
            if near.is_none() {
                self.joints.extend(last.map(|(before, _)| (before, on_course, LaneKind::Way)));
                last = Some((on_course, at));
            }
            if on_course != node {
                self.joints.push((on_course, node, kind));
            }
        }
    }

    /// The node on the course of a face beside an attached node: that node itself where it is a gate on the course.
    fn node_on_course(&mut self, course: &Course, face: FaceId, (node, kind): (usize, LaneKind)) -> usize {
        let own = self.nodes[node].position;
        let found = course.widest(self.map, face, course.abscissa(own), self.router.radius());
        let position = found.unwrap_or(own);
        let is_itself = kind == LaneKind::Way && (position - own).norm() < LEAST_DISTANCE_M;
        if is_itself { node } else { self.add(position, None) }
    }

    fn finish(mut self) -> NavigationGraph {
        let lanes: Vec<Vec<Lane>> = self.joints.par_iter().map(|&joint| self.lanes(joint)).collect();
        let mut lanes: Vec<Lane> = lanes.into_iter().flatten().collect();
        lanes.sort_by_key(|lane| (lane.from, lane.to));
        lanes.dedup_by_key(|lane| (lane.from, lane.to));
        let index: BTreeMap<(usize, usize), usize> =
            lanes.iter().enumerate().map(|(index, lane)| ((lane.from, lane.to), index)).collect();
        let mut ways = vec![0_usize; self.nodes.len()];
        for lane in &mut lanes {
            lane.twin = index.get(&(lane.to, lane.from)).copied();
            ways[lane.from] += 1;
        }
        let width = self.nodes.len().to_string().len().max(4);
        for (number, (node, ways)) in self.nodes.iter_mut().zip(ways).enumerate() {
            if node.kind != NodeKind::Approach {
                node.name = format!("N{number:0width$}");
                node.kind = match ways {
                    0 | 1 => NodeKind::DeadEnd,
                    2 => NodeKind::Waypoint,
                    _ => NodeKind::Junction,
                };
            }
        }
        NavigationGraph { nodes: self.nodes, lanes, unmatched_rules: Vec::new() }
    }

    /// The lanes of a joint: one each way, or none where no short way leads.
    fn lanes(&self, (from, to, kind): Joint) -> Vec<Lane> {
        let [start, end] = [from, to].map(|node| self.nodes[node].position);
        let path = if self.router.sees(start, end) {
            vec![start, end]
        } else {
            let found = self.router.shortest(self.map, start, end);
            let is_short = |length: f64| length <= LONGEST_DETOUR * (end - start).norm() + LEAST_DISTANCE_M;
            let Some(route) = found.filter(|route| is_short(route.length)) else { return Vec::new() };
            route.path
        };
        let width = 2.0 * self.router.clearance_along(self.map, &path);
        let lane = |from: usize, to: usize, path: Vec<Point>| {
            let label = self.map.semantic.labels[self.nodes[from].face.index()];
            Lane { from, to, path, kind, label, width, twin: None }
        };
        let back = path.iter().rev().copied().collect();
        vec![lane(from, to, path), lane(to, from, back)]
    }
}
