//! The outline of a vehicle, and the ground that it sweeps.
//!
//! Method: a straight stretch sweeps the convex hull of the outline at both of its ends. A turn on the spot is cut into
//! small angles; the hull of the outline before and after each, a little larger, holds the arcs of all corners. What is
//! swept is tested against the squares of obstacles along the axes of the grid and the normals of the hull (the separating
//! axis theorem), so nothing is missed between samples. Cost: O(cells of the boxes around what is swept). Limits: an outline
//! that is not convex counts as its convex hull; the vehicle turns on the spot, about its middle.

use std::f64::consts::{PI, TAU};

use crate::geometry::{Bounds, Point, Vector, convex_hull, direction, segment};
use crate::grid::{Occupancy, OccupancyGrid};

/// Longest stretch whose swept ground is tested in one piece, metres: the box around a slanted one stays small.
const PIECE_M: f64 = 5.0;
/// Largest angle of a turn whose swept ground is tested in one piece, radians: 5 degrees, for which the hull is enlarged by
/// a thousandth.
const TURN: f64 = PI / 36.0;
/// What overlaps by less than this only touches, metres.
const TOUCHING_M: f64 = 1e-9;

/// The outline of a vehicle: its corners around its middle, x forwards, metres.
#[derive(Debug, Clone, PartialEq)]
pub struct VehicleOutline {
    /// The convex hull, counter-clockwise.
    corners: Vec<Point>,
}

impl VehicleOutline {
    /// The convex hull of some corners; `None` where they enclose no ground, or not the middle of the vehicle.
    #[must_use]
    pub fn new(corners: &[Point]) -> Option<Self> {
        let corners = convex_hull(corners);
        let is_inside = |side: usize| {
            let (corner, next) = (corners[side], corners[(side + 1) % corners.len()]);
            (next - corner).perp(&(Point::origin() - corner)) > 0.0
        };
        (corners.len() >= 3 && (0..corners.len()).all(is_inside)).then_some(Self { corners })
    }

    /// Radius of the circle around it, metres: clear ground on which the vehicle turns anywhere.
    #[must_use]
    pub fn turning_radius(&self) -> f64 {
        self.corners.iter().map(|corner| corner.coords.norm()).fold(0.0, f64::max)
    }

    /// Distance from its middle to its nearest side, metres: less clear ground than that is never enough.
    #[must_use]
    pub fn passing_radius(&self) -> f64 {
        let sides =
            (0..self.corners.len()).map(|side| [self.corners[side], self.corners[(side + 1) % self.corners.len()]]);
        sides.map(|side| segment::distance(Point::origin(), side)).fold(f64::INFINITY, f64::min)
    }

    /// The corners of the vehicle at a place, looking along an angle, with distances from its middle times a factor.
    fn at(&self, place: Point, angle: f64, factor: f64) -> impl Iterator<Item = Point> + '_ {
        let ahead = direction(angle) * factor;
        let left = Vector::new(-ahead.y, ahead.x);
        self.corners.iter().map(move |corner| place + ahead * corner.x + left * corner.y)
    }

    /// Where the vehicle first touches an obstacle on a straight stretch, looking ahead: a point on its way.
    pub(super) fn touches_along(&self, grid: &OccupancyGrid, [start, end]: [Point; 2]) -> Option<Point> {
        let way = end - start;
        let angle = way.y.atan2(way.x);
        let pieces = (way.norm() / PIECE_M).ceil().max(1.0) as usize;
        let at = |piece: usize| start + way * (piece as f64 / pieces as f64);
        (0..pieces).map(|piece| [at(piece), at(piece + 1)]).find_map(|ends| {
            let corners: Vec<Point> = ends.into_iter().flat_map(|end| self.at(end, angle, 1.0)).collect();
            meets_obstacle(grid, &convex_hull(&corners)).then(|| nalgebra::center(&ends[0], &ends[1]))
        })
    }

    /// Whether the vehicle touches an obstacle while it turns on the spot, the shorter way round.
    pub(super) fn touches_turning(&self, grid: &OccupancyGrid, place: Point, [from, to]: [f64; 2]) -> bool {
        let turn = (to - from + PI).rem_euclid(TAU) - PI;
        let steps = (turn.abs() / TURN).ceil().max(1.0) as usize;
        let step = turn / steps as f64;
        (0..steps).any(|index| {
            let angle = from + step * index as f64;
            let factor = 1.0 / (step / 2.0).cos();
            let corners: Vec<Point> =
                self.at(place, angle, factor).chain(self.at(place, angle + step, factor)).collect();
            meets_obstacle(grid, &convex_hull(&corners))
        })
    }
}

/// Whether a convex polygon, counter-clockwise, overlaps a cell that is not free, or leaves the grid.
fn meets_obstacle(grid: &OccupancyGrid, polygon: &[Point]) -> bool {
    let resolution = grid.resolution();
    let bounds = Bounds::around(polygon);
    let range = |low: f64, high: f64| (low / resolution).floor() as i64..=(high / resolution).floor() as i64;
    let columns = range(bounds.low.x + TOUCHING_M, bounds.high.x - TOUCHING_M);
    let mut rows = range(bounds.low.y + TOUCHING_M, bounds.high.y - TOUCHING_M);
    rows.any(|row| {
        columns.clone().any(|column| {
            grid.at(column, row) != Occupancy::Free && {
                let middle = Point::new(column as f64 + 0.5, row as f64 + 0.5) * resolution;
                overlaps(polygon, middle, resolution / 2.0)
            }
        })
    })
}

/// Whether a convex polygon overlaps a square whose box meets its own: no side of the polygon lies between them.
fn overlaps(polygon: &[Point], middle: Point, half: f64) -> bool {
    (0..polygon.len()).all(|side| {
        let (corner, next) = (polygon[side], polygon[(side + 1) % polygon.len()]);
        let way = (next - corner).normalize();
        // The corner of the square that lies farthest inside.
        let inside = way.perp(&(middle - corner)) + half * (way.x.abs() + way.y.abs());
        inside > TOUCHING_M
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two metres long, one wide, its middle in the middle.
    fn truck() -> VehicleOutline {
        let corners = [(1.0, 0.5), (-1.0, 0.5), (-1.0, -0.5), (1.0, -0.5)];
        VehicleOutline::new(&corners.map(|(x, y)| Point::new(x, y))).unwrap()
    }

    /// A corridor of 1.2 m from left to right, in cells of 10 cm.
    fn corridor() -> OccupancyGrid {
        let lines: Vec<String> =
            (0..32).map(|row| (if (10..22).contains(&row) { "." } else { "#" }).repeat(60)).collect();
        OccupancyGrid::from_ascii(&lines.join("\n"), 0.1)
    }

    #[test]
    fn radii_are_those_of_circles_around_and_within() {
        assert!((truck().turning_radius() - 1.25_f64.sqrt()).abs() < 1e-12);
        assert!((truck().passing_radius() - 0.5).abs() < 1e-12);
    }

    #[test]
    fn an_outline_holds_ground_and_the_middle() {
        let line = [Point::new(0.0, 0.0), Point::new(1.0, 0.0), Point::new(2.0, 0.0)];
        let beside = [Point::new(1.0, 0.0), Point::new(2.0, 0.0), Point::new(2.0, 1.0)];
        assert_eq!((VehicleOutline::new(&line), VehicleOutline::new(&beside)), (None, None));
    }

    #[test]
    fn a_truck_passes_where_it_cannot_turn() {
        let (grid, truck) = (corridor(), truck());
        let [start, end] = [Point::new(1.5, 1.6), Point::new(4.5, 1.6)];
        assert_eq!(truck.touches_along(&grid, [start, end]), None);
        assert!(truck.touches_turning(&grid, start, [0.0, PI / 2.0]));
        assert!(!truck.touches_turning(&grid, start, [0.0, 0.05]));
        assert!(
            truck.touches_along(&grid, [start, Point::new(4.5, 1.75)]).is_some(),
            "nearer to the wall than half its width"
        );
    }

    #[test]
    fn the_end_of_the_grid_is_an_obstacle() {
        let grid = corridor();
        assert!(truck().touches_along(&grid, [Point::new(1.5, 1.6), Point::new(5.5, 1.6)]).is_some());
        assert!(truck().touches_along(&grid, [Point::new(1.5, 1.6), Point::new(5.0, 1.6)]).is_none());
    }
}
