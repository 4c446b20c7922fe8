//! Ways over open ground: a face that is wide in every direction, with things standing on it.
//!
//! Method: the cells on which a vehicle fits are thinned to lines that join what the face is attached to and go around
//! everything that stands there, with the most room. Where lines meet is a node; a line between two nodes is drawn straight
//! where it is nearly so, with further nodes at its bends. Cost: O(cells of the box around the face).

use std::ops::Range;

use super::thin_lines::ThinLines;
use crate::arrangement::FaceId;
use crate::geometry::{Bounds, DisjointSets, Point, segment};
use crate::grid::Occupancy;
use crate::routing::Router;
use crate::site_map::SiteMap;

/// How far a straight way may lie from the line with the most room, metres.
const TOLERANCE_M: f64 = 0.4;
/// How far from an attached point the ground may begin, metres: gates lie on the border between two faces.
const REACH_M: f64 = 1.0;

/// Ways over the ground of a face.
pub(super) struct GroundWays {
    /// Where nodes lie, grid frame, metres: first those that were attached, in their order.
    pub points: Vec<Point>,
    /// Ways between nodes that are attached or where ways meet: the nodes that each leads over, by index.
    pub ways: Vec<Vec<usize>>,
}

impl GroundWays {
    /// The ways over a face that join attached points. Where ways meet, nodes are at least `least_distance` metres apart.
    pub fn of(map: &SiteMap<'_>, router: &Router, face: FaceId, attached: &[Point], least_distance: f64) -> Self {
        let window = Window::around(map, router, face);
        let anchors: Vec<Option<usize>> = attached.iter().map(|&point| window.ground_near(map, point)).collect();
        let lines = ThinLines::of(window.width, &window.room, &anchors);
        let mut points = attached.to_vec();
        points.extend(lines.meetings.iter().map(|&cell| window.center(map, cell)));
        let ends = merged(&lines, &points, attached.len(), least_distance);
        let mut ways = Self { points, ways: Vec::new() };
        for line in &lines.between {
            let [from, to] = line.ends.map(|end| ends[end]);
            let mut course = vec![ways.points[from]];
            course.extend(line.cells.iter().map(|&cell| window.center(map, cell)));
            course.push(ways.points[to]);
            let mut bends = Vec::new();
            add_bends(router, &course, 0..course.len() - 1, &mut bends);
            // A ring this small goes around nothing that a straight way would not pass.
            if from == to && bends.len() < 2 {
                continue;
            }
            let mut way = vec![from];
            for bend in bends {
                way.push(ways.points.len());
                ways.points.push(course[bend]);
            }
            way.push(to);
            ways.ways.push(way);
        }
        ways
    }
}

/// By end of a line: the node it is, after nodes where ways meet that are close to one another became one.
fn merged(lines: &ThinLines, points: &[Point], attached: usize, least_distance: f64) -> Vec<usize> {
    let mut sets = DisjointSets::new(points.len());
    for line in &lines.between {
        let [from, to] = line.ends;
        let is_short = (points[to] - points[from]).norm() < least_distance;
        if from >= attached && to >= attached && is_short {
            sets.join(from, to);
        }
    }
    let mut firsts = vec![usize::MAX; points.len()];
    (0..points.len())
        .map(|end| {
            let first = &mut firsts[sets.find(end)];
            *first = (*first).min(end);
            *first
        })
        .collect()
}

/// The bends of a course between two of its points, by index: where it lies far from the straight way, or where that is not
/// clear.
fn add_bends(router: &Router, course: &[Point], piece: Range<usize>, bends: &mut Vec<usize>) {
    let Range { start, end } = piece;
    let inner = start + 1..end;
    let straight = [course[start], course[end]];
    let far = inner.clone().map(|index| (segment::distance(course[index], straight), index));
    let Some((distance, farthest)) = far.max_by(|one, other| one.0.total_cmp(&other.0)) else { return };
    if distance <= TOLERANCE_M && router.sees(straight[0], straight[1]) {
        return;
    }
    // A straight piece that is not clear is divided in its middle.
    let bend = if distance > 0.0 { farthest } else { usize::midpoint(start, end) };
    add_bends(router, course, start..bend, bends);
    bends.push(bend);
    add_bends(router, course, bend..end, bends);
}

/// The cells around a face, with a border of one cell that is no ground.
struct Window {
    /// Column and row in the grid of its first cell inside the border.
    low: [usize; 2],
    width: usize,
    /// By cell: steps of clearance where a vehicle fits on the face, else 0.
    room: Vec<u16>,
}

impl Window {
    fn around(map: &SiteMap<'_>, router: &Router, face: FaceId) -> Self {
        let outline = map.analysis.subdivision.rings(face).into_iter().next().unwrap_or_default();
        let bounds = Bounds::around(&outline);
        let cell = |place: f64, count: usize| ((place / map.grid.resolution()).floor().max(0.0) as usize).min(count);
        let [columns, rows] = [map.grid.width(), map.grid.height()];
        let [low, high] = if bounds.is_empty() {
            [[0, 0]; 2]
        } else {
            [
                [cell(bounds.low.x, columns), cell(bounds.low.y, rows)],
                [
                    cell(bounds.high.x + map.grid.resolution(), columns),
                    cell(bounds.high.y + map.grid.resolution(), rows),
                ],
            ]
        };
        let [width, height] = [high[0] - low[0] + 2, high[1] - low[1] + 2];
        let mut room = vec![0; width * height];
        let least = map.clearance.threshold(router.radius());
        for row in low[1]..high[1] {
            for column in low[0]..high[0] {
                let cell = row * columns + column;
                let steps = map.clearance.steps()[cell];
                let is_ground = map.grid.cells()[cell] == Occupancy::Free && map.cells.of_cell(cell) == face;
                if is_ground && steps >= least {
                    room[(row - low[1] + 1) * width + column - low[0] + 1] = steps;
                }
            }
        }
        Self { low, width, room }
    }

    fn center(&self, map: &SiteMap<'_>, cell: usize) -> Point {
        map.grid.center(cell % self.width + self.low[0] - 1, cell / self.width + self.low[1] - 1)
    }

    /// The ground cell that is nearest to a point.
    fn ground_near(&self, map: &SiteMap<'_>, point: Point) -> Option<usize> {
        let height = self.room.len() / self.width;
        let reach = (REACH_M / map.grid.resolution()).ceil();
        let place = |value: f64, low: usize| (value / map.grid.resolution()).floor() - low as f64 + 1.0;
        let (column, row) = (place(point.x, self.low[0]), place(point.y, self.low[1]));
        let span = |middle: f64, count: usize| {
            (middle - reach).clamp(0.0, count as f64) as usize..(middle + reach + 1.0).clamp(0.0, count as f64) as usize
        };
        let cells =
            span(row, height).flat_map(|row| span(column, self.width).map(move |column| row * self.width + column));
        let ground = cells.filter(|&cell| self.room[cell] > 0);
        let distance = |&cell: &usize| (self.center(map, cell) - point).norm_squared();
        ground.min_by(|one, other| distance(one).total_cmp(&distance(other)))
    }
}
