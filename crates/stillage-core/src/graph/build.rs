//! The navigation graph of a map.
//!
//! Method: gates lie between drivable faces; within each face its course joins gates and the places where vehicles stand. A
//! lane is straight where nothing stands in the way, else it is a route. Where obstacles on the course would leave the graph
//! in parts that a vehicle drives between, further joints connect them, the shortest first: of the same face, then between
//! the nearest nodes of two parts. Each joint is a lane in each direction, side by side where two vehicles have room. Cost:
//! O(faces + edges + locations), each a line of sight or a short route, and O(cells) of the boxes around open ground.

use std::collections::{BTreeMap, BTreeSet};

use rayon::prelude::*;

use super::face_ways::Course;
use super::gates::gates;
use super::navigation_graph::{GraphNode, Lane, LaneKind, NavigationGraph, NodeKind};
use super::open_ground::GroundWays;
use super::side_by_side::side_by_side;
use crate::arrangement::FaceId;
use crate::geometry::{DisjointSets, Point};
use crate::layout::{Layout, approach_before};
use crate::routing::Router;
use crate::site_map::SiteMap;

/// Least distance between two nodes on the course of a face, metres: a vehicle does not stop twice within half a metre.
const LEAST_DISTANCE_M: f64 = 0.5;
/// A spur that is shorter than this is none, metres: the vehicle stands on the course.
const SHORTEST_SPUR_M: f64 = 0.1;
/// A lane that is this many times as long as the straight way leads around something: it is made only where nothing else
/// connects its ends.
const LONGEST_DETOUR: f64 = 3.0;
/// How many nodes of a course another joint may leave out, or pass by: obstacles hide a few at most.
const PASSED_BY: usize = 3;

/// Nodes of other parts that one which the joints of its face leave alone is tried with.
const NEAREST: usize = 4;

/// A pair of nodes that a lane in each direction joins.
type Joint = (usize, usize, LaneKind);

/// Builds the navigation graph for the vehicles of a router.
#[must_use]
pub fn navigation_graph(map: &SiteMap<'_>, layout: &Layout, router: &Router) -> NavigationGraph {
    let mut draft = GraphDraft { map, router, nodes: Vec::new(), joints: Vec::new(), spares: Vec::new() };
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
    // Open ground has ways around what stands there, also where it leads nowhere.
    for face in map.analysis.subdivision.faces().filter(|&face| map.is_drivable(face)) {
        attached.entry(face).or_default();
    }
    for (face, nodes) in attached {
        draft.join_within(face, nodes);
    }
    draft.finish()
}

/// A graph in the making.
struct GraphDraft<'a> {
    map: &'a SiteMap<'a>,
    router: &'a Router,
    nodes: Vec<GraphNode>,
    joints: Vec<Joint>,
    /// Joints that are made where the others leave the graph in parts.
    spares: Vec<Joint>,
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
        let course = Course::of(self.map, face, self.router.radius());
        if matches!(course, Course::OpenGround) {
            self.join_over(face, &attached);
            return;
        }
        attached.sort_by(|one, other| {
            let at = |node: usize| course.abscissa(self.nodes[node].position);
            at(one.0).total_cmp(&at(other.0)).then(one.0.cmp(&other.0))
        });
        // The nodes on the course, each with how far along it lies, and what is attached beside them.
        let mut along: Vec<(usize, f64)> = Vec::new();
        let mut beside: Vec<(usize, usize, LaneKind)> = Vec::new();
        for &(node, kind) in &attached {
            let at = course.abscissa(self.nodes[node].position);
            if along.last().is_none_or(|(_, before)| at - before >= LEAST_DISTANCE_M) {
                let on_course = self.node_on_course(&course, face, (node, kind));
                along.push((on_course, at));
            }
            if along[along.len() - 1].0 != node {
                beside.push((along.len() - 1, node, kind));
            }
        }
        self.joints.extend(along.windows(2).map(|pair| (pair[0].0, pair[1].0, LaneKind::Way)));
        self.joints.extend(beside.iter().map(|&(place, node, kind)| (along[place].0, node, kind)));
        self.add_spares(&along, &beside);
    }

    /// Joins the nodes that are attached to open ground, and the ways around what stands there.
    fn join_over(&mut self, face: FaceId, attached: &[(usize, LaneKind)]) {
        let points: Vec<Point> = attached.iter().map(|&(node, _)| self.nodes[node].position).collect();
        let ground = GroundWays::of(self.map, self.router, face, &points, LEAST_DISTANCE_M);
        let mut ends = vec![0_usize; points.len()];
        for &end in ground.ways.iter().flat_map(|way| [way.first(), way.last()]).flatten() {
            if let Some(count) = ends.get_mut(end) {
                *count += 1;
            }
        }
        // A way to where a vehicle stands, and no further, is a spur.
        let is_spur = |end: usize| attached.get(end).is_some_and(|&(_, kind)| kind == LaneKind::Spur && ends[end] == 1);
        let spurs: Vec<bool> = ground.ways.iter().map(|way| is_spur(way[0]) || is_spur(way[way.len() - 1])).collect();
        let mut nodes: Vec<Option<usize>> = attached.iter().map(|&(node, _)| Some(node)).collect();
        nodes.resize(ground.points.len(), None);
        for (way, is_spur) in ground.ways.iter().zip(spurs) {
            let kind = if is_spur { LaneKind::Spur } else { LaneKind::Way };
            let course: Vec<usize> = way
                .iter()
                .map(|&index| *nodes[index].get_or_insert_with(|| self.add(ground.points[index], None)))
                .collect();
            self.joints.extend(course.windows(2).map(|pair| (pair[0], pair[1], kind)));
        }
    }

    /// Joints past some nodes of a course, from attached nodes to those around the nearest, and between attached nodes.
    fn add_spares(&mut self, along: &[(usize, f64)], beside: &[(usize, usize, LaneKind)]) {
        for (place, &(node, _)) in along.iter().enumerate() {
            let further = along.iter().skip(place + 2).take(PASSED_BY);
            self.spares.extend(further.map(|&(other, _)| (node, other, LaneKind::Way)));
        }
        for &(place, node, kind) in beside {
            let near = place.saturating_sub(PASSED_BY)..(place + PASSED_BY + 1).min(along.len());
            let others = along[near].iter().filter(|&&(other, _)| other != along[place].0 && other != node);
            self.spares.extend(others.map(|&(other, _)| (other, node, kind)));
        }
        for (index, &(_, node, _)) in beside.iter().enumerate() {
            let next = beside.iter().skip(index + 1).take(PASSED_BY);
            self.spares.extend(next.map(|&(_, other, _)| (node, other, LaneKind::Way)));
        }
    }

    /// The node on the course of a face beside an attached node: that node itself where it is a gate on the course.
    fn node_on_course(&mut self, course: &Course, face: FaceId, (node, kind): (usize, LaneKind)) -> usize {
        let own = self.nodes[node].position;
        let found = course.at(self.map, face, course.abscissa(own), self.router.radius());
        let position = found.unwrap_or(own);
        let least = if kind == LaneKind::Way { LEAST_DISTANCE_M } else { SHORTEST_SPUR_M };
        let is_itself = (position - own).norm() < least;
        if is_itself { node } else { self.add(position, None) }
    }

    fn finish(self) -> NavigationGraph {
        let pairs = self.connected();
        let (mut nodes, lanes) = side_by_side(self.map, self.router, self.nodes, &pairs);
        let graph = NavigationGraph::of_lanes(lanes);
        let mut ways = vec![BTreeSet::new(); nodes.len()];
        for lane in &graph.lanes {
            ways[lane.from].insert(lane.to);
            ways[lane.to].insert(lane.from);
        }
        let width = nodes.len().to_string().len().max(4);
        for (number, (node, ways)) in nodes.iter_mut().zip(ways).enumerate() {
            if node.kind != NodeKind::Approach {
                node.name = format!("N{number:0width$}");
                node.kind = match ways.len() {
                    0 | 1 => NodeKind::DeadEnd,
                    2 => NodeKind::Waypoint,
                    _ => NodeKind::Junction,
                };
            }
        }
        NavigationGraph { nodes, ..graph }
    }

    /// The lanes of all joints, and of the shortest others that connect parts of the graph.
    fn connected(&self) -> Vec<[Lane; 2]> {
        let found: Vec<Option<Vec<Point>>> = self.joints.par_iter().map(|&joint| self.course(joint)).collect();
        let mut parts = DisjointSets::new(self.nodes.len());
        let (mut lanes, mut spares) = (Vec::new(), Vec::new());
        for (&joint, path) in self.joints.iter().zip(found) {
            let Some(path) = path else { continue };
            if self.is_short(joint, &path) {
                parts.join(joint.0, joint.1);
                lanes.push(self.lanes(joint, path));
            } else {
                spares.push((joint, path));
            }
        }
        spares.extend(self.courses_between(&self.spares, &mut parts));
        self.add_shortest(spares, &mut parts, &mut lanes);
        let near = self.courses_between(&self.near_other_parts(&mut parts), &mut parts);
        self.add_shortest(near, &mut parts, &mut lanes);
        lanes
    }

    /// The courses of those joints whose ends lie in different parts.
    fn courses_between(&self, joints: &[Joint], parts: &mut DisjointSets) -> Vec<(Joint, Vec<Point>)> {
        let apart: Vec<Joint> =
            joints.iter().filter(|&&(from, to, _)| parts.find(from) != parts.find(to)).copied().collect();
        apart.par_iter().filter_map(|&joint| Some((joint, self.course(joint)?))).collect()
    }

    /// Makes lanes of the joints that connect parts, the shortest first.
    fn add_shortest(&self, mut found: Vec<(Joint, Vec<Point>)>, parts: &mut DisjointSets, lanes: &mut Vec<[Lane; 2]>) {
        // Of equal lengths the first joint: the sort is stable.
        found.sort_by(|one, other| length(&one.1).total_cmp(&length(&other.1)));
        for (joint, path) in found {
            if parts.join(joint.0, joint.1) {
                lanes.push(self.lanes(joint, path));
            }
        }
    }

    /// Joints from every node outside the largest part to the nearest nodes of other parts. O(such nodes x nodes).
    fn near_other_parts(&self, parts: &mut DisjointSets) -> Vec<Joint> {
        let of_nodes: Vec<usize> = (0..self.nodes.len()).map(|node| parts.find(node)).collect();
        let mut sizes = vec![0_usize; self.nodes.len()];
        for &part in &of_nodes {
            sizes[part] += 1;
        }
        let Some(largest) = (0..sizes.len()).rev().max_by_key(|&part| sizes[part]) else { return Vec::new() };
        let outside: Vec<usize> = (0..of_nodes.len()).filter(|&node| of_nodes[node] != largest).collect();
        let nearest = |&node: &usize| {
            let distance = |other: usize| (self.nodes[other].position - self.nodes[node].position).norm_squared();
            let mut others: Vec<(f64, usize)> = (0..of_nodes.len())
                .filter(|&other| of_nodes[other] != of_nodes[node])
                .map(|other| (distance(other), other))
                .collect();
            let count = NEAREST.min(others.len());
            let by_distance =
                |one: &(f64, usize), other: &(f64, usize)| one.0.total_cmp(&other.0).then(one.1.cmp(&other.1));
            if count < others.len() {
                others.select_nth_unstable_by(count, by_distance);
            }
            others.truncate(count);
            others.sort_by(by_distance);
            others.into_iter().map(|(_, other)| (node, other, LaneKind::Way)).collect::<Vec<_>>()
        };
        outside.par_iter().flat_map_iter(nearest).collect()
    }

    /// The course between the ends of a joint; `None` where no way leads.
    fn course(&self, (from, to, _): Joint) -> Option<Vec<Point>> {
        let [start, end] = [from, to].map(|node| self.nodes[node].position);
        if self.router.sees(start, end) {
            return Some(vec![start, end]);
        }
        self.router.shortest(self.map, start, end).map(|route| route.path)
    }

    fn is_short(&self, (from, to, _): Joint, path: &[Point]) -> bool {
        let straight = (self.nodes[to].position - self.nodes[from].position).norm();
        length(path) <= LONGEST_DETOUR * straight + LEAST_DISTANCE_M
    }

    /// The lanes of a joint: one each way.
    fn lanes(&self, (from, to, kind): Joint, path: Vec<Point>) -> [Lane; 2] {
        let width = 2.0 * self.router.clearance_along(self.map, &path);
        let lane = |from: usize, to: usize, path: Vec<Point>| {
            let label = self.map.semantic.labels[self.nodes[from].face.index()];
            Lane { from, to, path, kind, label, width, twin: None }
        };
        let back = path.iter().rev().copied().collect();
        [lane(from, to, path), lane(to, from, back)]
    }
}

/// Length of a path, metres.
fn length(path: &[Point]) -> f64 {
    path.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum()
}
