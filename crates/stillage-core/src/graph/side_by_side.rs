//! Two directed lanes side by side, where two vehicles have room to pass.
//!
//! Method: a way whose free ground is wide enough carries a lane in each direction, each right of its middle. A node where
//! such a way leads straight on becomes two, one for each direction; at other nodes (junctions, ends) the lanes lead out of
//! the one node and into it. What else is attached to a node that became two is attached to both. Every course is checked
//! against the obstacles; a way that fails stays one course for both directions. Cost: O(lanes x rounds), with a line of
//! sight for each; a round for each time that a way failed.

use super::navigation_graph::{GraphNode, Lane, LaneKind};
use crate::geometry::{Point, Vector};
use crate::routing::Router;
use crate::site_map::SiteMap;

/// Between two vehicles that pass, metres: the allowance of ASR A1.8 (German workplace rules on traffic routes), 4.3.
const PASSING_GAP_M: f64 = 0.4;
/// Between a vehicle and what stands beside a way with traffic in both directions, metres: ASR A1.8, 4.3.
const EDGE_GAP_M: f64 = 0.5;
/// Two ways lead straight on where the cosine of the angle between them is at least this: 30 degrees.
const STRAIGHT_ON: f64 = 0.866;
/// Metres ahead for each metre sideways where a lane leaves the middle of its way.
const RAMP: f64 = 2.0;

/// The nodes and lanes of a graph whose ways are wide enough for two lanes where they are. Each of `pairs` is the two lanes of
/// one course.
pub(super) fn side_by_side(
    map: &SiteMap<'_>,
    router: &Router,
    nodes: Vec<GraphNode>,
    pairs: &[[Lane; 2]],
) -> (Vec<GraphNode>, Vec<Lane>) {
    let least_width = 2.0 * (2.0 * router.radius() + PASSING_GAP_M / 2.0 + EDGE_GAP_M);
    let is_wide = |[lane, _]: &[Lane; 2]| {
        lane.kind == LaneKind::Way && lane.path.len() == 2 && lane.width >= least_width && lane.length() > 0.0
    };
    let mut widening = Widening {
        map,
        router,
        offset: router.radius() + PASSING_GAP_M / 2.0,
        is_wide: pairs.iter().map(is_wide).collect(),
        ahead: Vec::new(),
        nodes,
    };
    loop {
        widening.ahead = widening.directions(pairs);
        let failed: Vec<usize> = (0..pairs.len()).filter(|&pair| widening.fails(&pairs[pair], pair)).collect();
        if failed.is_empty() {
            break;
        }
        for pair in failed {
            widening.is_wide[pair] = false;
        }
    }
    widening.finish(pairs)
}

/// A graph whose ways are being widened.
struct Widening<'a> {
    map: &'a SiteMap<'a>,
    router: &'a Router,
    /// From the middle of a way to each of its lanes, metres.
    offset: f64,
    /// By pair of lanes: whether its directions lie side by side.
    is_wide: Vec<bool>,
    /// By node: the unit vector in which the first of two directions leads on; `None` at a node that stays one.
    ahead: Vec<Option<Vector>>,
    nodes: Vec<GraphNode>,
}

/// An end of a lane: a node, and at a node that became two whether it is the second one, against the direction ahead.
type LaneEnd = (usize, bool);

impl Widening<'_> {
    /// By node: the direction ahead where exactly two wide ways meet and lead straight on.
    fn directions(&self, pairs: &[[Lane; 2]]) -> Vec<Option<Vector>> {
        let mut leaving: Vec<Vec<Vector>> = vec![Vec::new(); self.nodes.len()];
        for ([lane, _], _) in pairs.iter().zip(&self.is_wide).filter(|&(_, &is_wide)| is_wide) {
            let way = (lane.path[1] - lane.path[0]).normalize();
            leaving[lane.from].push(way);
            leaving[lane.to].push(-way);
        }
        let ahead = |(node, ways): (&GraphNode, &Vec<Vector>)| {
            let &[one, other] = ways.as_slice() else { return None };
            let ahead = (one - other).normalize();
            let has_room = [ahead, -ahead]
                .iter()
                .all(|&direction| self.router.sees(node.position, self.right_of(node.position, direction)));
            (node.location.is_none() && one.dot(&other) <= -STRAIGHT_ON && has_room).then_some(ahead)
        };
        self.nodes.iter().zip(&leaving).map(ahead).collect()
    }

    fn right_of(&self, point: Point, direction: Vector) -> Point {
        point + Vector::new(direction.y, -direction.x) * self.offset
    }

    fn position(&self, (node, is_second): LaneEnd) -> Point {
        let middle = self.nodes[node].position;
        self.ahead[node].map_or(middle, |ahead| self.right_of(middle, if is_second { -ahead } else { ahead }))
    }

    /// The end of a lane that arrives at a node, or leaves it, in a direction.
    fn end(&self, node: usize, direction: Vector) -> LaneEnd {
        (node, self.ahead[node].is_some_and(|ahead| ahead.dot(&direction) < 0.0))
    }

    /// Whether a wide way has no room for its two lanes.
    fn fails(&self, [lane, back]: &[Lane; 2], pair: usize) -> bool {
        let is_clear = |lane: &Lane| {
            let course = self.beside(lane);
            course.is_some_and(|(_, path)| path.windows(2).all(|piece| self.router.sees(piece[0], piece[1])))
        };
        self.is_wide[pair] && !(is_clear(lane) && is_clear(back))
    }

    /// The ends and the course right of the middle of a straight lane; `None` where it is too short to leave the middle.
    fn beside(&self, lane: &Lane) -> Option<([LaneEnd; 2], Vec<Point>)> {
        let way = (lane.path[1] - lane.path[0]).normalize();
        let ends = [self.end(lane.from, way), self.end(lane.to, way)];
        let ramp = way * (RAMP * self.offset);
        let mut path = vec![self.position(ends[0])];
        path.extend(self.ahead[lane.from].is_none().then(|| self.right_of(lane.path[0] + ramp, way)));
        path.extend(self.ahead[lane.to].is_none().then(|| self.right_of(lane.path[1] - ramp, way)));
        path.push(self.position(ends[1]));
        let leads_on = path.windows(2).all(|piece| (piece[1] - piece[0]).dot(&way) > 0.0);
        leads_on.then_some((ends, path))
    }

    fn finish(mut self, pairs: &[[Lane; 2]]) -> (Vec<GraphNode>, Vec<Lane>) {
        let mut lanes: Vec<(LaneKind, [LaneEnd; 2], Vec<Point>)> = Vec::new();
        for (pair, &is_wide) in pairs.iter().zip(&self.is_wide) {
            if is_wide {
                let beside = pair.iter().filter_map(|lane| self.beside(lane));
                lanes.extend(beside.map(|(ends, path)| (LaneKind::Way, ends, path)));
                continue;
            }
            let [lane, _] = pair;
            let variants = |node: usize| {
                [(node, false), (node, true)].into_iter().take(1 + usize::from(self.ahead[node].is_some()))
            };
            for from in variants(lane.from) {
                for to in variants(lane.to) {
                    let path = self.between(from, to, &lane.path);
                    lanes.push((lane.kind, [to, from], path.iter().rev().copied().collect()));
                    lanes.push((lane.kind, [from, to], path));
                }
            }
        }
        let seconds = self.divide();
        let index = |(node, is_second): LaneEnd| if is_second { seconds[node] } else { node };
        let lane = |(kind, ends, path): (LaneKind, [LaneEnd; 2], Vec<Point>)| {
            let [from, to] = ends.map(index);
            let label = self.map.semantic.labels[self.nodes[from].face.index()];
            let width = 2.0 * self.router.clearance_along(self.map, &path);
            Lane { from, to, path, kind, label, width, twin: None }
        };
        let lanes = lanes.into_iter().map(lane).collect();
        (self.nodes, lanes)
    }

    /// The course between two ends of a lane for both directions, whose nodes may have become two.
    fn between(&self, from: LaneEnd, to: LaneEnd, path: &[Point]) -> Vec<Point> {
        let begun = self.begun_at(from, path.to_vec());
        let mut path = self.begun_at(to, begun.into_iter().rev().collect());
        path.reverse();
        path
    }

    /// A course from the end beside its first node; over that node where nothing else is clear.
    fn begun_at(&self, end: LaneEnd, mut path: Vec<Point>) -> Vec<Point> {
        if self.ahead[end.0].is_some() {
            let position = self.position(end);
            if self.router.sees(position, path[1]) {
                path[0] = position;
            } else {
                path.insert(0, position);
            }
        }
        path
    }

    /// Moves each node that becomes two to the first of its places and adds the second: its index, by node.
    fn divide(&mut self) -> Vec<usize> {
        let mut seconds: Vec<usize> = (0..self.nodes.len()).collect();
        for (node, place) in seconds.iter_mut().enumerate() {
            if self.ahead[node].is_some() {
                let [first, second] = [false, true].map(|is_second| self.moved(node, self.position((node, is_second))));
                *place = self.nodes.len();
                self.nodes[node] = first;
                self.nodes.push(second);
            }
        }
        seconds
    }

    fn moved(&self, node: usize, position: Point) -> GraphNode {
        let (face, clearance) = (self.map.face_at(position), self.map.clearance.at(position));
        GraphNode { position, face, clearance, ..self.nodes[node].clone() }
    }
}
