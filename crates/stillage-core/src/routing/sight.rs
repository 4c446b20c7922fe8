//! Straight ways over cells: line of sight, string pulling, and the faces a path crosses.
//!
//! Source: the traversal of Amanatides and Woo (*A Fast Voxel Traversal Algorithm for Ray Tracing*, 1987), with the
//! share of the way computed anew at every border, so that errors do not add up; a way through a corner needs both
//! cells beside it. String pulling is greedy: from each kept point to the farthest point in sight, which is found by
//! doubling and halving; forwards and backwards in turn until the path gets no shorter.
//!
//! A straight way leads over whole cells, so that the vehicle fits on every point of it; from middle to middle along a
//! row, a column or a diagonal it is enough that the vehicle fits on the middles.
//!
//! Cost: O(n log n) sights for a path of n points. Limits: the search takes all points beyond a hidden one to be hidden,
//! so a bend may stay that a straight line to a later point would remove.

use super::drive_grid::DriveGrid;
use super::face_steps::FaceSteps;
use crate::arrangement::{EdgeId, FaceId};
use crate::geometry::Point;
use crate::site_map::SiteMap;

/// Greatest number of rounds of pulling; later ones move a path by less than a cell.
const ROUNDS: usize = 4;
/// A round that gains less than this share of the length is the last.
const LEAST_GAIN: f64 = 1e-4;
/// Distance from a corner of a path to the first point that it is cut at before it is pulled again, cells.
const RESAMPLED: f64 = 4.0;
/// Borders crossed within this share of the way are crossed in one point.
const SAME_POINT: f64 = 1e-9;

/// What can be seen from a point.
#[derive(Clone, Copy)]
pub(super) struct Sight<'a> {
    pub grid: &'a DriveGrid,
    /// Clearance of every cell, in the steps of the map.
    pub clearance: &'a [u16],
    /// Clearance that straight ways keep where both of their ends have it, in the same steps.
    pub preferred: u16,
}

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
    fn new(grid: &DriveGrid, from: Point, to: Point) -> Self {
        let scale = |point: Point| [point.x / grid.resolution, point.y / grid.resolution];
        let (from, to) = (scale(from), scale(to));
        let cell = |point: [f64; 2]| point.map(|value| value.floor() as usize);
        let way = [to[0] - from[0], to[1] - from[1]];
        Self { width: grid.width, from, way, cell: cell(from), last: cell(to) }
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

impl Sight<'_> {
    /// Whether the straight way between two points of fitting cells can be driven.
    pub fn sees(&self, from: Point, to: Point) -> bool {
        let mut walk = Walk::new(self.grid, from, to);
        let mut cell = walk.at();
        let last = walk.last[1] * walk.width + walk.last[0];
        let is_aligned = self.is_aligned(from, cell, to, last);
        let least = match self.preferred {
            0 => 0,
            preferred => preferred.min(self.clearance[cell]).min(self.clearance[last]),
        };
        let is_clear =
            |cell: usize| (is_aligned || self.grid.is_whole(cell)) && (least == 0 || self.clearance[cell] >= least);
        is_clear(cell)
            && walk.all(|step| {
                let (allowed, to) = match step {
                    Step::Side(to) => (self.grid.allows(cell, to), to),
                    Step::Corner { beside, to } => {
                        let is_beside_clear = is_aligned || beside.into_iter().all(is_clear);
                        (is_beside_clear && self.grid.allows_corner(cell, beside, to), to)
                    }
                };
                cell = to;
                allowed && is_clear(to)
            })
    }

    /// Whether a way leads from middle to middle along a row, a column or a diagonal.
    fn is_aligned(&self, from: Point, first: usize, to: Point, last: usize) -> bool {
        let width = self.grid.width;
        let columns = (first % width).abs_diff(last % width);
        let rows = (first / width).abs_diff(last / width);
        let is_middle =
            |point: Point, cell: usize| (point - self.grid.center(cell)).amax() < SAME_POINT * self.grid.resolution;
        (columns == 0 || rows == 0 || columns == rows) && is_middle(from, first) && is_middle(to, last)
    }

    /// Straightens a path along which every point can be reached from the one before; its ends stay.
    pub fn pull_tight(&self, points: &[Point]) -> Vec<Point> {
        let mut path = self.pull(points);
        for _ in 1..ROUNDS {
            let mut points = resample(&path, RESAMPLED * self.grid.resolution);
            points.reverse();
            let mut pulled = self.pull(&points);
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
    pub fn pull(&self, points: &[Point]) -> Vec<Point> {
        let mut kept: Vec<Point> = points.first().copied().into_iter().collect();
        let mut at = 0;
        while at + 1 < points.len() {
            at = self.farthest_in_sight(points, at);
            kept.push(points[at]);
        }
        kept
    }

    /// The last point in sight of another; the next one can be reached in any case.
    fn farthest_in_sight(&self, points: &[Point], from: usize) -> usize {
        let last = points.len() - 1;
        let sees = |index: usize| self.sees(points[from], points[index]);
        let (mut seen, mut stride) = (from + 1, 1);
        while seen < last && sees((seen + stride).min(last)) {
            seen = (seen + stride).min(last);
            stride *= 2;
        }
        // Sight is lost between `seen` and one stride on.
        let mut hidden = (seen + stride).min(last + 1);
        while seen + 1 < hidden {
            let middle = usize::midpoint(seen, hidden);
            if sees(middle) {
                seen = middle;
            } else {
                hidden = middle;
            }
        }
        seen
    }
}

/// Length of a path, metres.
pub(super) fn length(path: &[Point]) -> f64 {
    path.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum()
}

/// The corners of a path with points between them: near the corners, where they help to pull it tighter, each twice as
/// far from the corner as the one before.
fn resample(path: &[Point], spacing: f64) -> Vec<Point> {
    let mut points = Vec::new();
    for pair in path.windows(2) {
        let way = pair[1] - pair[0];
        let half = way.norm() / 2.0;
        let distances: Vec<f64> = std::iter::successors(Some(spacing), |distance| Some(2.0 * distance))
            .take_while(|&distance| distance < half)
            .collect();
        let along = |distance: f64| way * (distance / (2.0 * half));
        points.push(pair[0]);
        points.extend(distances.iter().map(|&distance| pair[0] + along(distance)));
        points.extend(distances.iter().rev().map(|&distance| pair[1] - along(distance)));
    }
    points.extend(path.last());
    points
}

/// The faces a path crosses, and the edges between them, in order.
pub(super) fn faces_along(
    grid: &DriveGrid,
    map: &SiteMap<'_>,
    steps: &FaceSteps,
    path: &[Point],
) -> (Vec<FaceId>, Vec<EdgeId>) {
    let Some(first) = path.windows(2).next() else { return Default::default() };
    let (mut faces, mut edges) = (vec![map.cells.of_cell(Walk::new(grid, first[0], first[1]).at())], Vec::new());
    let mut cross = |from: usize, to: usize| {
        for (edge, face) in steps.crossings_of_any(map, from, to) {
            edges.push(edge);
            faces.push(face);
        }
    };
    for pair in path.windows(2) {
        let walk = Walk::new(grid, pair[0], pair[1]);
        let mut cell = walk.at();
        for step in walk {
            match step {
                Step::Side(to) => {
                    cross(cell, to);
                    cell = to;
                }
                // One edge separates the two cells, so the cells beside the corner are not crossed.
                Step::Corner { to, .. } if steps.allows(map, cell, to) => {
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

/// The least clearance of the cells that a path crosses.
pub(super) fn clearance_along(grid: &DriveGrid, path: &[Point], clearance: impl Fn(usize) -> f64) -> f64 {
    let mut least = f64::INFINITY;
    for pair in path.windows(2) {
        let walk = Walk::new(grid, pair[0], pair[1]);
        least = least.min(clearance(walk.at()));
        for step in walk {
            let (Step::Side(cell) | Step::Corner { to: cell, .. }) = step;
            least = least.min(clearance(cell));
        }
    }
    least
}
