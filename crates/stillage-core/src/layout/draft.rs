//! A location before it has a number: its ground and the way it is reached.
//!
//! Method: the frame of a storage face is given by the side from which it is reached; without one by the long side of its
//! box, entered at the short one. A face with room for several loads of a given width is cut across its front into equal
//! parts (Sutherland and Hodgman 1974, doi 10.1145/360767.360802). Cost: O(corners of the faces + cells of cut faces).
//! Limits: faces with holes and dented ones are cut as they are: a part may touch itself.

use super::access::AccessSide;
use super::occupancy::{self, CellShares, LocationOccupancy};
use crate::arrangement::{EdgeId, FaceId};
use crate::geometry::{OrientedBox, Point, Vector, direction, normal, polygon};
use crate::grid::Occupancy;
use crate::site_map::SiteMap;

/// A face is cut when it is wider than this many loads: with less, one load stands in it with room to spare.
const ROOM_FOR_TWO: f64 = 1.6;
/// Occupied cells nearer than this to the border of a part do not count, metres: they may be a post, or overhanging goods
/// of a neighbour. As in the annotation of faces.
const RIM_M: f64 = 0.1;

/// One location without numbers.
#[derive(Debug, Clone)]
pub(super) struct Draft {
    pub face: FaceId,
    pub part: u32,
    pub parts: u32,
    pub outline: Vec<Point>,
    pub center: Point,
    pub width: f64,
    pub depth: f64,
    /// Into the location, radians.
    pub heading: f64,
    pub area: f64,
    pub occupancy: LocationOccupancy,
    pub edges: Vec<EdgeId>,
    /// Where it is reached; `None` without access.
    pub front: Option<Front>,
}

/// The front of a location: the middle of its border to the ground from which it is reached.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Front {
    pub middle: Point,
    /// The drivable face before it.
    pub from: FaceId,
}

/// The locations of a storage face: one, or several where loads of `place_width` metres have room side by side.
pub(super) fn drafts_of(
    map: &SiteMap<'_>,
    face: FaceId,
    side: Option<&AccessSide>,
    place_width: Option<f64>,
) -> Vec<Draft> {
    let rings = map.analysis.subdivision.rings(face);
    let outline = rings.first().cloned().unwrap_or_default();
    let annotation = &map.analysis.faces[face.index()];
    let inward = side.map_or(annotation.heading, |side| heading_from(side.outward));
    let bounds = OrientedBox::around(outline.iter().copied(), inward);
    let [depth, width] = bounds.map_or([0.0; 2], |bounds| bounds.half_extents.map(|half| 2.0 * half));
    let front = side.map(|side| Front { middle: front_middle(map, side, bounds), from: side.from });
    let whole = Draft {
        face,
        part: 0,
        parts: 1,
        center: center(&rings),
        outline,
        width,
        depth,
        heading: inward,
        area: polygon::area(&rings),
        occupancy: occupancy::occupancy(annotation),
        edges: side.map(AccessSide::edges).unwrap_or_default(),
        front,
    };
    let count = place_width.filter(|load| width > ROOM_FOR_TWO * load).map_or(1, |load| (width / load).round() as u32);
    match bounds {
        Some(bounds) if count > 1 => (0..count).filter_map(|part| whole.part(map, bounds, part, count)).collect(),
        _ => vec![whole],
    }
}

/// The direction opposite to another, radians in `[-pi, pi)`.
fn heading_from(outward: f64) -> f64 {
    let inward = -direction(outward);
    inward.y.atan2(inward.x)
}

/// The middle of the front of a face, on the line of the edge with the most room.
fn front_middle(map: &SiteMap<'_>, side: &AccessSide, bounds: Option<OrientedBox>) -> Point {
    let subdivision = &map.analysis.subdivision;
    let ends = side.halves.iter().flat_map(|half| subdivision.segment(half.edge()));
    let [start, end] = subdivision.segment(side.halves[0].edge());
    let edge_middle = nalgebra::center(&start, &end);
    let Some(bounds) = bounds else { return edge_middle };
    // Across the front, the middle of all its edges; into the place, where the best one lies.
    let across = normal(bounds.angle);
    let places: Vec<f64> = ends.map(|end| across.dot(&end.coords)).collect();
    let low = places.iter().copied().fold(f64::INFINITY, f64::min);
    let high = places.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    edge_middle + across * (f64::midpoint(low, high) - across.dot(&edge_middle.coords))
}

/// Centroid of a face; its first point where it has no area.
fn center(rings: &[Vec<Point>]) -> Point {
    polygon::centroid(rings).or_else(|| rings.iter().flatten().next().copied()).unwrap_or_else(Point::origin)
}

impl Draft {
    /// One of `count` equal parts across the front, counted from the right of the heading; `None` where nothing lies.
    fn part(&self, map: &SiteMap<'_>, bounds: OrientedBox, part: u32, count: u32) -> Option<Self> {
        let across = normal(bounds.angle);
        let width = self.width / f64::from(count);
        let low = across.dot(&bounds.center.coords) + width * f64::from(part) - self.width / 2.0;
        let outline = clip(&clip(&self.outline, across, low), -across, -(low + width));
        let rings = [outline];
        let area = polygon::area(&rings);
        if area <= 0.0 {
            return None;
        }
        let center = center(&rings);
        let [outline] = rings;
        let front = self.front.map(|front| {
            let shift = across.dot(&(center - front.middle));
            Front { middle: front.middle + across * shift, ..front }
        });
        let occupancy = LocationOccupancy::of(shares_of(map, &outline, bounds.angle));
        Some(Self {
            part,
            parts: count,
            outline,
            center,
            width,
            area,
            occupancy,
            front,
            edges: self.edges.clone(),
            ..*self
        })
    }
}

/// The part of a ring whose distance along a direction is at least `least`.
fn clip(ring: &[Point], along: Vector, least: f64) -> Vec<Point> {
    let mut kept = Vec::with_capacity(ring.len() + 2);
    for (&from, &to) in ring.iter().zip(ring.iter().cycle().skip(1)) {
        let [before, after] = [from, to].map(|point| along.dot(&point.coords) - least);
        if before >= 0.0 {
            kept.push(from);
        }
        if (before < 0.0) != (after < 0.0) {
            kept.push(from + (to - from) * (before / (before - after)));
        }
    }
    kept
}

/// Shares of the cells of a part.
fn shares_of(map: &SiteMap<'_>, outline: &[Point], angle: f64) -> CellShares {
    let Some(bounds) = OrientedBox::around(outline.iter().copied(), angle) else {
        return CellShares { unknown: 1.0, inside_occupied: 0.0 };
    };
    let core = OrientedBox { half_extents: bounds.half_extents.map(|half| half - RIM_M), ..bounds };
    let (mut cells, mut unknown, mut inside) = (0_u32, 0_u32, 0_u32);
    for (column, row) in map.grid.cells_within(&bounds) {
        let cell = map.grid.row(row)[column];
        cells += 1;
        unknown += u32::from(cell == Occupancy::Unknown);
        inside += u32::from(cell == Occupancy::Occupied && core.contains(map.grid.center(column, row)));
    }
    let share = |count: u32| f64::from(count) / f64::from(cells.max(1));
    CellShares { unknown: if cells == 0 { 1.0 } else { share(unknown) }, inside_occupied: share(inside) }
}
