//! Straight ways over cells: line of sight, string pulling, and the faces a path crosses.
//!
//! Source: the traversal of Amanatides and Woo (*A Fast Voxel Traversal Algorithm for Ray Tracing*, 1987), with the
//! share of the way computed anew at every border, so that errors do not add up; a way through a corner needs both
//! cells beside it. String pulling is greedy: from each kept point to the farthest point in sight, which is found by
//! doubling and halving; forwards and backwards in turn until the path gets no shorter.
//!
//! Cost: O(n log n) sights for a path of n cells. Limits: the search takes all points beyond a hidden one to be hidden,
//! so a bend may stay that a straight line to a later point would remove.

use super::step_rule::StepRule;
use crate::arrangement::{EdgeId, FaceId};
use crate::geometry::Point;

/// Greatest number of rounds of pulling, two from each end; later ones move a path by less than a cell.
const ROUNDS: usize = 4;
/// A round that gains less than this share of the length is the last.
const LEAST_GAIN: f64 = 1e-6;
/// Borders crossed within this share of the way are crossed in one point.
const SAME_POINT: f64 = 1e-9;

/// One cell further on a straight way.
enum Step {
    /// Over a side.
    Side(usize),
    /// Through a corner, between two cells.
    Corner { beside: [usize; 2], to: usize },
}

/// The cells along a straight way, after the first.
struct Walk {
    width: usize,
    from: [f64; 2],
    way: [f64; 2],
    cell: [usize; 2],
    last: [usize; 2],
}

impl Walk {
    /// From point to point of the grid, both inside it.
    fn new(rule: &StepRule<'_>, from: Point, to: Point) -> Self {
        let scale = |point: Point| [point.x / rule.resolution(), point.y / rule.resolution()];
        let (from, to) = (scale(from), scale(to));
        let cell = |point: [f64; 2]| point.map(|value| value.floor() as usize);
        let way = [to[0] - from[0], to[1] - from[1]];
        Self { width: rule.width(), from, way, cell: cell(from), last: cell(to) }
    }

    fn at(&self) -> usize {
        self.cell[1] * self.width + self.cell[0]
    }

    /// Share of the way up to the next border across an axis; infinite once the last column or row is reached.
    fn border(&self, axis: usize) -> f64 {
        let (cell, last) = (self.cell[axis], self.last[axis]);
        if cell == last {
            return f64::INFINITY;
        }
        let border = if last > cell { cell + 1 } else { cell };
        (border as f64 - self.from[axis]) / self.way[axis]
    }

    fn advance(&mut self, axis: usize) {
        let cell = &mut self.cell[axis];
        *cell = if self.last[axis] > *cell { *cell + 1 } else { *cell - 1 };
    }
}

impl Iterator for Walk {
    type Item = Step;

    fn next(&mut self) -> Option<Step> {
        if self.cell == self.last {
            return None;
        }
        let (across, up) = (self.border(0), self.border(1));
        if (across - up).abs() <= SAME_POINT {
            let start = self.cell;
            self.advance(0);
            let first = self.at();
            self.cell = start;
            self.advance(1);
            let second = self.at();
            self.advance(0);
            return Some(Step::Corner { beside: [first, second], to: self.at() });
        }
        self.advance(usize::from(up < across));
        Some(Step::Side(self.at()))
    }
}

/// Whether the straight way between two points of passable cells is a path.
fn sees(rule: &StepRule<'_>, from: Point, to: Point) -> bool {
    let mut walk = Walk::new(rule, from, to);
    let mut cell = walk.at();
    walk.all(|step| {
        let (allowed, to) = match step {
            Step::Side(to) => (rule.allows(cell, to), to),
            Step::Corner { beside, to } => (rule.allows_corner(cell, beside, to), to),
        };
        cell = to;
        allowed
    })
}

/// Length of a path, metres.
pub(super) fn length(path: &[Point]) -> f64 {
    path.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum()
}

/// Straightens a path whose consecutive points see each other; its ends stay.
pub(super) fn pull_tight(rule: &StepRule<'_>, points: &[Point]) -> Vec<Point> {
    let mut path = pull(rule, points);
    for _ in 1..ROUNDS {
        let mut points = resample(&path, rule.resolution());
        points.reverse();
        let mut pulled = pull(rule, &points);
        let gained = length(&path) - length(&pulled);
        if gained <= LEAST_GAIN * length(&path) {
            break;
        }
        pulled.reverse();
        path = pulled;
    }
    path
}

/// Keeps the points where sight from the one kept before ends.
fn pull(rule: &StepRule<'_>, points: &[Point]) -> Vec<Point> {
    let mut kept: Vec<Point> = points.first().copied().into_iter().collect();
    let mut at = 0;
    while at + 1 < points.len() {
        at = farthest_in_sight(rule, points, at);
        kept.push(points[at]);
    }
    kept
}

/// The last point in sight of another; the next one is in sight.
fn farthest_in_sight(rule: &StepRule<'_>, points: &[Point], from: usize) -> usize {
    let last = points.len() - 1;
    let (mut seen, mut stride) = (from + 1, 1);
    while seen < last && sees(rule, points[from], points[(seen + stride).min(last)]) {
        seen = (seen + stride).min(last);
        stride *= 2;
    }
    // Sight is lost between `seen` and one stride on.
    let mut hidden = (seen + stride).min(last + 1);
    while seen + 1 < hidden {
        let middle = usize::midpoint(seen, hidden);
        if sees(rule, points[from], points[middle]) {
            seen = middle;
        } else {
            hidden = middle;
        }
    }
    seen
}

/// The corners of a path with points between them, at most one `spacing` apart.
fn resample(path: &[Point], spacing: f64) -> Vec<Point> {
    let mut points = Vec::new();
    for pair in path.windows(2) {
        let way = pair[1] - pair[0];
        let pieces = (way.norm() / spacing).ceil().max(1.0) as usize;
        points.extend((0..pieces).map(|piece| pair[0] + way * (piece as f64 / pieces as f64)));
    }
    points.extend(path.last());
    points
}

/// The faces a path crosses, and the edges between them, in order.
pub(super) fn faces_along(rule: &StepRule<'_>, path: &[Point]) -> (Vec<FaceId>, Vec<EdgeId>) {
    let Some(first) = path.windows(2).next() else { return Default::default() };
    let (mut faces, mut edges) = (vec![rule.face(Walk::new(rule, first[0], first[1]).at())], Vec::new());
    let mut cross = |from: usize, to: usize| {
        for (edge, face) in rule.crossings(from, to).unwrap_or_default() {
            edges.push(edge);
            faces.push(face);
        }
    };
    for pair in path.windows(2) {
        let walk = Walk::new(rule, pair[0], pair[1]);
        let mut cell = walk.at();
        for step in walk {
            match step {
                Step::Side(to) => {
                    cross(cell, to);
                    cell = to;
                }
                // One edge separates the two cells, so the cells beside the corner are not crossed.
                Step::Corner { to, .. } if rule.allows(cell, to) => {
                    cross(cell, to);
                    cell = to;
                }
                Step::Corner { beside: [side, _], to } => {
                    cross(cell, side);
                    cross(side, to);
                    cell = to;
                }
            }
        }
    }
    (faces, edges)
}
